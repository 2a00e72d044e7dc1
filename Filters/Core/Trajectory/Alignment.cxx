// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/Alignment.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <cmath>
#include <limits>

namespace waft
{

namespace
{

using Mat4 = Eigen::Matrix4d;
using Vec4 = Eigen::Vector4d;

constexpr double StraightRatio = 0.02; // deviation over length below which a window has no bend
constexpr double TieBreak = 1e-7;      // weight of "the smallest rotation" among equals

/// A window about its centroid: its samples, its line and whether it is more than a line.
struct CenteredWindow
{
  explicit CenteredWindow(const std::vector<Vec3>& points)
  {
    for (const Vec3& point : points)
    {
      this->Centroid += point;
    }
    this->Centroid /= static_cast<double>(points.size());
    this->Samples.resize(3, static_cast<Eigen::Index>(points.size()));
    for (std::size_t j = 0; j < points.size(); ++j)
    {
      this->Samples.col(static_cast<Eigen::Index>(j)) = points[j] - this->Centroid;
    }
    this->Chord = (points.back() - points.front()).norm();
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(this->Samples * this->Samples.transpose());
    const Vec3 spread = axes.eigenvalues().cwiseMax(0.0);
    this->Line = axes.eigenvectors().col(2);
    if (this->Line.dot(points.back() - points.front()) < 0.0)
    {
      this->Line = -this->Line;
    }
    this->Length = std::sqrt(spread[2]);
    this->IsStraight = std::sqrt(spread[1]) <= StraightRatio * this->Length;
  }

  Eigen::Matrix3Xd Samples;
  Vec3 Centroid = Vec3::Zero();
  Vec3 Line = Vec3::UnitX(); // unit, from the first sample to the last
  double Length = 0.0;       // rms extent along Line, times the root of the number of samples [m]
  double Chord = 0.0;        // m
  bool IsStraight = true;
};

/// Horn's matrix: q' N q = sum tail . (R(q) head), q = (w, x, y, z).
Mat4 HornMatrix(const Mat3& headTail)
{
  const Mat3& s = headTail; // s(a, b) = sum head_a tail_b
  Mat4 n;
  n << s(0, 0) + s(1, 1) + s(2, 2), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0),
    s(1, 2) - s(2, 1), s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2),
    s(2, 0) - s(0, 2), s(0, 1) + s(1, 0), -s(0, 0) + s(1, 1) - s(2, 2), s(1, 2) + s(2, 1),
    s(0, 1) - s(1, 0), s(2, 0) + s(0, 2), s(1, 2) + s(2, 1), -s(0, 0) - s(1, 1) + s(2, 2);
  return n;
}

Vec4 TopEigenvector(const Mat4& matrix)
{
  return Eigen::SelfAdjointEigenSolver<Mat4>(matrix).eigenvectors().col(3);
}

/// x^2 + y^2 = sin^2(tilt / 2).
double Lean(const Vec4& q)
{
  return q[1] * q[1] + q[2] * q[2];
}

Vec4 WithPenalty(const Mat4& horn, double multiplier)
{
  Mat4 matrix = horn;
  matrix(1, 1) -= multiplier;
  matrix(2, 2) -= multiplier;
  return TopEigenvector(matrix);
}

/// On the arc of unit quaternions from `over` (leans too much) to `under`, the one that leans by
/// the limit.
Vec4 OnLimit(const Vec4& over, Vec4 under, double limit)
{
  if (over.dot(under) < 0.0)
  {
    under = -under;
  }
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 60; ++i)
  {
    const double middle = 0.5 * (low + high);
    const Vec4 q = ((1.0 - middle) * over + middle * under).normalized();
    (Lean(q) > limit ? low : high) = middle;
  }
  return ((1.0 - high) * over + high * under).normalized();
}

