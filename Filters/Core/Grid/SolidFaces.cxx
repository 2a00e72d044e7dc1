// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/SolidFaces.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr int LayersIntoSolids = 3;
/// Slivers below this part of a face are closed: they would only spoil the pressure's condition.
constexpr float SmallestOpening = 0.01f;

// Part of a triangle where the linear interpolant of its corners' distances is positive.
double OpenPartOfTriangle(double a, double b, double c)
{
  const int outside = (a > 0.0) + (b > 0.0) + (c > 0.0);
  if (outside == 0 || outside == 3)
  {
    return outside == 0 ? 0.0 : 1.0;
  }
  // The corner that is alone on its side cuts off a similar triangle.
  const bool loneIsOpen = outside == 1;
  const auto isLone = [loneIsOpen](double d) { return (d > 0.0) == loneIsOpen; };
  if (isLone(b))
  {
    std::swap(a, b);
  }
  else if (isLone(c))
  {
    std::swap(a, c);
  }
  const double part = (a / (a - b)) * (a / (a - c));
  return loneIsOpen ? part : 1.0 - part;
}

// Four triangles about the centre, so that the answer has the symmetry of the square.
float OpenPartOfFace(double d00, double d10, double d01, double d11)
{
  const double center = 0.25 * ((d00 + d11) + (d10 + d01));
  const double open =
    0.25 * ((OpenPartOfTriangle(center, d00, d10) + OpenPartOfTriangle(center, d01, d11)) +
            (OpenPartOfTriangle(center, d00, d01) + OpenPartOfTriangle(center, d10, d11)));
  return open < SmallestOpening ? 0.0f : static_cast<float>(open);
}

} // namespace

float SolidFaces::Node(const std::vector<float>& distances, int i, int j, int k) const
{
  if (distances.empty())
  {
    return 1e30f;
  }
  const std::array<int, 3>& n = this->Layout.N;
  return distances[i + (n[0] + 1) * (j + static_cast<std::size_t>(n[1] + 1) * k)];
}

void SolidFaces::Build(const StaggeredLayout& layout, const SmokeOptions& options,
                       const std::vector<float>& distances,
                       const std::vector<std::array<float, 3>>& velocities)
{
  this->Layout = layout;
  this->Any = std::any_of(distances.begin(), distances.end(), [](float d) { return d <= 0.0f; });
  this->CutFaces(options, distances);
  this->MoveFaces(options, this->Any ? velocities : std::vector<std::array<float, 3>>());
  for (int axis = 0; axis < 3; ++axis)
  {
    this->FaceLinks[axis].clear();
  }
  this->CellLinks.clear();
  if (!this->Any)
  {
    return;
  }
  std::vector<unsigned char> known(layout.Size(), 0);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (std::size_t p = 0; p < known.size(); ++p)
    {
      known[p] = this->Open[axis][p] > 0.0f;
    }
    this->FaceLinks[axis] = this->MakeLinks(axis, known, options, distances);
  }
  std::fill(known.begin(), known.end(), 0);
  for (int k = 0; k < layout.N[2]; ++k)
  {
    for (int j = 0; j < layout.N[1]; ++j)
    {
      for (int i = 0; i < layout.N[0]; ++i)
      {
        const std::ptrdiff_t p = layout.Index(i, j, k);
        for (int axis = 0; axis < 3; ++axis)
        {
          known[p] |=
            this->Open[axis][p] > 0.0f || this->Open[axis][p + layout.Stride(axis)] > 0.0f;
        }
      }
    }
  }
  this->CellLinks = this->MakeLinks(-1, known, options, distances);
}

