#include "geometry/readers/radius_array.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"

namespace acinus::geometry {
namespace {

struct RadiusName {
  const char* name;
  double factor;
};
/// Usual names of radius arrays, in order of preference; the last three are MicrovesselChaste's and
/// VMTK's.
constexpr std::array<RadiusName, 8> kNames{{{"radius", 1},
                                            {"radii", 1},
                                            {"r", 1},
                                            {"diameter", 0.5},
                                            {"diameters", 0.5},
                                            {"node radius", 1},
                                            {"vessel radius", 1},
                                            {"maximuminscribedsphereradius", 1}}};

std::string list_arrays(const VtkLegacy& vtk) {
  std::string text;
  for (const auto& [arrays, section] :
       {std::pair{&vtk.point_data, "POINT_DATA"}, std::pair{&vtk.cell_data, "CELL_DATA"}}) {
    for (const VtkArray& array : *arrays) {
      text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", in_quotes(array.name), section);
    }
  }
  return text.empty() ? "none" : text;
}

RadiusArray checked(const VtkLegacy& vtk, const RadiusArray& found) {
  const VtkArray& array = *found.array;
  if (array.components != 1)
    vtk.file.fail_at(array.place.begin,
                     fmt::format("array {} has {} components; a radius has 1. Save it as a scalar.",
                                 in_quotes(array.name), array.components));
  return found;
}

std::vector<RadiusArray> all_arrays(const VtkLegacy& vtk) {
  std::vector<RadiusArray> all;
  for (const VtkArray& a : vtk.point_data) all.push_back({&a, true, 1});
  for (const VtkArray& a : vtk.cell_data) all.push_back({&a, false, 1});
  return all;
}

/// Throws Error if two arrays of radii disagree.
void check_alike(const VtkLegacy& vtk, const RadiusArray& a, const RadiusArray& b) {
  constexpr double kSame = 1e-3;
  for (std::size_t i = 0; i < std::min(a.array->value.size(), b.array->value.size()); ++i) {
    const double x = a.at(i), y = b.at(i);
    if (!(std::abs(x - y) > kSame * std::max(std::abs(x), std::abs(y)))) continue;
    vtk.file.fail_at(
        vtk.position(b.array->place, i),
        fmt::format("{} {} has the radius {:.6g} by the array {} and {:.6g} by {}. Say which "
                    "counts: --vessel-radius-array NAME, or vessels.radius_array in a scene.",
                    a.per_point ? "node" : "segment", i, x, in_quotes(a.array->name), y,
                    in_quotes(b.array->name)));
  }
}

RadiusArray named(const VtkLegacy& vtk, const std::string& name) {
  for (RadiusArray a : all_arrays(vtk)) {
    if (lower_case(a.array->name) != lower_case(name)) continue;
    if (lower_case(name).find("diameter") != name.npos) a.factor = 0.5;
    return checked(vtk, a);
  }
  throw Error(fmt::format("{}: no array {}. Arrays found: {}.", vtk.file.path(), in_quotes(name),
                          list_arrays(vtk)));
}

}  // namespace

RadiusArray find_radius(const VtkLegacy& vtk, const std::string& name) {
  if (!name.empty()) return named(vtk, name);
  const std::vector<RadiusArray> all = all_arrays(vtk);
  for (const bool per_point : {true, false}) {
    std::vector<RadiusArray> found;
    for (const RadiusName& usual : kNames)
      for (const RadiusArray& a : all)
        if (a.per_point == per_point && lower_case(a.array->name) == usual.name)
          found.push_back(checked(vtk, {a.array, per_point, usual.factor}));
    for (std::size_t k = 1; k < found.size(); ++k) check_alike(vtk, found[0], found[k]);
    if (!found.empty()) return found[0];
  }
  std::vector<RadiusArray> like;
  for (const RadiusArray& a : all)
    if (a.array->components == 1 && lower_case(a.array->name).find("radius") != std::string::npos)
      like.push_back(a);
  if (like.size() == 1) return like[0];
  throw Error(fmt::format(
      "{}: no radius array. Arrays found: {}. Give every point or every line a radius: a scalar "
      "array in POINT_DATA or CELL_DATA called \"radius\", \"radii\", \"r\", \"diameter\" or "
      "\"diameters\"; or name the array: --vessel-radius-array NAME, vessels.radius_array in a "
      "scene.",
      vtk.file.path(), list_arrays(vtk)));
}

bool BadRadii::is_good(double radius) {
  constexpr double kMost = 1e15;  // as of coordinates
  return radius > 0 && radius < kMost;
}

void BadRadii::add(std::size_t place, const std::string& name, double value) {
  constexpr std::size_t kNamed = 5;
  if (n_ == 0) {
    first_ = name;
    value_ = value;
    place_ = place;
  } else if (n_ <= kNamed) {
    others_ += fmt::format("{}{} ({})", n_ == 1 ? "" : ", ", name, value);
  } else if (n_ == kNamed + 1) {
    others_ += ", ...";
  }
  ++n_;
}

std::string BadRadii::message(const std::string& what) const {
  return fmt::format(
      "{} has {} {}; it must be a finite number above 0.{} Repair the value{} or "
      "remove the {}{}.",
      first_, what, value_, n_ > 1 ? fmt::format(" So for {} more: {}.", n_ - 1, others_) : "",
      n_ > 1 ? "s" : "", owner_, n_ > 1 ? "s" : "");
}

}  // namespace acinus::geometry
