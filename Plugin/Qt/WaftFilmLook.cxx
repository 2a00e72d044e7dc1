// SPDX-License-Identifier: BSD-3-Clause
#include "WaftFilmLook.h"

#include <pqApplicationCore.h>
#include <pqDataRepresentation.h>
#include <pqServerManagerModel.h>
#include <pqUndoStack.h>
#include <pqView.h>

#include <vtkSMProxy.h>

#include <string>

namespace
{

bool IsPathOrMark(pqDataRepresentation* shown)
{
  const std::string kind = shown->getProxy()->GetXMLName();
  return kind == "MotionFaintPathsRepresentation" || kind == "MotionPathsRepresentation" ||
         kind == "MotionMarksRepresentation" || kind == "MotionPlacedMarksRepresentation";
}

} // namespace

WaftFilmLook::WaftFilmLook(QObject* parent) : QAction("Film look", parent)
{
  this->setObjectName("FilmLook");
  this->setCheckable(true);
  this->setToolTip("Hide paths and marks, as Save Animation is to have it; press again and they "
                   "are back");
  this->connect(this, &QAction::toggled, this, &WaftFilmLook::Put);
}

WaftFilmLook::~WaftFilmLook() = default;

void WaftFilmLook::Put(bool isOn)
{
  SCOPED_UNDO_EXCLUDE();
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  if (isOn)
  {
    for (pqDataRepresentation* shown : model->findItems<pqDataRepresentation*>())
    {
      if (shown->isVisible() && IsPathOrMark(shown))
      {
        this->Hidden.emplace_back(shown);
      }
    }
  }
  for (const QPointer<pqDataRepresentation>& shown : this->Hidden)
  {
    if (shown)
    {
      shown->setVisible(!isOn);
      shown->renderViewEventually();
    }
  }
  if (!isOn)
  {
    this->Hidden.clear();
  }
}
