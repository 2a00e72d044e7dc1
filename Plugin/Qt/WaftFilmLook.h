// SPDX-License-Identifier: BSD-3-Clause
// The view as a film has it.
#pragma once

#include <QAction>
#include <QPointer>

#include <vector>

class pqDataRepresentation;

/// A switch that hides the paths and marks of all views, and shows again those that it hid.
class WaftFilmLook : public QAction
{
  Q_OBJECT

public:
  explicit WaftFilmLook(QObject* parent = nullptr);
  ~WaftFilmLook() override;

private:
  void Put(bool isOn);

  std::vector<QPointer<pqDataRepresentation>> Hidden;
};
