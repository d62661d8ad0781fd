#include "geometry/readers/read_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/sort_unique.hpp"
#include "geometry/bodies.hpp"
#include "geometry/measures.hpp"
#include "geometry/readers/input_file.hpp"
#include "geometry/readers/surface_formats.hpp"
#include "geometry/readers/vtk_legacy.hpp"
#include "geometry/triangulate.hpp"

namespace acinus::geometry {

namespace {

constexpr double kFarthest = 1e9;  // um: a kilometre

/// Attribute that numbers the bodies of a file; nullptr: none.
const VtkArray* find_numbers(const VtkLegacy& vtk) {
  for (const char* name : {"label", "regionid", "cell_id", "body"})
    for (const VtkArray& a : vtk.cell_data)
      if (lower_case(a.name) == name && a.components == 1) return &a;
  return nullptr;
}

/// Groups of faces, one for every value of the attribute.
class FaceGroups {
 public:
  FaceGroups(const VtkLegacy& vtk, std::size_t before)
      : array_(find_numbers(vtk)), before_(before) {}
  void fill(std::size_t face, std::size_t n_triangle, std::vector<int>& group) {
    if (array_ == nullptr) return;
    const double value = array_->value[before_ + face];
    const int number = number_.try_emplace(value, static_cast<int>(number_.size())).first->second;
    group.resize(n_triangle, number);
  }

