#include "core/mesh/read_network.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <unordered_map>

#include "core/error.hpp"
#include "core/mesh/read_vmv.hpp"
#include "core/mesh/vtk_legacy.hpp"

namespace acinus::mesh {

namespace {

constexpr const char* kRadiusNames = "\"radius\", \"radii\", \"r\", \"diameter\" or \"diameters\"";

struct RadiusArray {
  const VtkArray* array = nullptr;
  bool per_point = false;
  double factor = 1;  ///< 0.5 for diameters
};

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

RadiusArray find_radius(const VtkLegacy& vtk) {
  for (const bool per_point : {true, false}) {
    const auto& arrays = per_point ? vtk.point_data : vtk.cell_data;
    for (const auto& [name, factor] :
         {std::pair{"radius", 1.0}, std::pair{"radii", 1.0}, std::pair{"r", 1.0},
          std::pair{"diameter", 0.5}, std::pair{"diameters", 0.5}}) {
      for (const VtkArray& array : arrays) {
        if (lower_case(array.name) != name) continue;
        if (array.components != 1) {
          vtk.file.fail_at(array.place.begin,
                           fmt::format("array {} has {} components; a radius has 1. Save it as a "
                                       "scalar.",
                                       in_quotes(array.name), array.components));
        }
        return {&array, per_point, factor};
      }
    }
  }
  throw Error(fmt::format(
      "{}: no radius array. Arrays found: {}. Give every point or every line a radius: a scalar "
      "array in POINT_DATA or CELL_DATA called {}.",
      vtk.file.path(), list_arrays(vtk), kRadiusNames));
}

double checked_radius(const VtkLegacy& vtk, const RadiusArray& radius, std::size_t i,
                      const std::string& owner) {
  const double value = radius.array->value[i];
  if (!std::isfinite(value) || value <= 0) {
    vtk.file.fail_at(
        vtk.position(radius.array->place, i),
        fmt::format(
            "{} has {} {}; it must be a finite number above 0. Repair the value or remove the {}.",
            owner, in_quotes(radius.array->name), value, radius.per_point ? "node" : "segment"));
  }
  return radius.factor * value;
}

Network read_vtk_network(const std::string& path) {
  const VtkLegacy vtk = read_vtk_legacy(
      path, {"POLYDATA"}, "Save the vessels as lines (in ParaView: Extract Surface, then save).");
  if (vtk.lines.size() == 0) {
    throw Error(fmt::format(
        "{}: the file has no LINES. Save the vessel segments as lines of POLYDATA.", path));
  }
  const RadiusArray radius = find_radius(vtk);
  Network out;
  out.node = vtk.point;
  std::vector<double> node_radius;
  if (radius.per_point) {
    for (std::size_t i = 0; i < vtk.point.size(); ++i) {
      node_radius.push_back(checked_radius(vtk, radius, i, fmt::format("node {}", i)));
    }
  }
  for (std::size_t c = 0; c < vtk.lines.size(); ++c) {
    const std::string what = fmt::format("line {}", c);
    const std::vector<int> line = vtk.nodes_of(vtk.lines, c, what);
    if (line.size() < 2) {
      vtk.file.fail_at(vtk.position(vtk.lines, c),
                       fmt::format("{} has {} points; a segment needs 2 or more. Remove it.", what,
                                   line.size()));
    }
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      if (line[k] == line[k + 1]) {
        vtk.file.fail_at(vtk.position(vtk.lines, c),
                         fmt::format("{} joins node {} to itself. Remove it.", what, line[k]));
      }
      out.segment.push_back({line[k], line[k + 1]});
      if (radius.per_point) {
        out.radius.push_back({node_radius[line[k]], node_radius[line[k + 1]]});
      } else {
        // Cell data count the vertices first, then the lines.
        const double r =
            checked_radius(vtk, radius, vtk.vertices.size() + c,
                           fmt::format("segment {} (nodes {}-{})", c, line.front(), line.back()));
        out.radius.push_back({r, r});
      }
    }
  }
  return out;
}

struct SwcNode {
  std::int64_t id = 0, parent = 0;
  double radius = 0;
  std::size_t place = 0;
};

std::optional<SwcNode> read_swc_line(InputFile& file, Vec3& x) {
  const std::size_t begin = file.position();
  const std::string_view line = file.next_line();
  const std::size_t first = line.find_first_not_of(" \t\r");
  if (first == line.npos || line[first] == '#') return std::nullopt;
  SwcNode node;
  node.place = begin;
  std::array<double, 7> value{};
  std::size_t n = 0;
  for (std::size_t at = 0; (at = line.find_first_not_of(" \t\r,", at)) != line.npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t\r,", at), line.size());
    const std::string_view word = line.substr(at, end - at);
    if (word[0] == '#') break;
    const bool whole = n == 0 || n == 6;
    bool good = n < 7;
    if (good && whole) good = parse_integer(word, n == 0 ? node.id : node.parent);
    if (good && !whole) good = parse_double(word, value[n]);
    if (!good) {
      file.fail_at(
          begin,
          fmt::format(
              "found {} in column {}; an SWC line is \"id type x y z radius parent\", with whole "
              "numbers for id and parent. Repair the line.",
              in_quotes(word), n + 1));
    }
    ++n;
    at = end;
  }
  if (n != 7) {
    file.fail_at(
        begin,
        fmt::format(
            "the line has {} columns; an SWC line has 7: id type x y z radius parent. Repair "
            "the line; if it is the last, the file is truncated.",
            n));
  }
  x = Vec3(value[2], value[3], value[4]);
  node.radius = value[5];
  if (!x.allFinite()) {
    file.fail_at(
        begin,
        fmt::format(
            "node {} has the coordinates ({}, {}, {}); they must be finite numbers. Repair or "
            "remove the node.",
            node.id, x.x(), x.y(), x.z()));
  }
  if (!std::isfinite(node.radius) || node.radius <= 0) {
    file.fail_at(
        begin,
        fmt::format(
            "node {} has the radius {}; it must be a finite number above 0. Repair the value or "
            "remove the node.",
            node.id, node.radius));
  }
  return node;
}

Network read_swc(InputFile& file) {
  Network out;
  std::vector<SwcNode> nodes;
  std::unordered_map<std::int64_t, int> index;
  while (file.remaining() > 0) {
    Vec3 x;
    const std::optional<SwcNode> node = read_swc_line(file, x);
    if (!node) continue;
    if (!index.try_emplace(node->id, static_cast<int>(nodes.size())).second) {
      file.fail_at(
          node->place,
          fmt::format("node {} is defined a second time. Give every node its own id.", node->id));
    }
    nodes.push_back(*node);
    out.node.push_back(x);
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].parent < 0) continue;  // a root
    const auto parent = index.find(nodes[i].parent);
    if (parent == index.end() || nodes[i].parent == nodes[i].id) {
      file.fail_at(
          nodes[i].place,
          fmt::format("node {} has the parent {}, which is {}. Name an existing node, or -1 for "
                      "a root.",
                      nodes[i].id, nodes[i].parent,
                      parent == index.end() ? "not in the file" : "the node itself"));
    }
    const int up = parent->second;
    out.segment.push_back({up, static_cast<int>(i)});
    out.radius.push_back({nodes[up].radius, nodes[i].radius});
  }
  check(!out.segment.empty(),
        fmt::format("{}: the file has {} nodes but no segment. Give nodes a parent: id type x y z "
                    "radius parent.",
                    file.path(), nodes.size()));
  return out;
}

}  // namespace

Network read_network(const std::string& path) {
  InputFile file(path);
  const std::string extension = extension_of(path);
  if (extension == ".swc") return read_swc(file);
  if (extension == ".vmv") return read_vmv(file);
  if (extension == ".vtk" || extension == ".vtp" || extension == ".vtu" || is_vtk_legacy(file)) {
    return read_vtk_network(path);
  }
  throw Error(
      fmt::format("{}: vessel networks are read from legacy VTK (.vtk), SWC (.swc) and VMV (.vmv), "
                  "not {}. Convert the file or rename it after its format.",
                  path, in_quotes(extension)));
}

}  // namespace acinus::mesh
