// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QPointer>

#include <vtkVector.h>

#include <optional>

class pqRenderView;
class pqTimeKeeper;

/// A camera that goes along: with a body of the active flight, or with the middle of all of them.
/// From frame to frame, played or saved, the camera of the view is shifted as that moves, and keeps
/// what a hand does to it meanwhile.
class WaftFollow : public QObject
{
  Q_OBJECT

public:
  explicit WaftFollow(QObject* parent);
  ~WaftFollow() override;

  void SetOn(bool isOn);
  /// Below 0: all of them.
  void SetBody(int body);
  /// Of the flight that there is to follow; 0: none.
  int NumberOfBodies() const;

private:
  void LookAt();
  void Go();
  std::optional<vtkVector3d> PlaceNow() const;
  void Shift(const vtkVector3d& shift);

  QPointer<pqRenderView> View; // that was active when it was turned on
  QPointer<pqTimeKeeper> Keeper;
  std::optional<vtkVector3d> Before;
  int Body = -1;
};
