// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

#include <array>
#include <map>
#include <set>

class pqDataRepresentation;
class pqPipelineSource;
class pqRenderView;

/// The camera of a view that showed nothing before: it takes in all that Waft's sources which are
/// made in the window show there, over the whole shot, z up, and follows what they come to until
/// somebody moves it. Views that show anything else, and cameras of users, stay as they are. What
/// it takes in, and from where, is what waft.show does in a script.
class WaftCamera : public QObject
{
  Q_OBJECT

public:
  explicit WaftCamera(QObject* parent);
  ~WaftCamera() override;

  /// A source that was made in the window.
  void Follow(pqPipelineSource* source);

public Q_SLOTS:
  void Refresh();

private:
  using Place = std::array<double, 6>; // of a camera, and where it looks

  bool IsMine(pqRenderView* view);
  static Place PlaceOf(pqRenderView* view);

  std::set<pqPipelineSource*> Sources;
  std::map<pqRenderView*, Place> Framed; // views that it has set, and how
};
