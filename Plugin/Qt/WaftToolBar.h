// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QElapsedTimer>
#include <QStringList>
#include <QTimer>
#include <QToolBar>

#include <cstddef>

class QProgressBar;
class QToolButton;
class WaftCamera;
class WaftCheck;
class WaftFly;
class WaftHold;
class WaftRemarks;
class pqPipelineSource;

namespace waft
{
struct WorkOfStages;
}

/// Sources that are made in the window work beside it: Apply returns soon, a timer looks how far
/// the work is and takes pictures of it, until the work is done or Stop is pressed.
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
  void onRefused(const QString& why);
  void onFound(const QString& file, const QStringList& findings);
  void onRemarks();

private:
  enum class State
  {
    Resting,
    Working,
    Stopped
  };
  enum class Wish // for which the work is to wait
  {
    Nothing,
    Picture,
    Stop
  };

  QToolButton* AddButton(const char* name, const QString& text, const QString& tip);
  void MoveDown();
  void Look();
  /// Whether work that goes on may be shown again.
  bool IsPictureDue() const;
  /// Shows what the work has come to.
  void TakePicture();
  void Show(State state, const waft::WorkOfStages& work);
  /// A line in the bar, as far as it has room, and all of it as its tip.
  void Say(const QString& line, const QString& whole);
  void ShowRemarks();
  /// Renders all views.
  void Draw();

  WaftCamera* Camera;
  WaftCheck* Check;
  WaftFly* Fly;
  QTimer Timer;
  WaftHold* Hold;
  WaftRemarks* Remarks;
  QElapsedTimer SincePicture;
  qint64 PictureTook = 0; // ms, the last time
  QToolButton* Stop;
  QToolButton* GoOn;
  QProgressBar* Bar;
  QToolButton* Remarked;  // a sign beside the bar that there are remarks, which opens them
  QAction* RemarkedShown; // its place in the tool bar
  State Now = State::Resting;
  Wish Asked = Wish::Nothing;
  std::size_t Begun = 0; // stages, at most, since there was nothing to do
  bool IsInside = false; // of Look: an update lets the window's events through
};
