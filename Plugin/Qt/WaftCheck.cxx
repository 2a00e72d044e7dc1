// SPDX-License-Identifier: BSD-3-Clause
#include "WaftCheck.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>

#include <vtkAlgorithm.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSession.h>
#include <vtkSMSourceProxy.h>
#include <vtkSceneJudge.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <QDir>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QPointer>
#include <QProcess>

#include <dlfcn.h>

#include <algorithm>
#include <iostream>

namespace
{

constexpr int MostFindings = 50;

/// bin/waft above this library.
QString FindCommand()
{
  static const char here = 0;
  Dl_info about{};
  if (dladdr(&here, &about) == 0 || about.dli_fname == nullptr)
  {
    return {};
  }
  QDir above = QFileInfo(QFileInfo(about.dli_fname).canonicalFilePath()).dir();
  do
  {
    const QFileInfo command(above.filePath("bin/waft"));
    if (command.isFile() && command.isExecutable())
    {
      return command.filePath();
    }
  } while (above.cdUp());
  return {};
}

/// The file of a source that reads a scene; empty of any other.
QString SceneOf(pqPipelineSource* source)
{
  const QString kind = source->getProxy()->GetXMLName();
  if ((kind != "WaftAnimation" && kind != "MotionSceneReader") ||
      source->getProxy()->GetSession()->IsA("vtkSMSessionClient"))
  {
    return {};
  }
  return QString::fromUtf8(vtkSMPropertyHelper(source->getProxy(), "FileName").GetAsString());
}

/// With what sums up before them; none where there are none.
QVector<WaftFinding> SummedUp(QVector<WaftFinding> findings, const QString& name, int objects,
                              int constraints)
{
  if (findings.isEmpty())
  {
    return findings;
  }
  const auto impossible =
    std::count_if(findings.begin(), findings.end(),
                  [](const WaftFinding& finding) { return !finding.IsPossible; });
  const int hard = findings.size() - static_cast<int>(impossible);
  const int more = findings.size() - MostFindings;
  findings = findings.mid(0, MostFindings);
  findings.prepend({ false, QString("%1: %2 objects, %3 constraints, %4 of them cannot be met, "
                                    "%5 remarks on what will be hard")
                              .arg(name)
                              .arg(objects)
                              .arg(constraints)
                              .arg(impossible)
                              .arg(hard) });
  if (more > 0)
  {
    findings << WaftFinding{ true, QString("and %1 more").arg(more) };
  }
  return findings;
}

WaftFinding FindingOf(bool isPossible, const QString& text)
{
  return { isPossible, (isPossible ? "hard: " : "cannot be met: ") + text };
}

/// Of the command's answer; none where it could not look.
QVector<WaftFinding> FindingsOf(const QByteArray& answer, const QString& file)
{
  const QJsonObject document = QJsonDocument::fromJson(answer).object();
  QVector<WaftFinding> findings;
  for (const QJsonValue& one : document["findings"].toArray())
  {
    findings << FindingOf(one["possible"].toBool(), one["text"].toString());
  }
  return SummedUp(findings, QFileInfo(file).fileName(), document["objects"].toInt(),
                  document["constraints"].toInt());
}

/// What an input of a stage has on the client; nullptr where there is none.
vtkPolyData* DataOf(vtkSMProxy* stage, const char* input)
{
  const vtkSMPropertyHelper giver(stage, input);
  auto* source =
    vtkSMSourceProxy::SafeDownCast(giver.GetNumberOfElements() > 0 ? giver.GetAsProxy() : nullptr);
  auto* own =
    source != nullptr ? vtkAlgorithm::SafeDownCast(source->GetClientSideObject()) : nullptr;
  if (own == nullptr)
  {
    return nullptr;
  }
  source->UpdatePipeline();
  return vtkPolyData::SafeDownCast(
    own->GetOutputDataObject(static_cast<int>(giver.GetOutputPort())));
}

} // namespace

WaftCheck::WaftCheck(QObject* parent) : QObject(parent), Command(FindCommand())
{
  this->connect(pqApplicationCore::instance()->getServerManagerModel(),
                &pqServerManagerModel::preSourceRemoved, this,
                [this](pqPipelineSource* source) { this->Seen.erase(source); });
}

WaftCheck::~WaftCheck() = default;

void WaftCheck::LookAt(pqPipelineSource* source)
{
  const QString file = SceneOf(source);
  const QFileInfo about(file);
  if (this->Command.isEmpty() || file.isEmpty() || !about.isFile())
  {
    return;
  }
  const Version version(file, about.lastModified());
  if (this->Seen[source] != version)
  {
    this->Seen[source] = version;
    this->Run(source, file);
  }
}

void WaftCheck::Run(pqPipelineSource* source, const QString& file)
{
  auto* check = new QProcess(this);
  this->connect(check, QOverload<int, QProcess::ExitStatus>::of(&QProcess::finished), this,
                [this, check, file, checked = QPointer<pqPipelineSource>(source)]
                {
                  this->Tell(checked, FindingsOf(check->readAllStandardOutput(), file));
                  check->deleteLater();
                });
  check->start(this->Command, { "check", "--json", file });
}

void WaftCheck::LookAtPlan(pqPipelineSource* planner)
{
  vtkSMProxy* stage = planner->getProxy();
  vtkPolyData* objects = DataOf(stage, "Objects");
  const vtkNew<vtkTable> found;
  if (objects == nullptr || !vtkSceneJudge::Judge(objects, DataOf(stage, "Constraints"),
                                                  DataOf(stage, "Obstacles"), found)
                               .empty())
  {
    return; // elsewhere, or what the stages will say themselves
  }
  QVector<WaftFinding> findings;
  for (vtkIdType row = 0; row < found->GetNumberOfRows(); ++row)
  {
    findings << FindingOf(found->GetValueByName(row, "Possible").ToInt() != 0,
                          QString::fromStdString(found->GetValueByName(row, "Text").ToString()));
  }
  const auto count = [&found](const char* name)
  { return static_cast<int>(found->GetFieldData()->GetArray(name)->GetComponent(0, 0)); };
  this->Tell(planner,
             SummedUp(findings, "Fly", count("NumberOfObjects"), count("NumberOfConstraints")));
}

void WaftCheck::Tell(pqPipelineSource* source, const QVector<WaftFinding>& findings)
{
  for (const WaftFinding& finding : findings) // for a terminal, where there is one
  {
    std::cerr << "waft: " << finding.Text.toStdString() << "\n";
  }
  if (source != nullptr)
  {
    Q_EMIT this->found(source, findings);
  }
}
