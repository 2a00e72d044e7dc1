// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QToolBar>

class QAction;
class QSpinBox;
class WaftEditor;

/// Turns the handles of a scene on, sets and removes marks, and saves the scene, or that of a
/// flight whose stages were joined by hand.
class WaftEditBar : public QToolBar
{
  Q_OBJECT

public:
  explicit WaftEditBar(QWidget* parent = nullptr);
  ~WaftEditBar() override;

private:
  QAction* Add(const char* name, const QString& text, const QString& tip);
  void MoveDown();
  void Show();
  void Save();
  void SaveAs();
  void SaveMotion();
  void Saved(const QString& file);
  void Tell(const QString& text);

  WaftEditor* Editor;
  QAction* Edit;
  QAction* Mark;
  QAction* Remove;
  QAction* SaveScene;
  QAction* SaveSceneAs;
  QAction* SaveFlight;
  QSpinBox* Body;
};