/// max q' N q with |q| = 1 and Lean(q) <= limit. The pair (q' N q, Lean(q)) has a convex range on
/// the unit sphere (Brickman's theorem), so the maximum is the top eigenvector of N - mu D for one
/// multiplier mu >= 0, or lies between two top eigenvectors at the mu where they change places.
Vec4 LeaningAtMost(const Mat4& horn, double limit)
{
  Vec4 over = TopEigenvector(horn);
  if (Lean(over) <= limit)
  {
    return over;
  }
  const double scale = horn.norm();
  double low = 0.0;
  double high = scale;
  Vec4 under = WithPenalty(horn, high);
  while (Lean(under) > limit && high < 1e12 * scale)
  {
    low = high;
    over = under;
    high *= 4.0;
    under = WithPenalty(horn, high);
  }
  if (Lean(under) > limit)
  {
    under[1] = under[2] = 0.0;
    under.normalize();
  }
  for (int i = 0; i < 50 && high - low > 1e-13 * scale; ++i)
  {
    const double a = Lean(over) - limit;
    const double b = limit - Lean(under);
    if (a < 1e-12 || b < 1e-12)
    {
      break;
    }
    // The secant step, kept off the ends and taken in turn with bisection, so that both ends close.
    double fraction = a / (a + b);
    fraction = i % 2 == 0 ? std::clamp(fraction, 0.02, 0.98) : 0.5;
    const double middle = low + fraction * (high - low);
    const Vec4 q = WithPenalty(horn, middle);
    if (Lean(q) > limit)
    {
      low = middle;
      over = q;
    }
    else
    {
      high = middle;
      under = q;
    }
  }
  return Lean(over) - limit < 1e-12
           ? OnLimit(over, under, limit)
           : (limit - Lean(under) < 1e-12 ? under : OnLimit(over, under, limit));
}

Vec4 YawOnly(const Mat3& headTail, const CenteredWindow& tail, const CenteredWindow& head)
{
  const auto isVertical = [](const CenteredWindow& window)
  { return window.Samples.topRows<2>().norm() <= StraightRatio * window.Samples.norm(); };
  if (isVertical(tail) || isVertical(head))
  {
    return Vec4::UnitX();
  }
  const double cosine = headTail(0, 0) + headTail(1, 1);
  const double sine = headTail(0, 1) - headTail(1, 0);
  const double half = 0.5 * std::atan2(sine, cosine);
  return Vec4(std::cos(half), 0.0, 0.0, std::sin(half));
}

} // namespace

const char* ToString(RotationFreedom freedom)
{
  switch (freedom)
  {
    case RotationFreedom::Yaw:
      return "Yaw";
    case RotationFreedom::YawAndTilt:
      return "YawAndTilt";
    case RotationFreedom::Any:
      return "Any";
  }
  return "unknown";
}

double TiltOf(const Quat& rotation)
{
  const double lean = std::hypot(rotation.x(), rotation.y());
  return 2.0 * std::atan2(lean, std::hypot(rotation.w(), rotation.z()));
}

Connection AlignWindows(const std::vector<Vec3>& tail, const std::vector<Vec3>& head,
                        RotationFreedom freedom, double maxTilt)
{
  Connection best;
  best.Cost = std::numeric_limits<double>::infinity();
  if (tail.size() != head.size() || tail.size() < 2)
  {
    return best;
  }
  const CenteredWindow first(tail);
  const CenteredWindow second(head);
  Mat3 headTail = second.Samples * first.Samples.transpose();

  Vec4 q;
  if (freedom == RotationFreedom::Yaw)
  {
    q = YawOnly(headTail, first, second);
  }
  else
  {
    if (first.IsStraight || second.IsStraight)
    {
      headTail = first.Length * second.Length * second.Line * first.Line.transpose();
    }
    Mat4 horn = HornMatrix(headTail);
    horn(0, 0) += std::max(TieBreak * horn.norm(), 1e-300); // a window at rest: no rotation
    const double lean = std::sin(0.5 * std::clamp(maxTilt, 0.0, 3.14159265358979));
    q = freedom == RotationFreedom::Any ? TopEigenvector(horn) : LeaningAtMost(horn, lean * lean);
  }
  if (q[0] < 0.0)
  {
    q = -q;
  }
  best.Rotation = Quat(q[0], q[1], q[2], q[3]).normalized();
  best.Translation = first.Centroid - best.Rotation * second.Centroid;

  const Mat3 rotation = best.Rotation.toRotationMatrix();
  const double squares = (first.Samples - rotation * second.Samples).squaredNorm();
  const double rms = std::sqrt(squares / static_cast<double>(tail.size()));
  const double chord = 0.5 * (first.Chord + second.Chord);
  best.Cost = rms / std::max(chord, 1e-12);
  best.IsConnectible = std::isfinite(best.Cost);
  return best;
}

} // namespace waft
