// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QDateTime>
#include <QObject>
#include <QString>
#include <QVector>

#include <map>
#include <utility>

class pqPipelineSource;

/// What `waft check` says of the scene files that Apply takes in: which marks cannot be met, and
/// what will be hard. It comes once, while the flight goes on; of a scene that has nothing to
/// be said of there is none, and one that is malformed is reported by its reader. A file is
/// looked at again when it has changed. Not of a server's files.
/// A sentence on a scene; what is not possible cannot be met.
struct WaftFinding
{
  bool IsPossible = true;
  QString Text;
};

class WaftCheck : public QObject
{
  Q_OBJECT

public:
  explicit WaftCheck(QObject* parent);
  ~WaftCheck() override;

  void LookAt(pqPipelineSource* source);
  /// At what a planner is to plan, which no file has.
  void LookAtPlan(pqPipelineSource* planner);

Q_SIGNALS:
  /// Of a source's file, a sentence each, the first of which sums up; none where all is well.
  void found(pqPipelineSource* source, const QVector<WaftFinding>& findings);

private:
  using Version = std::pair<QString, QDateTime>; // of a file

  void Run(pqPipelineSource* source, const QString& file);
  void Tell(pqPipelineSource* source, const QVector<WaftFinding>& findings);

  QString Command; // empty: this is no whole installation of Waft
  std::map<pqPipelineSource*, Version> Seen;
};
