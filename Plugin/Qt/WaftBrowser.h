// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pqPipelineModel.h>

class QWidget;
class pqPipelineSource;

/// What stands in the pipeline browser, where an output that came out empty says so beside its
/// name. The name itself, as scripts have it, stays. Outputs on a server are not looked at.
class WaftBrowser : public pqPipelineModel
{
  Q_OBJECT

public:
  explicit WaftBrowser(QObject* parent);

  QVariant data(const QModelIndex& index, int role) const override;

  /// Into the browsers of a window.
  static void PutInto(QWidget* window);

private:
  void LookAt(pqPipelineSource* source);
};
