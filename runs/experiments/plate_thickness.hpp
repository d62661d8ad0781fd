#pragma once
/// Thickness of the plates that cells form between sinusoids.

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/network.hpp"
#include "runs/experiments/sections.hpp"

namespace acinus::runs {

/// Mean length and number of chords.
struct Chords {
  double mean = 0;  ///< um; 0 if there are none
  double count = 0;
};

/// Mean length of the pieces of horizontal lines that run through cells, those less than 1 um apart
/// counted as one: the stereological thickness of the cell phase. Lines run in four directions
/// 45 degrees apart, 6 um from each other. An infinite vertical plate of thickness T met at an
/// angle a gives T / sin a.
Chords measure_chords(const std::vector<Section>& sections);

/// Mean distance of the points from the nearest wall among the chosen segments, um, negative
/// inside; 0 without points or segments.
/// @param chosen  [segment] 1: counts
double mean_distance(std::span<const Vec3> points, const geometry::Network& network,
                     std::span<const std::uint8_t> chosen);

}  // namespace acinus::runs
