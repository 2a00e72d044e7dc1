// SPDX-License-Identifier: BSD-3-Clause
// The air's force and torque on a thin body as a sum over flat panels: rasterised once from all
// around for what hides what, then evaluated in about a microsecond.
#pragma once

#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Base/Shape.h"
#include "Rotation/Rasteriser.h"
#include "Rotation/RigidBody.h"

#include <Eigen/Core>

#include <vector>

namespace waft
{

enum class AirModel
{
  Paper = 0, // drag against the motion of each visible piece of surface (paper, Eq. 5)
  Plate = 1  // pressure along the normal, moving centre of pressure, circulation, added mass
};

/// Chosen so that strips go over from flutter to tumbling at the Froude number at which they do
/// (Belmonte, Eisenberg, Moses 1998). Lift makes the slope of the normal force that of a thin plate
/// of aspect 5, 2 pi A / (A + 2); Friction is the ratio of drag edge-on to drag broadside, and
/// Autorotation counts on a tip as fast as the flight. A PressureShift above 0 lets strips tumble
/// more readily, but lays curved bodies on their edges: the air's own mass turns them as a moving
/// centre of pressure would.
struct AirCoefficients
{
  AirModel Model = AirModel::Plate;
  double Drag = 1.2;           // cd, broadside
  double Lift = 2.9;           // extra slope of the normal force at small angles of attack
  double Spin = 0.0;           // rad, pitch of the propeller that a thin body is about its normal
  double Friction = 1.0 / 6.0; // tangential drag, as a fraction of cd (Andersen et al. 2005: A, B)
  double PressureShift = 0.0;  // centre of pressure edge-on, in half chords ahead of the centre
  double Separation = 1.0;     // fraction of the potential flow's moment that is lost broadside
  double Autorotation = 1.0;   // torque that keeps a turning plate turning
  double RotationalLift = 0.5; // C_R of Andersen, Pesavento, Wang 2005 (1.1 in two dimensions)
  /// Of a body so small and slow that the air is sticky to it: the speed at which Drag holds, and
  /// that of a Reynolds number of 1 [m/s]. 0: Drag holds at all speeds.
  double DragSpeed = 0.0;
  double StickySpeed = 0.0;

  /// Drag in a flow that meets the body at a speed [m/s], over Drag: as cd of a disc goes by its
  /// Reynolds number.
  double DragRatio(double speed) const;
  /// Those of that flow. As far as it is slower than one of which cd is the same at all speeds,
  /// friction is that of a disc in creeping flow (edge-on 2/3 of broadside: Happel and Brenner
  /// 1965, section 5-11), and what separated flow and circulation do is less.
  AirCoefficients At(double speed) const;
};

/// Four panels side by side, so that the processor works on them together. Lanes beyond the last
/// panel have no area.
struct PanelPack
{
  static constexpr std::size_t Width = 4;

  double X[Width], Y[Width], Z[Width];    // m, centroids
  double NX[Width], NY[Width], NZ[Width]; // unit normals
  double Area[Width];                     // m^2
};

/// Forces are for air of unit density: multiply by it.
class PanelBody
{
public:
  /// resolution: pixels on a side of each picture, 8 to 1024.
  Result Build(const Shape& shape, const ShellProperties& properties, int resolution,
               const ParallelFor& parallel);

  /// All in body axes. velocity: of the body's origin relative to the air there [m/s]; gradient:
  /// how that changes over the body, [omega]x minus the gradient of the air's velocity [1/s].
  Wrench Evaluate(const Vec3& velocity, const Mat3& gradient,
                  const AirCoefficients& coefficients) const;

  /// Foreshortened area [m^2] seen along a direction, by the panels.
  double ForeshortenedArea(const Vec3& direction) const;

  const Vec3& Normal() const { return this->PlateNormal; }
  /// 1 for a flat sheet, 0 for a closed round body.
  double Flatness() const { return this->PlateFlatness; }
  /// Inertia [m^5] and mass [m^3] of the air that moves with the body, per unit density.
  const Mat3& AddedInertia() const { return this->AirInertia; }
  const Mat3& AddedMass() const { return this->AirMass; }
  double Area() const { return this->TotalArea; }
  bool HidesItself() const { return !this->Visibility.empty(); }

private:
  struct Panel
  {
    double X, Y, Z;    // m, centroid
    double NX, NY, NZ; // unit normal
    double Area;       // m^2
  };
  struct Piece
  {
    Vec3 Centroid = Vec3::Zero();
    Vec3 VectorArea = Vec3::Zero();
    int Triangle = 0;
  };
  static constexpr std::size_t Width = PanelPack::Width;
  /// Nodes of the table of directions along each side of a face of the cube.
  static constexpr int Nodes = 7;
  /// Four nodes of that table and their weights: of each panel the part that is seen.
  struct Mixture
  {
    const float* Corners[4];
    double Weights[4];
  };

  void SplitMesh(const TriangleMesh& mesh, std::vector<Piece>& pieces) const;
  void Gather(std::vector<Piece>& pieces, std::size_t begin, std::size_t end, int budget,
              std::vector<int>& panelOfPiece);
  void LookFromAllAround(const TriangleMesh& mesh, const std::vector<Piece>& pieces,
                         const std::vector<int>& panelOfPiece, int resolution,
                         const ParallelFor& parallel);
  void PackPanels();
  void SetAddedMass(const ShellProperties& properties);
  Mixture Mix(const Vec3& direction) const;
  Wrench PlateCorrections(const Vec3& velocity, const Mat3& gradient,
                          const AirCoefficients& coefficients) const;

  std::vector<Panel> Panels;
  std::vector<PanelPack> Packs;  // the same panels
  std::vector<float> Visibility; // [face][row][column][lane], 0..1; empty: nothing hides anything
  double TotalArea = 0.0;
  Vec3 PlateNormal = Vec3::UnitZ();
  double PlateFlatness = 1.0;
  Mat3 Spread = Mat3::Zero(); // m^2, second moment of the area
  Mat3 AirInertia = Mat3::Zero();
  Mat3 AirMass = Mat3::Zero();
};

} // namespace waft
