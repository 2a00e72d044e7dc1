// SPDX-License-Identifier: BSD-3-Clause
#include "WaftCheck.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMSession.h>

#include <QDir>
#include <QFileInfo>
#include <QPointer>
#include <QProcess>
#include <QRegularExpression>
#include <QStringList>

#include <dlfcn.h>

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

/// What the command printed of a file: its last line, which sums up, and the findings.
QStringList FindingsOf(const QString& printed, const QString& file)
{
  QStringList lines =
    printed.split('\n', Qt::SkipEmptyParts).replaceInStrings(QRegularExpression("^waft: "), "");
  if (lines.size() < 2)
  {
    return {};
  }
  lines.prepend(lines.takeLast().replace(file + ":", QFileInfo(file).fileName() + ":"));
  const int more = lines.size() - 1 - MostFindings;
  lines = lines.mid(0, MostFindings + 1);
  if (more > 0)
  {
    lines << QString("and %1 more").arg(more);
  }
  return lines;
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
                  const QStringList findings =
                    FindingsOf(QString::fromUtf8(check->readAllStandardOutput()), file);
                  for (const QString& finding : findings) // for a terminal, where there is one
                  {
                    std::cerr << "waft: " << finding.toStdString() << "\n";
                  }
                  if (checked)
                  {
                    Q_EMIT this->found(checked, findings);
                  }
                  check->deleteLater();
                });
  check->start(this->Command, { "check", file });
}
