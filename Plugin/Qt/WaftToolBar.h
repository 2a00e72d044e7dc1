// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QElapsedTimer>
#include <QStringList>
#include <QTimer>
#include <QToolBar>
#include <QVector>

#include <cstddef>

class QProgressBar;
class QSpinBox;
class QToolButton;
class WaftCamera;
class WaftCheck;
class WaftFly;
class WaftFollow;
class WaftHold;
class WaftRemarks;
struct WaftFinding;
class pqPipelineSource;
class pqServerManagerModelItem;

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
  void onApplied(pqServerManagerModelItem* item);
  void onDataUpdated();
  void onTimer();
  void onStop();
  void onGoOn();
  void onRefused(const QString& why);
  void onFound(pqPipelineSource* source, const QVector<WaftFinding>& findings);
  void onRemarks();
  void onNewAir();

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
  void AddCameras();
  /// What was edited, and cannot be flown to in the air that there is, flies in another one.
  void DrawNewAirs();
  void FlyAnew(pqPipelineSource* source);
  void Show(State state, const waft::WorkOfStages& work);
  /// A line in the bar until there is other to say, as far as it has room before what is at its
  /// end, and all as its tip.
  void Say(const QString& line, const QString& whole, const QString& end = {});
  /// What is to be said of the active source.
  void ShowRest();
  /// Renders all views.
  void Draw();

  WaftCamera* Camera;
  WaftCheck* Check;
  WaftFly* Fly;
  WaftFollow* Follow;
  QTimer Timer;
  WaftHold* Hold;
  WaftRemarks* Remarks;
  QElapsedTimer SincePicture;
  qint64 PictureTook = 0; // ms, the last time
  QToolButton* Stop;
  QToolButton* GoOn;
  QProgressBar* Bar;
  QToolButton* Marks; // as a table
  QToolButton* Follows;
  QSpinBox* Followed;     // the body that the camera follows
  QToolButton* Remarked;  // a sign beside the bar that there are remarks, which opens them
  QAction* RemarkedShown; // its place in the tool bar
  State Now = State::Resting;
  Wish Asked = Wish::Nothing;
  QString Rest;            // what was said last of the active source, work aside
  QStringList Lines;       // of remarks, then
  double LeastLeft = -1.0; // s, that were said to be left
  std::size_t Begun = 0;   // stages, at most, since there was nothing to do
  bool IsInside = false;   // of Look: an update lets the window's events through
};
