#include "coupling/migration/leaders.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/numbers/time_grid.hpp"

namespace acinus::coupling {
namespace {

/// Hysteresis: share of its radius by which another cell has to be nearer to replace a leader.
constexpr double kLeaderHysteresis = 1.0 / 6;
/// Obstruction radius of a cell on a straight path to the vein, in its radii. Cells side by side
/// are two radii apart and do not obstruct each other; a cell behind the gap between two is
/// obstructed by both from 1.15 radii (three in a triangle) on.
constexpr double kObstruction = 1.3;
/// Length of an unobstructed path into the lesion, in radii, and its largest angle from the
/// direction of the vein. Smaller holes in the tissue are not the lesion.
constexpr double kLeaderReach = 4, kLargestPathAngle = kPi / 4;
constexpr int kPaths = 7;  ///< directions tried, 15 degrees apart

double turn(const PolarCell& a, const PolarCell& b) {
  return std::abs(std::remainder(a.angle - b.angle, 2 * kPi));
}

/// Distance from the vein that ranks cells.
double rank_distance(const PolarCell& c) {
  return c.distance - (c.led ? kLeaderHysteresis * c.radius : 0);
}

bool at_vein(const Motility& m, const PolarCell& c) {
  return c.distance <= m.axis_radius + c.radius;
}

/// True if no other cell is nearer within one diameter in arc and in height.
bool is_foremost(const PolarCell& c, std::span<const PolarCell> cells) {
  const double diameter = 2 * c.radius;
  return std::ranges::none_of(cells, [&](const PolarCell& other) {
    return &other != &c && other.exists && other.distance < rank_distance(c) &&
           turn(other, c) * c.distance < diameter && std::abs(other.height - c.height) < diameter;
  });
}

/// True if the horizontal straight path from the centre of a cell to the vein axis is clear of
/// others.
bool faces_lesion(const PolarCell& c, std::span<const PolarCell> cells) {
  return std::ranges::none_of(cells, [&](const PolarCell& other) {
    if (&other == &c || !other.exists || other.distance >= rank_distance(c)) return false;
    const double angle = turn(other, c);
    if (angle >= kPi / 2) return false;
    const double aside = other.distance * std::sin(angle), above = other.height - c.height;
    return std::hypot(aside, above) < kObstruction * other.radius;
  });
}

/// Position relative to the foot of the vein axis, um.
Vec3 place_of(const PolarCell& c) {
  return {c.distance * std::cos(c.angle), c.distance * std::sin(c.angle), c.height};
}

/// True if a path from a cell into the lesion is clear of other cells and of walls.
/// @param place  place_of every cell
bool borders_lesion(const Motility& m, std::size_t own, std::span<const PolarCell> cells,
                    std::span<const Vec3> place, std::span<const contact::Plane> walls) {
  const PolarCell& c = cells[own];
  const Vec3 from = place[own];
  const double bar = kObstruction - (c.led ? kLeaderHysteresis : 0);
  const double reach =
      std::min(kLeaderReach * c.radius, c.distance - m.axis_radius);  // to the vein
  auto is_clear = [&](const Vec3& direction) {
    const Vec3 end = m.axis_point + from + reach * direction;
    if (std::ranges::any_of(
            walls, [&](const contact::Plane& w) { return (end - w.point).dot(w.normal) < 0; }))
      return false;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (k == own || !cells[k].exists) continue;
      const Vec3 d = place[k] - from;
      const double along = d.dot(direction);
      if (along > 0 && (d - std::min(along, reach) * direction).norm() < bar * cells[k].radius)
        return false;
    }
    return true;
  };
  for (int k = 0; k < kPaths; ++k) {
    const double turned = c.angle + kPi + kLargestPathAngle * (2.0 * k / (kPaths - 1) - 1);
    if (is_clear({std::cos(turned), std::sin(turned), 0})) return true;
  }
  return false;
}

void lead_at_border(const Motility& m, std::span<const PolarCell> cells,
                    std::span<const contact::Plane> walls, std::vector<std::uint8_t>& leader) {
  std::vector<Vec3> place;
  for (const PolarCell& c : cells) place.push_back(place_of(c));
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i].exists && !at_vein(m, cells[i]) && borders_lesion(m, i, cells, place, walls))
      leader[i] = 1;
}

