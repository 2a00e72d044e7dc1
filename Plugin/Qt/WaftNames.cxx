// SPDX-License-Identifier: BSD-3-Clause
#include "WaftNames.h"

#include <pqPipelineSource.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonDocument>
#include <QJsonObject>
#include <QString>

#include <string>

namespace waft
{

namespace
{

constexpr qint64 MostBytes = 1 << 24; // of a report

QString SceneOf(const QFileInfo& report)
{
  QFile file(report.filePath());
  if (report.size() > MostBytes || !file.open(QIODevice::ReadOnly))
  {
    return {};
  }
  const QString scene = QJsonDocument::fromJson(file.readAll()).object()["scene"].toString();
  return QFileInfo(scene).fileName().remove(".waft.json");
}

} // namespace

void NameByScene(pqPipelineSource* source)
{
  if (std::string(source->getProxy()->GetXMLName()) != "MotionResultsReader" ||
      source->getSMName() != "report.json")
  {
    return;
  }
  const QFileInfo report(
    QString::fromUtf8(vtkSMPropertyHelper(source->getProxy(), "FileName").GetAsString()));
  const QString scene = SceneOf(report);
  source->rename(scene.isEmpty() ? report.absoluteDir().dirName() : scene);
}

} // namespace waft
