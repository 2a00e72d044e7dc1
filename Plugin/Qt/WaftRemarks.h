// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QMap>
#include <QObject>
#include <QStringList>

#include <vtkNew.h>

#include <utility>

class vtkEventQtSlotConnect;
class vtkObject;
class vtkSMProxy;

/// What sources of the window warn of, such as a mark that the air does not take a body to, and
/// what is found of their scenes before. The window of messages, which comes before all else, is
/// left to errors. Not of a server's sources.
class WaftRemarks : public QObject
{
  Q_OBJECT

public:
  explicit WaftRemarks(QObject* parent);
  ~WaftRemarks() override;

  void ListenTo(vtkSMProxy* source);
  /// What is to be said of a scene file, in place of what was; it stays while others are cleared.
  void Find(const QString& file, const QStringList& findings);
  /// The first, and how many more there are; empty without any.
  QString Line() const;
  /// Each on a line of its own.
  QString All() const { return this->Lines().join("\n"); }
  /// Whether there is one that was not asked for yet.
  bool TakeNews() { return std::exchange(this->IsNew, false); }
  void Clear() { this->Said.clear(); }

private Q_SLOTS:
  void onWarning(vtkObject* stage, unsigned long, void*, void* text);

private:
  vtkNew<vtkEventQtSlotConnect> Events;
  QStringList Lines() const;

  QStringList Said;
  QMap<QString, QStringList> Found; // by file
  bool IsNew = false;
};
