#include "runs/experiments/lobule_domain.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/generate/domain.hpp"

namespace acinus::runs {
namespace {

constexpr double kGrid = 2;  // um

/// Volume of the domain that lies in vessels.
double vessel_volume(const coupling::Domain& domain, const geometry::Network& network) {
  int n[3];
  for (int k = 0; k < 3; ++k)
    n[k] = std::max(1, static_cast<int>(std::ceil((domain.high[k] - domain.low[k]) / kGrid)));
  const auto count = [&](int k) { return static_cast<std::size_t>(n[k]); };
  std::vector<bool> inside(count(0) * count(1) * count(2));
  for (std::size_t s = 0; s < network.segment.size(); ++s) {
    const Vec3 &a = network.node[network.segment[s][0]], &b = network.node[network.segment[s][1]];
    const double margin = std::max(network.radius[s][0], network.radius[s][1]);
    int first[3], last[3];
    for (int k = 0; k < 3; ++k) {
      const auto cell = [&](double x) {
        return std::clamp(static_cast<int>(std::floor((x - domain.low[k]) / kGrid)), 0, n[k] - 1);
      };
      first[k] = cell(std::min(a[k], b[k]) - margin);
      last[k] = cell(std::max(a[k], b[k]) + margin);
    }
    for (int z = first[2]; z <= last[2]; ++z)
      for (int y = first[1]; y <= last[1]; ++y)
        for (int x = first[0]; x <= last[0]; ++x) {
          const Vec3 p = domain.low + kGrid * Vec3(x + 0.5, y + 0.5, z + 0.5);
          if (contact::gap_to_segment(network, static_cast<int>(s), p).gap < 0 &&
              coupling::depth_inside(domain, p) > 0)
            inside[(static_cast<std::size_t>(z) * count(1) + static_cast<std::size_t>(y)) *
                       count(0) +
                   static_cast<std::size_t>(x)] = true;
        }
  }
  return kGrid * kGrid * kGrid * static_cast<double>(std::ranges::count(inside, true));
}

}  // namespace

LobuleDomain make_lobule_domain(const Scene& scene, const contact::Vessels& vessels) {
  const LobuleBlock& b = *scene.lobule;
  LobuleDomain lobule;
  lobule.frame = {b.height, b.central_vein_radius, scene.cell_types.begin()->second.radius};
  lobule.axis = scene.axis_point;
  if (b.shape == coupling::LobuleShape::kPie) {
    lobule.from_angle = -kPi / 6;
    lobule.to_angle = kPi / 6;
  }
  coupling::LobuleParameters p;
  p.shape = b.shape;
  p.radius = b.radius;
  p.height = b.height;
  p.lesion_radius = b.lesion_radius;
  p.central_vein_radius = b.central_vein_radius;
  p.portal_vein_radius = b.portal_vein_radius;
  const coupling::Domain domain = coupling::make_domain(p);
  lobule.free_volume = domain.volume - vessel_volume(domain, vessels.network);
  for (const auto& [at_a, at_b] : vessels.network.radius)
    lobule.sinusoid.push_back(std::max(at_a, at_b) < b.central_vein_radius ? 1 : 0);
  return lobule;
}

}  // namespace acinus::runs
