#include "geometry/readers/read_network.hpp"

#include <fmt/format.h>

#include <optional>
#include <sstream>
#include <unordered_map>

#include "core/error.hpp"
#include "geometry/readers/radius_array.hpp"
#include "geometry/readers/read_vmv.hpp"
#include "geometry/readers/vtk_legacy.hpp"

namespace acinus::geometry {

namespace {

/// Throws Error at invalid radii that segments use.
void check_radii(const VtkLegacy& vtk, const RadiusArray& radius) {
  BadRadii bad(radius.per_point ? "node" : "segment");
  for (std::size_t i = 0; radius.per_point && i < vtk.point.size(); ++i)
    if (!BadRadii::is_good(radius.at(i)))
      bad.add(i, fmt::format("node {}", i), radius.array->value[i]);
  for (std::size_t c = 0; !radius.per_point && c < vtk.lines.size(); ++c) {
    // Cell data count the vertices first, then the lines.
    const std::size_t i = vtk.vertices.size() + c;
    if (BadRadii::is_good(radius.at(i))) continue;
    const std::vector<int> line = vtk.nodes_of(vtk.lines, c, fmt::format("line {}", c));
    bad.add(i,
            line.empty() ? fmt::format("segment {}", c)
                         : fmt::format("segment {} (nodes {}-{})", c, line.front(), line.back()),
            radius.array->value[i]);
  }
  if (bad.any())
    vtk.file.fail_at(vtk.position(radius.array->place, bad.place()),
                     bad.message(in_quotes(radius.array->name)));
}

Network read_vtk_network(const std::string& path, const std::string& radius_array) {
  const VtkLegacy vtk = read_vtk_legacy(
      path, {"POLYDATA"}, "Save the vessels as lines (in ParaView: Extract Surface, then save).");
  if (vtk.lines.size() == 0) {
    throw Error(fmt::format(
        "{}: the file has no LINES. Save the vessel segments as lines of POLYDATA.", path));
  }
  const RadiusArray radius = find_radius(vtk, radius_array);
  check_radii(vtk, radius);
  Network out;
  out.node = vtk.point;
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
      const auto end = [&](std::size_t i) {
        return radius.at(radius.per_point ? static_cast<std::size_t>(line[i])
                                          : vtk.vertices.size() + c);
      };
      out.radius.push_back({end(k), end(k + 1)});
    }
  }
  return out;
}

struct SwcNode {
  std::int64_t id = 0, parent = 0;
  double radius = 0;
  std::size_t place = 0;
};

/// Throws Error at a comment between nodes that has the numbers of a node: a damaged digit makes
/// one of "3 ...".
void check_hidden_node(const InputFile& file, std::size_t place, std::string_view line) {
  std::istringstream words{std::string(line.substr(1))};
  std::size_t n = 0;
  for (std::string word; words >> word; ++n) {
    double value = 0;
    if (!parse_double(word, value)) return;
  }
  constexpr std::size_t kFewest = 6;
  if (n >= kFewest)
    file.fail_at(place, "a comment holds the numbers of a node. Remove the line, or the \"#\".");
}

/// Throws Error at "# SCALE 1 1 1" with other factors: the only statement of a header that changes
/// lengths.
void check_swc_comment(const InputFile& file, std::size_t place, std::string_view line) {
  std::istringstream words{std::string(line.substr(1))};
  std::string key;
  words >> key;
  if (lower_case(key) != "scale") return;
  for (double value = 1; words >> value;)
    if (value != 1)
      file.fail_at(place, fmt::format("the header says {}, which is not followed. Multiply the "
                                      "coordinates, or give the unit, and remove this line.",
                                      in_quotes(line)));
}

