#pragma once
/// The array of a legacy VTK file that holds the radii of its vessels.

#include <string>
#include <vector>

#include "geometry/network.hpp"
#include "geometry/readers/vtk_dataset.hpp"

namespace acinus::geometry {

/// One value a point or one a line.
struct RadiusArray {
  const VtkArray* array = nullptr;
  bool per_point = false;
  double factor = 1;  ///< 0.5 for diameters

  double at(std::size_t i) const { return factor * array->value[i]; }
};

/// @param name  of the array; empty: one of the usual names, or the only one whose name has
/// "radius" in it
/// Throws Error where there is none, or several that disagree.
RadiusArray find_radius(const VtkLegacy& vtk, const std::string& name);

/// Entries of an array that are no radii of vessels.
class BadRadii {
 public:
  /// @param owner  "node" or "segment"
  explicit BadRadii(std::string owner) : owner_(std::move(owner)) {}
  static bool is_good(double radius);
  /// @param name  of the node or segment, for the message
  void add(std::size_t place, const std::string& name, double value);
  bool any() const { return n_ > 0; }
  std::size_t place() const { return place_; }  ///< of the first, as it was given
  /// All of them in one sentence. @param what  as "the radius"
  std::string message(const std::string& what) const;

 private:
  std::string owner_, first_, others_;
  std::size_t n_ = 0, place_ = 0;
  double value_ = 0;
};

}  // namespace acinus::geometry
