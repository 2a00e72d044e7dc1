// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <QToolBar>

#include <vector>

class QProgressBar;
class QToolButton;
class WaftCamera;
class WaftCheck;
class WaftHold;
class pqPipelineSource;

/// Sources that are made in the window work in slices: Apply returns after the first, the others
/// follow by a timer, with new pictures, until the work is done or Stop is pressed.
class WaftToolBar : public QToolBar
{
  Q_OBJECT

public:
  explicit WaftToolBar(QWidget* parent = nullptr);
  ~WaftToolBar() override;

private Q_SLOTS:
  void onSourceMade(pqPipelineSource* source);
  void onSourceAdded(pqPipelineSource* source);
  void onDataUpdated();
  void onTimer();
  void onStop();
  void onGoOn();

private:
  enum class State
  {
    Resting,
    Working,
    Stopped
  };

  QToolButton* AddButton(const char* name, const QString& text, const QString& tip);
  void MoveDown();
  void Show(State state, const std::vector<pqPipelineSource*>& held);
  void WorkOn(const std::vector<pqPipelineSource*>& held);
  /// Renders all views.
  void Draw();

  WaftCamera* Camera;
  WaftCheck* Check;
  QTimer Timer;
  WaftHold* Hold;
  QElapsedTimer SinceDrawn;
  qint64 DrawingTook = 0; // ms, the last time
  QToolButton* Stop;
  QToolButton* GoOn;
  QProgressBar* Bar;
  State Now = State::Resting;
  bool IsInside = false; // of onTimer: an update lets the window's events through
};
