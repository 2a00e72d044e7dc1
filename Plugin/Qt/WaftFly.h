// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QString>

class QAction;
class QMenu;
class QWidget;
class pqPipelineSource;

/// Joins what the session has of a scene to a flight, and shows it. Pressed again, it joins what
/// was added since. The menu has it beside the qualities to fly in.
class WaftFly : public QObject
{
  Q_OBJECT

public:
  explicit WaftFly(QWidget* bar);
  ~WaftFly() override;

  QAction* Action() const { return this->Fly; }
  QMenu* Menu() const { return this->Choices; }

Q_SIGNALS:
  /// A stage that is new; before it does anything.
  void made(pqPipelineSource* stage);
  /// What is about to fly, by its planner; nothing of it has flown yet.
  void begun(pqPipelineSource* planner);
  /// Why nothing flies.
  void refused(const QString& why);
  /// The active flight is to be drawn another air.
  void newAirWanted();

private:
  void Run();
  /// What was typed into panels and not applied counts.
  void ApplyPanels();

  QWidget* Bar;
  QMenu* Choices;
  QAction* Fly;
  int Quality = 0;       // of waft::Quality
  bool IsChosen = false; // since it was last flown
};
