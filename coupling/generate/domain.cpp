#include "coupling/generate/domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace acinus::coupling {
namespace {

double radians(double degrees) { return degrees * kPi / 180.0; }

Vec3 direction(double degrees) {
  return {std::cos(radians(degrees)), std::sin(radians(degrees)), 0.0};
}

void check_parameters(const LobuleParameters& p) {
  const auto positive = [](const char* key, double value) {
    check(std::isfinite(value) && value > 0,
          fmt::format("/lobule/{} = {}: must be positive", key, value));
  };
  positive("radius", p.radius);
  positive("height", p.height);
  positive("central_vein_radius", p.central_vein_radius);
  positive("portal_vein_radius", p.portal_vein_radius);
  positive("sinusoid_radius", p.sinusoid_radius);
  positive("branch_density", p.branch_density);
  positive("min_distance", p.min_distance);
  check(p.vessel_fraction >= 0 && p.vessel_fraction < 1,
        fmt::format("/lobule/vessel_fraction = {}: must be in [0, 1)", p.vessel_fraction));
  check(p.initial_radius >= 0 && 2 * p.initial_radius < p.height,
        fmt::format("/lobule/height = {} um: must exceed the diameter of the cells as they are "
                    "placed, {} um: twice start_up.initial_radius, or twice their radius without "
                    "start-up",
                    p.height, 2 * p.initial_radius));
  check(p.cells >= 0, fmt::format("/lobule/cells = {}: must not be negative", p.cells));
  const double apothem = p.radius * std::cos(radians(30));
  check(p.lesion_radius >= 0 && p.lesion_radius < p.radius,
        fmt::format("/lobule/lesion_radius = {} um: must be below /lobule/radius = {} um",
                    p.lesion_radius, p.radius));
  check(p.central_vein_radius + p.portal_vein_radius < apothem,
        fmt::format("/lobule/central_vein_radius = {} um and portal_vein_radius = {} um: together "
                    "they must be below the apothem {} um",
                    p.central_vein_radius, p.portal_vein_radius, apothem));
}

Vein portal_vein(const LobuleParameters& p, double corner, bool whole) {
  Vein vein{true, p.radius * direction(corner), p.portal_vein_radius, {}};
  vein.wall_angle[0].push_back(radians(corner + 225));
  vein.wall_angle[1].push_back(radians(corner + 195));
  if (whole) {  // a whole lobule has a second sector at this corner, the mirror image of the first
    vein.wall_angle[0].push_back(radians(corner + 135));
    vein.wall_angle[1].push_back(radians(corner + 165));
  }
  return vein;
}

}  // namespace

Domain make_domain(const LobuleParameters& p) {
  check_parameters(p);
  const bool whole = p.shape == LobuleShape::kHexagon;
  const double apothem = p.radius * std::cos(radians(30));
  Domain domain;
  domain.height = p.height;
  domain.volume = (whole ? 6 : 1) * std::sqrt(3.0) / 4 * p.radius * p.radius * p.height;

  Vein central{false, Vec3::Zero(), p.central_vein_radius, {}};
  for (int sector = 0; sector < (whole ? 6 : 1); ++sector) {
    central.wall_angle[0].push_back(radians(60 * sector - 15));
    central.wall_angle[1].push_back(radians(60 * sector + 15));
    domain.plane.push_back({whole ? fmt::format("outer_{}", sector) : "outer",
                            apothem * direction(60 * sector), -direction(60 * sector)});
  }
  domain.vein.push_back(central);
  if (whole) {
    for (const double corner : {30.0, 150.0, 270.0})
      domain.vein.push_back(portal_vein(p, corner, true));
    domain.low = {-apothem, -p.radius, 0};
    domain.high = {apothem, p.radius, p.height};
  } else {
    domain.plane.push_back({"radial_low", Vec3::Zero(), direction(60)});
    domain.plane.push_back({"radial_high", Vec3::Zero(), direction(-60)});
    domain.vein.push_back(portal_vein(p, 30, false));
    domain.low = {0, -p.radius / 2, 0};
    domain.high = {apothem, p.radius / 2, p.height};
  }
  domain.plane.push_back({"bottom", Vec3::Zero(), Vec3::UnitZ()});
  domain.plane.push_back({"top", Vec3(0, 0, p.height), -Vec3::UnitZ()});
  return domain;
}

double depth_inside(const Domain& domain, const Vec3& point) {
  double depth = std::numeric_limits<double>::infinity();
  for (const MirrorPlane& plane : domain.plane)
    depth = std::min(depth, (point - plane.point).dot(plane.normal));
  return depth;
}

double axis_distance(const Vein& vein, const Vec3& point) {
  return std::hypot(point.x() - vein.axis.x(), point.y() - vein.axis.y());
}

}  // namespace acinus::coupling
