// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

class QWidget;

/// Says when nothing new of Waft's work is to be shown: while ParaView plays frames, saves them or
/// is within an update of its own. Between two of these it lets the window's events through, and
/// what was shown then would make the frames of one film those of several motions. What is saved
/// before the work is done is one motion, the one so far, and a warning says so.
class WaftHold : public QObject
{
  Q_OBJECT

public:
  /// bar: of the window that saves.
  explicit WaftHold(QWidget* bar);
  ~WaftHold() override;
  bool IsOn() const { return this->IsUpdating || this->IsPlaying; }
  /// ParaView is within an update, and nothing can be asked of a server.
  bool IsWithin() const { return this->IsUpdating; }

private Q_SLOTS:
  void onBegin();
  void onEnd();
  void onSaved();

private:
  void WatchActions();

  QWidget* Bar;
  bool IsUpdating = false;
  bool IsPlaying = false;
};