void SolidFaces::CutFaces(const SmokeOptions& options, const std::vector<float>& distances)
{
  const StaggeredLayout& layout = this->Layout;
  this->InSolid.assign(layout.Size(), 0);
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Open[axis].assign(layout.Size(), 0.0f);
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const int n = layout.N[axis];
    const BoundaryKind kind = options.Boundary[axis];
    for (int k = 0; k < layout.Count(2, axis); ++k)
    {
      for (int j = 0; j < layout.Count(1, axis); ++j)
      {
        for (int i = 0; i < layout.Count(0, axis); ++i)
        {
          std::array<int, 3> at{ i, j, k };
          const bool floor = axis == 2 && at[2] == 0 && options.ClosedFloor;
          const bool isEnd = at[axis] == 0 || at[axis] == n;
          if (isEnd && (kind == BoundaryKind::Closed || (kind == BoundaryKind::Open && floor)))
          {
            continue;
          }
          const std::ptrdiff_t p = layout.Index(i, j, k);
          if (kind == BoundaryKind::Periodic && at[axis] == n)
          {
            this->Open[axis][p] = this->Open[axis][p - n * layout.Stride(axis)];
            continue;
          }
          std::array<std::array<int, 3>, 4> corner{ at, at, at, at };
          ++corner[1][u];
          ++corner[2][v];
          ++corner[3][u];
          ++corner[3][v];
          double d[4];
          for (int c = 0; c < 4; ++c)
          {
            d[c] = this->Node(distances, corner[c][0], corner[c][1], corner[c][2]);
          }
          this->Open[axis][p] = OpenPartOfFace(d[0], d[1], d[2], d[3]);
        }
      }
    }
  }
  for (int k = 0; this->Any && k < layout.N[2]; ++k)
  {
    for (int j = 0; j < layout.N[1]; ++j)
    {
      for (int i = 0; i < layout.N[0]; ++i)
      {
        double sum = 0.0;
        for (int c = 0; c < 8; ++c)
        {
          sum += this->Node(distances, i + (c & 1), j + ((c >> 1) & 1), k + (c >> 2));
        }
        this->InSolid[layout.Index(i, j, k)] = sum <= 0.0;
      }
    }
  }
}

void SolidFaces::MoveFaces(const SmokeOptions& options,
                           const std::vector<std::array<float, 3>>& velocities)
{
  const StaggeredLayout& layout = this->Layout;
  for (int axis = 0; axis < 3; ++axis)
  {
    this->FaceVelocity[axis].clear();
  }
  this->Swept.clear();
  if (velocities.empty())
  {
    return;
  }
  const std::array<int, 3>& n = layout.N;
  this->Swept.assign(layout.Size(), 0.0f);
  const Vec3 spacing = options.Spacing();
  for (int axis = 0; axis < 3; ++axis)
  {
    std::vector<float>& face = this->FaceVelocity[axis];
    face.assign(layout.Size(), 0.0f);
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const auto node = [&](const std::array<int, 3>& at)
    { return velocities[at[0] + (n[0] + 1) * (at[1] + std::size_t(n[1] + 1) * at[2])][axis]; };
    for (int k = 0; k < layout.Count(2, axis); ++k)
    {
      for (int j = 0; j < layout.Count(1, axis); ++j)
      {
        for (int i = 0; i < layout.Count(0, axis); ++i)
        {
          std::array<int, 3> at{ i, j, k };
          const bool isEnd = at[axis] == 0 || at[axis] == n[axis];
          if (isEnd && options.Boundary[axis] != BoundaryKind::Periodic)
          {
            continue; // the volume's own walls stand still
          }
          std::array<int, 3> b = at, c = at, d = at;
          ++b[u];
          ++c[v];
          ++d[u];
          ++d[v];
          face[layout.Index(i, j, k)] = 0.25f * ((node(at) + node(d)) + (node(b) + node(c)));
        }
      }
    }
    const float scale = static_cast<float>(1.0 / spacing[axis]);
    for (int k = 0; k < n[2]; ++k)
    {
      for (int j = 0; j < n[1]; ++j)
      {
        for (int i = 0; i < n[0]; ++i)
        {
          const std::ptrdiff_t p = layout.Index(i, j, k);
          const std::ptrdiff_t q = p + layout.Stride(axis);
          this->Swept[p] += scale * ((1.0f - this->Open[axis][q]) * face[q] -
                                     (1.0f - this->Open[axis][p]) * face[p]);
        }
      }
    }
  }
}

