#include "runs/experiments/plate_thickness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/boundary.hpp"

namespace acinus::runs {
namespace {

constexpr double kJoin = 1, kSpacing = 6;  // um
constexpr int kDirections = 4;

/// Offsets of the lines that can cross a cell: first and last multiple of the spacing.
std::array<int, 2> offsets(const Section& section, const Vec2& across) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Outline& o : section.outline) {
    const double at = across.dot(o.center);
    low = std::min(low, at - o.reach);
    high = std::max(high, at + o.reach);
  }
  return {static_cast<int>(std::ceil(low / kSpacing)),
          static_cast<int>(std::floor(high / kSpacing))};
}

}  // namespace

Chords measure_chords(const std::vector<Section>& sections) {
  Chords chords;
  double sum = 0;
  for (const Section& section : sections) {
    if (section.outline.empty()) continue;
    for (int d = 0; d < kDirections; ++d) {
      const Vec2 along(std::cos(kPi * d / kDirections), std::sin(kPi * d / kDirections)),
          across(-along.y(), along.x());
      const auto [first, last] = offsets(section, across);
      for (int k = first; k <= last; ++k)
        for (const Chord& c : covered_pieces(section, k * kSpacing * across, along, kJoin)) {
          sum += c[1] - c[0];
          ++chords.count;
        }
    }
  }
  if (chords.count > 0) chords.mean = sum / chords.count;
  return chords;
}

double mean_distance(std::span<const Vec3> points, const geometry::Network& network,
                     std::span<const std::uint8_t> chosen) {
  if (points.empty() || std::ranges::count(chosen, 1) == 0) return 0;
  double sum = 0;
  for (const Vec3& x : points) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < chosen.size(); ++s) {
      if (chosen[s] == 0) continue;
      const Vec3 &a = network.node[network.segment[s][0]], &b = network.node[network.segment[s][1]];
      const double bound = (x - 0.5 * (a + b)).norm() - 0.5 * (b - a).norm() -
                           std::max(network.radius[s][0], network.radius[s][1]);
      if (bound < least)
        least = std::min(least, contact::gap_to_segment(network, static_cast<int>(s), x).gap);
    }
    sum += least;
  }
  return sum / static_cast<double>(points.size());
}

}  // namespace acinus::runs
