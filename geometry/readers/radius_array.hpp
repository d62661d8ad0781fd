#pragma once
/// Array of vessel radii in a legacy VTK file.

#include <string>
#include <vector>

#include "geometry/network.hpp"
#include "geometry/readers/vtk_dataset.hpp"

namespace acinus::geometry {

/// Radii of vessels, one value a point or one a line.
struct RadiusArray {
  const VtkArray* array = nullptr;
  bool per_point = false;
  double factor = 1;  ///< to a radius: 0.5 for diameters

  double at(std::size_t i) const { return factor * array->value[i]; }
};

/// Finds the array of radii.
/// @param name  of the array; empty: one of the usual names, or the only one whose name has
///              "radius" in it
/// Throws Error where there is none, or several that disagree.
RadiusArray find_radius(const VtkLegacy& vtk, const std::string& name);

/// Collector of entries that are invalid as radii of vessels.
class BadRadii {
 public:
  /// Starts without entries. @param owner  "node" or "segment"
  explicit BadRadii(std::string owner) : owner_(std::move(owner)) {}
  static bool is_good(double radius);
  /// Adds an entry. @param name  of the node or segment, for the message
  void add(std::size_t place, const std::string& name, double value);
  bool any() const { return n_ > 0; }
  std::size_t place() const { return place_; }  ///< index of the first entry
  /// Message about all of them in one sentence. @param what  as "the radius"
  std::string message(const std::string& what) const;

 private:
  std::string owner_, first_, others_;
  std::size_t n_ = 0, place_ = 0;
  double value_ = 0;
};

}  // namespace acinus::geometry