/// Marks the nearest cell of every sector of the circle and slice of height.
void lead_by_sector(const Motility& m, std::span<const PolarCell> cells,
                    std::vector<std::uint8_t>& leader) {
  std::map<std::pair<int, int>, std::size_t> first;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const PolarCell& c = cells[i];
    if (!c.exists || at_vein(m, c)) continue;
    const double share = c.angle / (2 * kPi);
    const auto sector = static_cast<int>(std::floor((share - std::floor(share)) * m.leader_count));
    const auto slice = static_cast<int>(std::floor(c.height / m.leader_slice));
    const auto [place, added] = first.try_emplace({slice, sector}, i);
    if (!added && rank_distance(c) < rank_distance(cells[place->second])) place->second = i;
  }
  for (const auto& [where, i] : first) leader[i] = 1;
}

/// Marks the `leader_count` nearest cells.
void lead_nearest(const Motility& m, std::span<const PolarCell> cells,
                  std::vector<std::uint8_t>& leader) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i].exists && !at_vein(m, cells[i])) order.push_back(i);
  const auto n = std::min(order.size(), static_cast<std::size_t>(m.leader_count));
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return rank_distance(cells[i]); });
  for (std::size_t k = 0; k < n; ++k) leader[order[k]] = 1;
}

PolarCell make_polar(const Motility& m, const Vec3& center, double radius) {
  const Vec3 d = center - m.axis_point;
  return {std::hypot(d.x(), d.y()), std::atan2(d.y(), d.x()), d.z(), radius, true, false};
}

}  // namespace

std::vector<std::uint8_t> find_leaders(const Motility& m, std::span<const PolarCell> cells,
                                       std::span<const contact::Plane> walls) {
  std::vector<std::uint8_t> leader(cells.size(), 0);
  auto lead_where = [&](auto rule) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (cells[i].exists && !at_vein(m, cells[i]) && rule(cells[i])) leader[i] = 1;
  };
  switch (m.leaders) {
    case Leaders::kForemost:
      lead_where([&](const PolarCell& c) { return is_foremost(c, cells); });
      break;
    case Leaders::kFront:
      lead_where([&](const PolarCell& c) { return faces_lesion(c, cells); });
      break;
    case Leaders::kBorder:
      lead_at_border(m, cells, walls, leader);
      break;
    case Leaders::kSector:
      lead_by_sector(m, cells, leader);
      break;
    case Leaders::kNearest:
      lead_nearest(m, cells, leader);
      break;
  }
  return leader;
}

bool choose_leaders(const Params& params, const State& s, std::span<const double> dcm_radius,
                    std::span<const double> cbm_radius, std::vector<std::uint8_t>& leader,
                    std::int64_t& interval) {
  const Motility& m = params.motility;
  const std::int64_t now = grid_interval(s.clock.time - s.clock.origin, m.leader_grid);
  const std::size_t n_lane = s.dcm.n_lane(), n = n_lane + s.cbm.n_cell();
  if (now == interval && leader.size() == n) return false;
  interval = now;
  leader.resize(n, 0);
  std::vector<PolarCell> cells(n);
  for (std::size_t l = 0; l < n_lane; ++l)
    if (s.dcm.active(l)) cells[l] = make_polar(m, dcm::cell_center(s.dcm, l), dcm_radius[l]);
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c)
    cells[n_lane + c] = make_polar(m, cbm::center_of(s.cbm, c), cbm_radius[c]);
  for (std::size_t i = 0; i < n; ++i) cells[i].led = leader[i] != 0;
  std::vector<contact::Plane> walls = params.boundary.planes;
  for (contact::Plane& wall : walls) contact::stop_wall(wall, wall_time(s.clock, s.clock.time));
  leader = find_leaders(m, cells, walls);
  return true;
}

}  // namespace acinus::coupling