std::optional<SwcNode> read_swc_line(InputFile& file, bool is_first, Vec3& x) {
  const std::size_t begin = file.position();
  const std::string_view line = file.next_line();
  const std::size_t first = line.find_first_not_of(" \t\r");
  if (first == line.npos) return std::nullopt;
  if (line[first] == '#') {
    check_swc_comment(file, begin, line.substr(first));
    if (!is_first) check_hidden_node(file, begin, line.substr(first));
    return std::nullopt;
  }
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
  if (!is_coordinate(x))
    file.fail_at(begin, fmt::format("node {} has the coordinates ({}, {}, {}); {}. Repair or "
                                    "remove the node.",
                                    node.id, x.x(), x.y(), x.z(), kCoordinateRule));
  return node;
}

/// Throws Error at a last line without an end mark: SWC states no number of nodes, so that is the
/// only sign of a truncated file.
void check_swc_end(const InputFile& file) {
  if (file.bytes().back() == '\n' || file.bytes().back() == '\r') return;
  file.fail_at(file.bytes().size(),
               "the last line has no end, so the file may be truncated within a number. If it is "
               "complete, end it with a new line.");
}

Network read_swc(InputFile& file) {
  file.skip_byte_order_mark();
  check_swc_end(file);
  BadRadii bad("node");
  Network out;
  std::vector<SwcNode> nodes;
  std::unordered_map<std::int64_t, int> index;
  while (file.remaining() > 0) {
    Vec3 x;
    const std::optional<SwcNode> node = read_swc_line(file, nodes.empty(), x);
    if (!node) continue;
    if (!index.try_emplace(node->id, static_cast<int>(nodes.size())).second) {
      file.fail_at(
          node->place,
          fmt::format("node {} is defined a second time. Give every node its own id.", node->id));
    }
    if (!BadRadii::is_good(node->radius))
      bad.add(node->place, fmt::format("node {}", node->id), node->radius);
    nodes.push_back(*node);
    out.node.push_back(x);
  }
  if (bad.any()) file.fail_at(bad.place(), bad.message("the radius"));
  std::vector<std::size_t> orphan;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].parent < 0) continue;  // a root
    const auto parent = index.find(nodes[i].parent);
    if (parent == index.end() || nodes[i].parent == nodes[i].id) {
      orphan.push_back(i);
      continue;
    }
    const int up = parent->second;
    out.segment.push_back({up, static_cast<int>(i)});
    out.radius.push_back({nodes[up].radius, nodes[i].radius});
  }
  if (!orphan.empty()) {
    const SwcNode& first = nodes[orphan.front()];
    file.fail_at(
        first.place,
        fmt::format("node {} has the parent {}, which is {}.{} Name an existing node, or "
                    "-1 for a root.",
                    first.id, first.parent,
                    first.parent == first.id ? "the node itself" : "not in the file",
                    orphan.size() > 1 ? fmt::format(" So for {} more.", orphan.size() - 1) : ""));
  }
  check(!out.segment.empty(),
        fmt::format("{}: the file has {} nodes but no segment. Give nodes a parent: id type x y z "
                    "radius parent.",
                    file.path(), nodes.size()));
  return out;
}

}  // namespace

Network read_network(const std::string& path, const std::string& radius_array) {
  InputFile file(path);
  const std::string extension = extension_of(path);
  const bool swc = extension == ".swc", vmv = extension == ".vmv";
  check(radius_array.empty() || !(swc || vmv),
        fmt::format("{}: an array of radii ({}) can be named for VTK files only; here every line "
                    "has its radius. Leave the name out.",
                    path, in_quotes(radius_array)));
  if (swc) return read_swc(file);
  if (vmv) return read_vmv(file);
  if (extension == ".vtk" || extension == ".vtp" || extension == ".vtu" || is_vtk_legacy(file)) {
    return read_vtk_network(path, radius_array);
  }
  throw Error(
      fmt::format("{}: vessel networks are read from legacy VTK (.vtk), SWC (.swc) and VMV (.vmv), "
                  "not {}. Convert the file or rename it after its format.",
                  path, in_quotes(extension)));
}

}  // namespace acinus::geometry
