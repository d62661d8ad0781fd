#pragma once
/// Horizontal sections through the cells, and where lines in them run inside cells.

#include <array>
#include <span>
#include <vector>

#include "contact/surface.hpp"
#include "core/vec.hpp"

namespace acinus::runs {

using Vec2 = Eigen::Vector2d;

/// A cell's cut with a plane z = const: a circle, or the sides of a polygon in no order.
struct Outline {
  Vec2 center = Vec2::Zero();             ///< um, of a circle that holds it
  double reach = 0;                       ///< um, radius of that circle
  bool round = false;                     ///< it is that circle
  std::vector<std::array<Vec2, 2>> side;  ///< um
};
struct Section {
  double z = 0;  ///< um
  std::vector<Outline> outline;
};

struct Ball {
  Vec3 center = Vec3::Zero();
  double radius = 0;
};

/// Sections at the given heights. Only cells that are cut appear.
std::vector<Section> make_sections(std::span<const contact::SurfaceBody> bodies,
                                   std::span<const Ball> balls, std::span<const double> height);

/// From where to where a line runs inside something, as distances along it, um.
using Chord = std::array<double, 2>;

/// The pieces of the line from + t along that lie in an outline, ascending.
/// @param along  unit
std::vector<Chord> find_chords(const Outline& outline, const Vec2& from, const Vec2& along);

/// The pieces that lie in any cell, those less than `join` apart as one, ascending.
std::vector<Chord> covered_pieces(const Section& section, const Vec2& from, const Vec2& along,
                                  double join);

/// `count` heights at the middles of equal slices of [0, height].
std::vector<double> slice_heights(double height, int count);

}  // namespace acinus::runs
