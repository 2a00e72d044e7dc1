// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

#include <array>
#include <map>
#include <set>

class QWidget;
class pqDataRepresentation;
class pqPipelineSource;
class pqRenderView;

/// The camera of a view that showed nothing before: it takes in all that Waft's sources which are
/// made in the window show there, over the whole shot, z up, and follows what they come to until
/// the first flight is done or somebody moves it. Views that show anything else, and cameras of
/// users, stay as they are. What it takes in, and from where, is what waft.show does in a script.
/// ParaView's own resets of the camera leave a ground out, too, that reaches far beyond what flies.
/// Nothing of it is a step that can be undone.
class WaftCamera : public QObject
{
  Q_OBJECT

public:
  /// bar: of the window whose buttons reset the camera.
  explicit WaftCamera(QWidget* bar);
  ~WaftCamera() override;

  /// A source that was made in the window.
  void Follow(pqPipelineSource* source);

  /// What is framed now stays so.
  void Settle();

public Q_SLOTS:
  void Refresh();
  /// Takes in what the active view shows.
  void FrameFlight();

private:
  void WatchActions();
  void LeaveOutFloor();

  using Place = std::array<double, 6>; // of a camera, and where it looks

  bool IsMine(pqRenderView* view);
  static Place PlaceOf(pqRenderView* view);

  QWidget* Bar;
  std::set<pqPipelineSource*> Sources;
  std::map<pqRenderView*, Place> Framed; // views that it has set, and how; nowhere: not any more
};