 private:
  const VtkArray* array_;
  std::size_t before_;  ///< cells that precede the faces in the cell data
  std::map<double, int> number_;
};

// Entry of a polyhedron: the number of faces, then per face its number of nodes and the nodes.
Surface read_polyhedron(const VtkLegacy& vtk, std::size_t cell) {
  std::size_t at = vtk.cells.start[cell];
  const std::size_t end = vtk.cells.start[cell + 1];
  const auto next = [&]() {
    if (at >= end) {
      vtk.file.fail_at(
          vtk.position(vtk.cells, cell),
          fmt::format("polyhedron {}: its face list ends early. Write the file again.", cell));
    }
    return vtk.cells.index[at++];
  };
  Surface all;
  std::vector<std::vector<int>> face;
  const std::int64_t n_face = next();
  for (std::int64_t f = 0; f < n_face; ++f) {
    const std::int64_t n_corner = next();
    std::vector<int> corner;
    for (std::int64_t k = 0; k < n_corner; ++k) {
      const std::int64_t node = next();
      if (node < 0 || node >= static_cast<std::int64_t>(vtk.point.size())) {
        vtk.file.fail_at(
            vtk.position(vtk.cells, cell),
            fmt::format("polyhedron {}, face {} uses node {}, but the file has {} points, numbered "
                        "from 0. Correct the index.",
                        cell, f, node, vtk.point.size()));
      }
      corner.push_back(static_cast<int>(node));
    }
    face.push_back(std::move(corner));
  }
  if (at != end) {
    vtk.file.fail_at(
        vtk.position(vtk.cells, cell),
        fmt::format("polyhedron {}: {} values are left over after its {} faces. Write the file "
                    "again.",
                    cell, end - at, n_face));
  }
  // Local numbers first: copying all points of the file for each body would be quadratic.
  std::vector<int> used;
  for (const auto& corner : face) used.insert(used.end(), corner.begin(), corner.end());
  sort_unique(used);
  for (const int node : used) all.node.push_back(vtk.point[node]);
  for (std::size_t f = 0; f < face.size(); ++f) {
    for (int& node : face[f]) {
      node = static_cast<int>(std::lower_bound(used.begin(), used.end(), node) - used.begin());
    }
    const std::string fault = add_polygon(face[f], all);
    if (!fault.empty())
      vtk.file.fail_at(vtk.position(vtk.cells, cell),
                       fmt::format("polyhedron {}, face {}{}", cell, f, fault));
  }
  return all;
}

std::vector<Surface> read_vtk(const std::string& path) {
  const VtkLegacy vtk =
      read_vtk_legacy(path, {"POLYDATA", "UNSTRUCTURED_GRID"},
                      "Convert it to triangles (in ParaView: Extract Surface, Triangulate).");
  const bool grid = vtk.dataset == "UNSTRUCTURED_GRID";
  if (vtk.strips.size() > 0) {
    vtk.file.fail_at(vtk.position(vtk.strips, 0),
                     "TRIANGLE_STRIPS are not read. Save plain triangles (in ParaView: "
                     "filter Triangulate).");
  }
  std::vector<Surface> bodies;
  Soup soup;
  soup.surface.node = vtk.point;
  const VtkCells& faces = grid ? vtk.cells : vtk.polygons;
  FaceGroups groups(vtk, grid ? 0 : vtk.vertices.size() + vtk.lines.size());
  for (std::size_t c = 0; c < faces.size(); ++c) {
    const std::int64_t type = grid ? vtk.cell_type[c] : 7;
    if (type == 42) {
      bodies.push_back(read_polyhedron(vtk, c));
    } else if (type == 5 || type == 7 || type == 9) {
      const std::string what = fmt::format("face {}", c);
      const std::string fault = add_polygon(vtk.nodes_of(faces, c, what), soup.surface);
      if (!fault.empty()) vtk.file.fail_at(vtk.position(faces, c), what + fault);
      groups.fill(c, soup.surface.triangle.size(), soup.group);
    } else {
      vtk.file.fail_at(
          vtk.position(faces, c),
          fmt::format(
              "cell {} has type {}; allowed are 42 (polyhedron), 5 (triangle), 9 (quad) and 7 "
              "(polygon). Save the surface only (in ParaView: Extract Surface).",
              c, type));
    }
  }
  for (Surface& s : split_bodies(soup)) bodies.push_back(std::move(s));
  return bodies;
}

}  // namespace

std::string add_polygon(const std::vector<int>& corner, Surface& out) {
  if (corner.size() < 3 || corner.size() > kMaxPolygon)
    return fmt::format(" has {} corners; allowed are 3 to {}. Triangulate the mesh.", corner.size(),
                       kMaxPolygon);
  std::vector<int> sorted = corner;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    return " uses the same node twice. Remove collapsed faces from the mesh.";
  const auto triangle = triangulate(corner, out.node);
  out.triangle.insert(out.triangle.end(), triangle.begin(), triangle.end());
  return {};
}

std::vector<Surface> read_surfaces(const std::string& path, double um_per_unit) {
  check(std::isfinite(um_per_unit) && um_per_unit > 0,
        fmt::format("{}: the file unit is {} um; it must be above 0.", path, um_per_unit));
  const std::string extension = extension_of(path);
  std::vector<Surface> bodies;
  if (extension == ".obj") {
    bodies = split_bodies(read_obj(path));
  } else if (extension == ".stl") {
    bodies = split_bodies(read_stl(path));
  } else if (extension == ".ply") {
    bodies = split_bodies(read_ply(path));
  } else if (extension == ".vtk" || extension == ".vtp" || extension == ".vtu") {
    bodies = read_vtk(path);
  } else {
    throw Error(
        fmt::format("{}: surfaces are read from .vtk (legacy), .obj, .stl and .ply, not {}. "
                    "Convert the file or "
                    "rename it after its format.",
                    path, in_quotes(extension)));
  }
  check(!bodies.empty(),
        fmt::format("{}: the file holds no faces. Save the surface with its polygons.", path));
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (std::size_t k = 0; k < bodies[b].node.size(); ++k) {
      Vec3& x = bodies[b].node[k];
      x *= um_per_unit;
      check(
          x.cwiseAbs().maxCoeff() <= kFarthest,
          fmt::format("{}: body {}: node {} is at ({:.6g}, {:.6g}, {:.6g}) um; coordinates may be "
                      "up to {} um. Check the unit of the file.",
                      path, b, k, x[0], x[1], x[2], kFarthest));
    }
  return bodies;
}

std::vector<Surface> read_closed_surfaces(const std::string& path, double um_per_unit) {
  std::vector<Surface> bodies = read_surfaces(path, um_per_unit);
  std::vector<bool> inward;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    inward.push_back(compute_volume(bodies[b].node, bodies[b].triangle) < 0);
    check_closed(bodies[b], fmt::format("{}: body {}", path, b));
  }
  // Turned the other way than what is about it, a surface bounds a cavity; bodies are solid here.
  if (const Nested n = find_nested(bodies); n.inner >= 0 && inward[n.inner] != inward[n.outer])
    throw Error(
        fmt::format("{}: body {} lies inside body {} and is turned the other way: a cavity "
                    "(lumen) in it. Bodies are solid here: leave the inner surface out.",
                    path, n.inner, n.outer));
  return bodies;
}

}  // namespace acinus::geometry
