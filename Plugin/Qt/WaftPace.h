// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class vtkSMAnimationScene;

/// Plays flights at the pace of their scene, however long a picture takes: ParaView's own default
/// shows each frame, slower or faster. All else, steps from frame to frame and films among it,
/// keeps to the frames, and who has chosen another mode keeps that.
class WaftPace : public QObject
{
  Q_OBJECT

public:
  explicit WaftPace(QObject* parent);
  ~WaftPace() override;

private Q_SLOTS:
  void onBegin();
  void onEnd();

private:
  vtkSMAnimationScene* Paced = nullptr; // while it plays
};
