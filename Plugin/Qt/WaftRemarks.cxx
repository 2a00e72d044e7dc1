// SPDX-License-Identifier: BSD-3-Clause
#include "WaftRemarks.h"

#include "WaftStages.h"
#include "WaftVerdict.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>

#include <vtkCommand.h>
#include <vtkEventQtSlotConnect.h>
#include <vtkObject.h>
#include <vtkSMProxy.h>

#include <QHash>
#include <QRegularExpression>

#include <algorithm>

namespace
{

constexpr int Most = 100; // that are kept of a source

/// The first of those that are alike but for their numbers, with how many more there are.
QStringList FirstOfEach(const QStringList& lines)
{
  static const QRegularExpression number("-?[0-9][0-9.e+-]*");
  QStringList kinds, firsts;
  QHash<QString, int> counts;
  for (const QString& line : lines)
  {
    const QString kind = QString(line).replace(number, "0");
    if (counts[kind]++ == 0)
    {
      kinds << kind;
      firsts << line;
    }
  }
  for (int i = 0; i < firsts.size(); ++i)
  {
    const int more = counts[kinds[i]] - 1;
    firsts[i] += more > 0 ? QString(" (and %1 more like it)").arg(more) : QString();
  }
  return firsts;
}

} // namespace

WaftRemarks::WaftRemarks(QObject* parent) : QObject(parent)
{
  this->connect(pqApplicationCore::instance()->getServerManagerModel(),
                &pqServerManagerModel::preSourceRemoved, this,
                [this](pqPipelineSource* source)
                {
                  vtkSMProxy* proxy = source->getProxy();
                  if (vtkObjectBase* stage = proxy->GetClientSideObject())
                  {
                    this->Events->Disconnect(vtkObject::SafeDownCast(stage));
                  }
                  this->Of.remove(proxy);
                  this->Found.remove(proxy);
                });
}

WaftRemarks::~WaftRemarks() = default;

void WaftRemarks::ListenTo(vtkSMProxy* source)
{
  vtkObjectBase* stage = source->GetClientSideObject();
  if (auto* object = vtkObject::SafeDownCast(stage))
  {
    this->Events->Disconnect(object, vtkCommand::NoEvent, this);
    this->Events->Connect(object, vtkCommand::WarningEvent, this,
                          SLOT(onWarning(vtkObject*, unsigned long, void*, void*)), source);
    if (!waft::WorksInSlices(source))
    {
      this->Events->Connect(object, vtkCommand::StartEvent, this,
                            SLOT(onStart(vtkObject*, unsigned long, void*, void*)), source);
    }
  }
}

// VTK puts the place in its sources before it, and who said it.
void WaftRemarks::onWarning(vtkObject*, unsigned long, void* source, void* text)
{
  const QString whole = QString::fromUtf8(static_cast<const char*>(text)).trimmed();
  const int begin = whole.indexOf("): ");
  const QString remark = begin >= 0 ? whole.mid(begin + 3) : whole;
  QStringList& said = this->Of[static_cast<vtkSMProxy*>(source)];
  if (said.size() < Most && !said.contains(remark))
  {
    said << remark;
  }
}

void WaftRemarks::onStart(vtkObject*, unsigned long, void* source, void*)
{
  this->Of.remove(static_cast<vtkSMProxy*>(source));
}

void WaftRemarks::Find(vtkSMProxy* source, const QVector<WaftFinding>& findings)
{
  this->Found[source] = findings;
}

QStringList WaftRemarks::LinesOf(vtkSMProxy* source)
{
  const std::vector<pqPipelineSource*> related = waft::RelatedTo(source);
  QStringList lines, said;
  bool hasFlown = false;
  for (pqPipelineSource* one : related)
  {
    vtkSMProxy* proxy = one->getProxy();
    if (waft::IsFlight(proxy) && waft::IsComplete(proxy))
    {
      hasFlown = true;
      lines << waft::UnmetMarksOf(proxy);
    }
    said << this->Of[proxy];
  }
  for (pqPipelineSource* one : related)
  {
    for (const WaftFinding& finding : this->Found[one->getProxy()])
    {
      // What has flown says itself how many marks are not met, and which.
      if (!hasFlown || finding.IsPossible)
      {
        lines << finding.Text;
      }
    }
  }
  for (const QString& remark : said)
  {
    if (std::none_of(lines.begin(), lines.end(),
                     [&remark](const QString& line)
                     { return line.endsWith(remark); })) // found before it flew
    {
      lines << remark;
    }
  }
  return FirstOfEach(lines);
}
