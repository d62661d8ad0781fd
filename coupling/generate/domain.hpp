#pragma once
/// Domain of the lobule generator: a prism between mirror planes, with vertical veins. The axis of
/// the central vein is the z axis; z runs from 0 to the height.

#include <array>
#include <string>
#include <vector>

#include "core/vec.hpp"

namespace acinus::coupling {

enum class LobuleShape { kPie, kHexagon };  // one sixth, the whole lobule

/// Parameters of the lobule block of a scene; lengths in um.
struct LobuleParameters {
  LobuleShape shape = LobuleShape::kPie;
  double radius = 280;  ///< circumradius of the hexagon
  double height = 48;
  double lesion_radius = 150;  ///< least distance of hepatocytes from the vein axis
  double central_vein_radius = 10;
  double portal_vein_radius = 15;
  double sinusoid_radius = 4.7;
  double vessel_fraction = 0.12;   ///< target of sinusoid length * pi r^2 / volume
  double branch_density = 4.8e-5;  ///< branch points per um^3
  double min_distance = 20;        ///< smallest distance between seeds
  int cells = 90;                  ///< requested seeds outside the lesion
  double initial_radius = 3;  ///< initial radius of a hepatocyte: least distance from the planes
};

/// Mirror plane; inside is (x - point) . normal >= 0.
struct MirrorPlane {
  std::string name;
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
};

/// Vertical vein. Sinusoids start on its wall at `wall_angle[level % 2]`, one level every 12 um of
/// z: the 15 and 45 degree positions of each 60 degree sector alternate so that neighbours do not
/// overlap.
struct Vein {
  bool portal = false;
  Vec3 axis = Vec3::Zero();  ///< foot at z = 0
  double radius = 0;
  std::array<std::vector<double>, 2> wall_angle;  ///< radians
};

struct Domain {
  std::vector<MirrorPlane> plane;
  std::vector<Vein> vein;  ///< the central vein first
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  double volume = 0;  ///< um^3, veins included
  double height = 0;
};

/// Makes the domain. Pie: one sixth of the hexagon, an equilateral triangle with its apex on the
/// vein axis, symmetric about +x, with the portal vein at the outer corner of positive y; three
/// vertical planes. Hexagon: corners at 30 + 60 k degrees, portal veins at 30, 150 and 270; six
/// vertical planes. Throws Error naming the key if a length is not positive or the veins do not
/// fit.
Domain make_domain(const LobuleParameters& parameters);

/// Distance to the nearest plane, positive inside, um.
double depth_inside(const Domain& domain, const Vec3& point);

/// Horizontal distance from a point to a vein's axis, um.
double axis_distance(const Vein& vein, const Vec3& point);

}  // namespace acinus::coupling
