// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "WaftCheck.h"

#include <QMap>
#include <QObject>
#include <QStringList>

#include <vtkNew.h>

class pqPipelineSource;
class vtkEventQtSlotConnect;
class vtkObject;
class vtkSMProxy;

/// What is to be said of the window's sources, each by itself: marks that a flight does not meet,
/// what is found of a scene before, and what stages warn of. It goes with its source. The window
/// of messages, which comes before all else, is left to errors. Not of a server's sources.
class WaftRemarks : public QObject
{
  Q_OBJECT

public:
  explicit WaftRemarks(QObject* parent);
  ~WaftRemarks() override;

  void ListenTo(vtkSMProxy* source);
  /// What is to be said of a source's scene file, in place of what was.
  void Find(vtkSMProxy* source, const QVector<WaftFinding>& findings);
  /// A stage begins anew: what it warned of is no more.
  void Forget(vtkSMProxy* source) { this->Of.remove(source); }
  /// Of a source, whom it takes from and who takes from it: the worst first, and of those that are
  /// alike but for numbers the first alone, with how many more there are.
  QStringList LinesOf(vtkSMProxy* source);

private Q_SLOTS:
  void onWarning(vtkObject* stage, unsigned long, void* source, void* text);
  void onStart(vtkObject* stage, unsigned long, void* source, void*);

private:
  vtkNew<vtkEventQtSlotConnect> Events;
  QMap<vtkSMProxy*, QStringList> Of;             // warnings
  QMap<vtkSMProxy*, QVector<WaftFinding>> Found; // before anything flies
};
