#include "core/mesh/read_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/mesh/components.hpp"
#include "core/mesh/input_file.hpp"
#include "core/mesh/surface_formats.hpp"
#include "core/mesh/triangulate.hpp"
#include "core/mesh/vtk_legacy.hpp"

namespace acinus::mesh {

namespace {

void add_components(const Surface& soup, std::vector<Surface>& bodies) {
  for (Surface& s : split_components(soup)) bodies.push_back(std::move(s));
}

// Entry of a polyhedron: the number of faces, then per face its number of nodes and the nodes.
Surface read_polyhedron(const VtkLegacy& vtk, std::size_t cell) {
  const std::size_t place = vtk.position(vtk.cells, cell);
  std::size_t at = vtk.cells.start[cell];
  const std::size_t end = vtk.cells.start[cell + 1];
  const auto next = [&]() {
    if (at >= end) {
      vtk.file.fail_at(
          place,
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
            place,
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
        place,
        fmt::format("polyhedron {}: {} values are left over after its {} faces. Write the file "
                    "again.",
                    cell, end - at, n_face));
  }
  // Local numbers first: copying all points of the file for each body would be quadratic.
  std::vector<int> used;
  for (const auto& corner : face) used.insert(used.end(), corner.begin(), corner.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const int node : used) all.node.push_back(vtk.point[node]);
  for (std::size_t f = 0; f < face.size(); ++f) {
    for (int& node : face[f]) {
      node = static_cast<int>(std::lower_bound(used.begin(), used.end(), node) - used.begin());
    }
    add_polygon(vtk.file, place, fmt::format("polyhedron {}, face {}", cell, f), face[f], all);
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
  Surface soup;
  soup.node = vtk.point;
  const VtkCells& faces = grid ? vtk.cells : vtk.polygons;
  for (std::size_t c = 0; c < faces.size(); ++c) {
    const std::int64_t type = grid ? vtk.cell_type[c] : 7;
    if (type == 42) {
      bodies.push_back(read_polyhedron(vtk, c));
    } else if (type == 5 || type == 7 || type == 9) {
      const std::string what = fmt::format("face {}", c);
      add_polygon(vtk.file, vtk.position(faces, c), what, vtk.nodes_of(faces, c, what), soup);
    } else {
      vtk.file.fail_at(
          vtk.position(faces, c),
          fmt::format(
              "cell {} has type {}; allowed are 42 (polyhedron), 5 (triangle), 9 (quad) and 7 "
              "(polygon). Save the surface only (in ParaView: Extract Surface).",
              c, type));
    }
  }
  add_components(soup, bodies);
  return bodies;
}

}  // namespace

void add_polygon(const InputFile& file, std::size_t place, const std::string& what,
                 const std::vector<int>& corner, Surface& out) {
  if (corner.size() < 3 || corner.size() > kMaxPolygon) {
    file.fail_at(place, fmt::format("{} has {} corners; allowed are 3 to {}. Triangulate the mesh.",
                                    what, corner.size(), kMaxPolygon));
  }
  std::vector<int> sorted = corner;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
    file.fail_at(
        place,
        fmt::format("{} uses the same node twice. Remove collapsed faces from the mesh.", what));
  }
  const auto triangle = triangulate(corner, out.node);
  out.triangle.insert(out.triangle.end(), triangle.begin(), triangle.end());
}

std::vector<Surface> read_surfaces(const std::string& path, double um_per_unit) {
  check(std::isfinite(um_per_unit) && um_per_unit > 0,
        fmt::format("{}: the file unit is {} um; it must be above 0.", path, um_per_unit));
  const std::string extension = extension_of(path);
  std::vector<Surface> bodies;
  if (extension == ".obj") {
    add_components(read_obj(path), bodies);
  } else if (extension == ".stl") {
    add_components(read_stl(path), bodies);
  } else if (extension == ".ply") {
    add_components(read_ply(path), bodies);
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
  for (Surface& body : bodies) {
    for (Vec3& x : body.node) x *= um_per_unit;
  }
  return bodies;
}

std::vector<Surface> read_closed_surfaces(const std::string& path, double um_per_unit) {
  std::vector<Surface> bodies = read_surfaces(path, um_per_unit);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    check_closed(bodies[b], fmt::format("{}: body {}", path, b));
  return bodies;
}

}  // namespace acinus::mesh
