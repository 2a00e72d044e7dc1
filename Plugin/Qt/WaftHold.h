// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>
#include <QPointer>

class QAction;
class QWidget;

/// Says when nothing new of Waft's work is to be shown: while ParaView plays frames, saves them or
/// is within an update of its own. Between two of these it lets the window's events through, and
/// what was shown then would make the frames of one film those of several motions. Whoever saves
/// from the menu before the work is done is asked whether to wait for it.
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
  /// What is saved when the work is done, as the menu has it; empty without any.
  QString Awaited() const;
  /// The work is done.
  void SaveAwaited();

Q_SIGNALS:
  /// Work that was stopped is waited for.
  void wanted();

private Q_SLOTS:
  void onBegin() { this->IsPlaying = true; }
  void onEnd() { this->IsPlaying = false; }

private:
  void WatchActions();
  void Save(QAction* action, QObject* reaction);
  static void Let(QObject* reaction);

  QWidget* Bar;
  QPointer<QAction> Waiting;
  bool IsUpdating = false;
  bool IsPlaying = false;
};