std::vector<SolidFaces::Link> SolidFaces::MakeLinks(int faceAxis,
                                                    const std::vector<unsigned char>& known,
                                                    const SmokeOptions& options,
                                                    const std::vector<float>& distances) const
{
  const StaggeredLayout& layout = this->Layout;
  const Vec3 spacing = options.Spacing();
  std::vector<unsigned char> reached = known;
  // The gradient of the distance, from the nodes around the sample.
  const auto normalAt = [&](int i, int j, int k)
  {
    Vec3 gradient = Vec3::Zero();
    std::array<int, 3> low{ i, j, k };
    std::array<int, 3> high{ i + 1, j + 1, k + 1 };
    if (faceAxis >= 0)
    {
      low[faceAxis] = std::max(low[faceAxis] - 1, 0);
      high[faceAxis] = std::min(high[faceAxis], layout.N[faceAxis]);
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int corner = 0; corner < 8; ++corner)
      {
        const int x = corner & 1 ? high[0] : low[0];
        const int y = corner & 2 ? high[1] : low[1];
        const int z = corner & 4 ? high[2] : low[2];
        const double sign = (corner >> axis) & 1 ? 0.25 : -0.25;
        gradient[axis] += sign * this->Node(distances, x, y, z) /
                          (spacing[axis] * std::max(high[axis] - low[axis], 1));
      }
    }
    const double length = gradient.norm();
    return length > 1e-6 ? Vec3(gradient / length) : Vec3(Vec3::Zero());
  };

  std::vector<Link> links;
  for (int layer = 0; layer < LayersIntoSolids; ++layer)
  {
    const std::size_t firstOfLayer = links.size();
    for (int k = 0; k < layout.Count(2, faceAxis); ++k)
    {
      for (int j = 0; j < layout.Count(1, faceAxis); ++j)
      {
        for (int i = 0; i < layout.Count(0, faceAxis); ++i)
        {
          const std::array<int, 3> at{ i, j, k };
          const std::ptrdiff_t p = layout.Index(i, j, k);
          const bool isWall =
            faceAxis >= 0 && (at[faceAxis] == 0 || at[faceAxis] == layout.N[faceAxis]);
          if (reached[p] != 0 || isWall)
          {
            continue;
          }
          unsigned char neighbours = 0;
          for (int axis = 0; axis < 3; ++axis)
          {
            for (int side = 0; side < 2; ++side)
            {
              const int next = at[axis] + (side == 0 ? -1 : 1);
              const std::ptrdiff_t q = p + (side == 0 ? -1 : 1) * layout.Stride(axis);
              if (next >= 0 && next < layout.Count(axis, faceAxis) && reached[q] != 0)
              {
                neighbours |= static_cast<unsigned char>(1u << (2 * axis + side));
              }
            }
          }
          if (neighbours != 0)
          {
            Link link;
            link.At = p;
            link.Neighbours = neighbours;
            const Vec3 normal = normalAt(i, j, k);
            link.Normal = { static_cast<float>(normal.x()), static_cast<float>(normal.y()),
                            static_cast<float>(normal.z()) };
            links.push_back(link);
          }
        }
      }
    }
    for (std::size_t l = firstOfLayer; l < links.size(); ++l)
    {
      reached[links[l].At] = 1;
    }
  }
  return links;
}

void SolidFaces::Extend(const std::vector<Link>& links, float* values) const
{
  for (const Link& link : links)
  {
    // Opposite neighbours are added first: a mirror image gives the same bits.
    float sum = 0.0f;
    int count = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::ptrdiff_t step = this->Layout.Stride(axis);
      float pair = 0.0f;
      for (int side = 0; side < 2; ++side)
      {
        if (link.Neighbours & (1u << (2 * axis + side)))
        {
          pair += values[link.At + (side == 0 ? -step : step)];
          ++count;
        }
      }
      sum += pair;
    }
    values[link.At] = sum / static_cast<float>(count);
  }
}

void SolidFaces::ExtendCells(float* cells) const
{
  this->Extend(this->CellLinks, cells);
}

void SolidFaces::ExtendVelocities(const std::array<float*, 3>& faces) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Extend(this->FaceLinks[axis], faces[axis]);
  }
  // All corrections are made from the extended values, so that the order does not matter.
  std::array<std::vector<float>, 3> corrected;
  for (int axis = 0; axis < 3; ++axis)
  {
    corrected[axis].reserve(this->FaceLinks[axis].size());
    for (const Link& link : this->FaceLinks[axis])
    {
      float through = 0.0f;
      for (int other = 0; other < 3; ++other)
      {
        const float* v = faces[other];
        const std::ptrdiff_t ahead = this->Layout.Stride(other);
        const std::ptrdiff_t back = this->Layout.Stride(axis);
        const std::ptrdiff_t p = link.At;
        const float air = other == axis
                            ? v[p]
                            : 0.25f * ((v[p] + v[p + ahead]) + (v[p - back] + v[p + ahead - back]));
        through += link.Normal[other] * (air - this->ClosedVelocity(other, p));
      }
      corrected[axis].push_back(faces[axis][link.At] - link.Normal[axis] * through);
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    for (std::size_t l = 0; l < this->FaceLinks[axis].size(); ++l)
    {
      faces[axis][this->FaceLinks[axis][l].At] = corrected[axis][l];
    }
  }
}

} // namespace waft
