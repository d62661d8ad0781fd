#pragma once
/// Horizontal sections through the cells, and chords of lines in them.

#include <array>
#include <span>
#include <vector>

#include "contact/surface.hpp"
#include "core/vec.hpp"

namespace acinus::runs {

using Vec2 = Eigen::Vector2d;

/// Section of a cell by a plane z = const: a circle, or the sides of a polygon in no order.
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

/// Piece of a line inside a body: distances along the line, um.
using Chord = std::array<double, 2>;

/// Pieces of the line from + t along that lie in an outline, ascending.
/// @param along  unit
std::vector<Chord> compute_chords(const Outline& outline, const Vec2& from, const Vec2& along);

/// Pieces that lie in any cell, those less than `join` apart as one, ascending.
std::vector<Chord> covered_pieces(const Section& section, const Vec2& from, const Vec2& along,
                                  double join);

/// Heights at the middles of `count` equal slices of [0, height].
std::vector<double> slice_heights(double height, int count);

}  // namespace acinus::runs
