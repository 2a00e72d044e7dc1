// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/Formation.h"

#include "Base/BodyLaw.h"
#include "Rotation/RigidBody.h"

#include <Eigen/Dense>

#include <algorithm>

namespace waft
{
namespace
{

constexpr double FormationTime = 0.4;   // s, in which it takes up what the air does
constexpr double FastestSinking = 0.15; // m/s
constexpr double MostStrain = 0.1;
constexpr double GradientRidge =
  0.05; // of the form's mean square size, against noise of few bodies
constexpr int Halvings = 4;

double LargestStretch(const Mat3& strain)
{
  return Eigen::SelfAdjointEigenSolver<Mat3>(strain).eigenvalues().cwiseAbs().maxCoeff();
}

/// What moves a form from a step to the next.
struct FormVelocity
{
  Vec3 Mean = Vec3::Zero(); // m/s
  Mat3 Gradient = Mat3::Zero();
};

FormVelocity Wanted(const std::vector<FormationPlace>& places, const std::vector<Vec3>& now,
                    const AirSampler& air, int frame)
{
  const double share = 1.0 / static_cast<double>(places.size());
  std::vector<Vec3> velocities;
  FormVelocity wanted;
  Vec3 middle = Vec3::Zero();
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const BodyLaw law = BodyLaw::Sinking(places[i].SettlingSpeed);
    velocities.push_back(law.Velocity(air.Between(frame, now[i])));
    wanted.Mean += share * velocities.back();
    middle += share * now[i];
  }
  Mat3 product = Mat3::Zero(), moments = Mat3::Zero();
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const Vec3 arm = now[i] - middle;
    product += share * (velocities[i] - wanted.Mean) * arm.transpose();
    moments += share * arm * arm.transpose();
  }
  const double size = moments.trace();
  if (size > 0.0)
  {
    moments += GradientRidge * size * Mat3::Identity();
    wanted.Gradient = product * moments.inverse();
  }
  return wanted;
}

bool HasRoom(const std::vector<FormationPlace>& places, const std::vector<Vec3>& now, int frame,
             const ObstacleSet& obstacles, const SceneInfo& scene)
{
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const double room = places[i].Room;
    if (scene.Bounds.InnerDistance(now[i]) < room ||
        obstacles.SignedDistance(now[i], frame, room) < room)
    {
      return false;
    }
  }
  return true;
}

} // namespace

const Formation* FindFormation(const std::vector<Formation>& all, const Constraint& row)
{
  const auto found =
    std::find_if(all.begin(), all.end(), [&](const Formation& one) { return one.Has(row); });
  return found != all.end() ? &*found : nullptr;
}

void MoveFormation(const std::vector<FormationPlace>& places, const AirSampler& air,
                   const ObstacleSet& obstacles, const SceneInfo& scene, Formation& formation)
{
  const double step = scene.Time.Step();
  formation.Center.setZero();
  for (const FormationPlace& place : places)
  {
    formation.Center += place.Place / static_cast<double>(places.size());
  }
  formation.Shifts = { Vec3::Zero() };
  formation.Turns = { Mat3::Identity() };
  const auto placesAt = [&](int frame)
  {
    std::vector<Vec3> at;
    for (const FormationPlace& place : places)
    {
      at.push_back(formation.At(place.Place, frame));
    }
    return at;
  };
  FormVelocity moving;
  Quat turned = Quat::Identity();
  Mat3 strain = Mat3::Zero();
  std::vector<Vec3> now = placesAt(formation.Begin);
  for (int frame = formation.Begin; frame < formation.End; ++frame)
  {
    const FormVelocity wanted = Wanted(places, now, air, frame);
    const double taken = std::min(1.0, step / FormationTime);
    moving.Mean += taken * (wanted.Mean - moving.Mean);
    moving.Gradient += taken * (wanted.Gradient - moving.Gradient);
    moving.Mean.z() = std::max(moving.Mean.z(), -FastestSinking);
    const Vec3 shift = formation.Shifts.back() + step * moving.Mean;
    double part = 1.0; // of the turn and the strain; none where some place would sink too fast
    for (int k = 0; k <= Halvings; ++k, part = k < Halvings ? 0.5 * part : 0.0)
    {
      const Mat3 gradient = part * moving.Gradient;
      const Mat3 spin = 0.5 * (gradient - gradient.transpose());
      const Mat3 rotation = turned.toRotationMatrix();
      Mat3 stretch =
        strain + step * rotation.transpose() * (0.5 * (gradient + gradient.transpose())) * rotation;
      stretch *= std::min(1.0, MostStrain / std::max(LargestStretch(stretch), MostStrain));
      const Quat turn =
        (ExpMap(step * Vec3(spin(2, 1), spin(0, 2), spin(1, 0))) * turned).normalized();
      formation.Shifts.push_back(shift);
      formation.Turns.push_back(turn.toRotationMatrix() * (Mat3::Identity() + stretch));
      const std::vector<Vec3> next = placesAt(frame + 1);
      bool sinks = false;
      for (std::size_t i = 0; i < next.size(); ++i)
      {
        sinks = sinks || next[i].z() - now[i].z() < -step * FastestSinking - 1e-12;
      }
      if (!sinks || part == 0.0)
      {
        turned = part > 0.0 ? turn : turned;
        strain = part > 0.0 ? stretch : strain;
        break;
      }
      formation.Shifts.pop_back();
      formation.Turns.pop_back();
    }
    std::vector<Vec3> next = placesAt(frame + 1);
    if (!HasRoom(places, next, frame + 1, obstacles, scene))
    {
      formation.Shifts.back() = formation.Shifts[formation.Shifts.size() - 2];
      formation.Turns.back() = formation.Turns[formation.Turns.size() - 2];
      moving = FormVelocity();
      next = now;
    }
    now = std::move(next);
  }
}

} // namespace waft
