// SPDX-License-Identifier: BSD-3-Clause
#include "WaftRemarks.h"

#include <vtkCommand.h>
#include <vtkEventQtSlotConnect.h>
#include <vtkObject.h>
#include <vtkSMProxy.h>

namespace
{

constexpr int Most = 100; // that are kept

} // namespace

WaftRemarks::WaftRemarks(QObject* parent) : QObject(parent) {}

WaftRemarks::~WaftRemarks() = default;

void WaftRemarks::ListenTo(vtkSMProxy* source)
{
  vtkObjectBase* stage = source->GetClientSideObject();
  if (auto* object = vtkObject::SafeDownCast(stage))
  {
    this->Events->Disconnect(object, vtkCommand::WarningEvent, this);
    this->Events->Connect(object, vtkCommand::WarningEvent, this,
                          SLOT(onWarning(vtkObject*, unsigned long, void*, void*)));
  }
}

// VTK puts the place in its sources before it, and who said it.
void WaftRemarks::onWarning(vtkObject*, unsigned long, void*, void* text)
{
  const QString whole = QString::fromUtf8(static_cast<const char*>(text)).trimmed();
  const int begin = whole.indexOf("): ");
  const QString remark = begin >= 0 ? whole.mid(begin + 3) : whole;
  if (this->Said.size() < Most && !this->Said.contains(remark))
  {
    this->Said << remark;
    this->IsNew = true;
  }
}

void WaftRemarks::Find(const QString& file, const QStringList& findings)
{
  this->IsNew = this->IsNew || this->Found[file] != findings;
  this->Found[file] = findings;
}

QStringList WaftRemarks::Lines() const
{
  QStringList lines = this->Said;
  for (const QStringList& findings : this->Found)
  {
    lines << findings;
  }
  return lines;
}

QString WaftRemarks::Line() const
{
  const QStringList lines = this->Lines();
  const int more = static_cast<int>(lines.size()) - 1;
  return lines.isEmpty()
           ? QString()
           : lines.first() + (more > 0 ? QString(" (and %1 more)").arg(more) : QString());
}
