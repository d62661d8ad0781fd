#include <algorithm>
#include <cmath>

#include "coupling/apparatus/suction/suction.hpp"
#include "runs/experiments/single_cell.hpp"

namespace acinus::runs {
namespace {

/// Volume of a ball from which a plane has cut a cap with a rim of the radius `rim`, um^3.
double volume_without_cap(double radius, double rim) {
  const double height = radius - std::sqrt(radius * radius - rim * rim);
  return 4 * kPi / 3 * std::pow(radius, 3) - kPi * height * height * (radius - height / 3);
}

}  // namespace

double closed_form_suction(double tension, double pipette_radius, double cell_radius) {
  const double rest =
      4 * kPi / 3 * std::pow(cell_radius, 3) - 2 * kPi / 3 * std::pow(pipette_radius, 3);
  // The volume grows with the radius, and the ball is never larger than the cell and its cap.
  double low = pipette_radius, high = 2 * cell_radius;
  constexpr int kHalvings = 60;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = (low + high) / 2;
    (volume_without_cap(middle, pipette_radius) < rest ? low : high) = middle;
  }
  return 2 * tension * (1 / pipette_radius - 1 / low);
}

void sample_aspiration(const ObservedFrame& f, Measures& m) {
  const coupling::Suction& s = f.world.params.apparatus.get<coupling::Suction>();
  const std::vector<Vec3> node = first_cell(f.world);
  double length = node.empty() ? kNotMeasured : 0;
  for (const Vec3& x : node) {
    const Vec3 d = x - s.mouth;
    if (d.cross(s.axis).norm() < s.reach) length = std::max(length, d.dot(s.axis));
  }
  m["suction_Pa"].push_back(1e3 * s.load_at(f.snapshot.time).pressure);
  m["aspirated_length_um"].push_back(length);
}

std::optional<double> critical_suction(const PipetteBlock& p, const Measures& m) {
  const double wanted = p.radius + p.lip;
  const auto pressure = m.find("suction_Pa"), length = m.find("aspirated_length_um");
  if (pressure == m.end() || length == m.end()) return {};
  for (std::size_t k = 1; k < length->second.size(); ++k) {
    const double a = length->second[k - 1], b = length->second[k];
    if (!(b >= wanted && a < wanted)) continue;
    const double pa = pressure->second[k - 1], pb = pressure->second[k];
    return 1e-3 * (pa + (pb - pa) * (wanted - a) / (b - a));
  }
  return {};
}

}  // namespace acinus::runs
