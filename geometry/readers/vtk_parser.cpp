#include "geometry/readers/vtk_parser.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "core/vec.hpp"
#include "geometry/readers/vtk_types.hpp"

namespace acinus::geometry {

const VtkType& VtkParser::type(std::string_view what) {
  const std::string_view token = file_.next_token();
  if (const VtkType* found = find_vtk_type(token)) return *found;
  file_.fail(fmt::format(
      "{} has data type {}; allowed are float, double, (unsigned_)char, short, int, long, "
      "vtkIdType and vtktypeint64. Save the array with one of these, or leave it out.",
      what, in_quotes(token)));
}

std::uint64_t VtkParser::count(std::string_view what) {
  const std::int64_t n = file_.next_integer(what);
  // Node and segment indices are int in the program.
  if (n < 0 || n > std::numeric_limits<int>::max()) {
    file_.fail(
        fmt::format("{} is {}; allowed are 0 to {}.", what, n, std::numeric_limits<int>::max()));
  }
  return static_cast<std::uint64_t>(n);
}

void VtkParser::start_data() {
  if (file_.binary()) file_.next_line();
}

void VtkParser::header(const std::vector<std::string>& allowed, const std::string& remedy) {
  file_.skip_byte_order_mark();
  const std::string_view start = file_.bytes().substr(file_.position(), 512);
  if (start.find("<VTKFile") != start.npos || start.rfind("<?xml", 0) == 0) {
    file_.fail(
        "the file is VTK XML (.vtp, .vtu, ...), which is not read. Save it as legacy VTK (.vtk), "
        "for instance in ParaView: File > Save Data > \"Legacy VTK Files\".");
  }
  if (!is_vtk_legacy(file_)) {
    file_.fail(fmt::format(
        "the first line is {}; a legacy VTK file begins with \"# vtk DataFile Version\". "
        "Check that it is the file you meant.",
        in_quotes(file_.next_line())));
  }
  file_.next_line();
  file_.next_line();  // title, any text
  const std::string_view mode = file_.next_token();
  if (lower_case(mode) == "binary") {
    file_.next_line();
  } else if (lower_case(mode) != "ascii") {
    file_.fail(fmt::format("found {}; line 3 of a legacy VTK file says ASCII or BINARY.",
                           in_quotes(mode)));
  }
  const std::string_view keyword = file_.next_token();
  if (lower_case(keyword) != "dataset") {
    file_.fail(fmt::format("found {} where DATASET is expected.", in_quotes(keyword)));
  }
  out_.dataset = file_.next_token();
  std::transform(out_.dataset.begin(), out_.dataset.end(), out_.dataset.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  if (std::find(allowed.begin(), allowed.end(), out_.dataset) == allowed.end()) {
    file_.fail(fmt::format("DATASET {} cannot be used here; allowed: {}. {}",
                           in_quotes(out_.dataset), fmt::join(allowed, ", "), remedy));
  }
  file_.set_binary(lower_case(mode) == "binary");
}

void VtkParser::check_order(const std::string& keyword) {
  const bool repeats = keyword == "point_data" || keyword == "cell_data" || keyword == "field" ||
                       keyword == "metadata";
  if (repeats) return;
  if (std::find(seen_.begin(), seen_.end(), keyword) != seen_.end())
    file_.fail(
        fmt::format("the section {} comes a second time. The file is damaged, or two are "
                    "in one: write it again.",
                    keyword));
  if (attributes_ != Attributes::kNone)
    file_.fail(
        fmt::format("the section {} stands behind POINT_DATA or CELL_DATA, which must come "
                    "last. Write the file again.",
                    keyword));
  seen_.push_back(keyword);
}

void VtkParser::sections() {
  static constexpr std::pair<const char*, void (*)(VtkParser&)> kSections[] = {
      {"points", [](VtkParser& p) { p.points(); }},
      {"vertices", [](VtkParser& p) { p.cells(p.out_.vertices, "VERTICES"); }},
      {"lines", [](VtkParser& p) { p.cells(p.out_.lines, "LINES"); }},
      {"polygons", [](VtkParser& p) { p.cells(p.out_.polygons, "POLYGONS"); }},
      {"triangle_strips", [](VtkParser& p) { p.cells(p.out_.strips, "TRIANGLE_STRIPS"); }},
      {"cells", [](VtkParser& p) { p.cells(p.out_.cells, "CELLS"); }},
      {"cell_types", [](VtkParser& p) { p.cell_types(); }},
      {"point_data", [](VtkParser& p) { p.attribute_count(Attributes::kPoint); }},
      {"cell_data", [](VtkParser& p) { p.attribute_count(Attributes::kCell); }},
      {"field", [](VtkParser& p) { p.field(); }},
      {"metadata", [](VtkParser& p) { p.metadata(); }}};
  for (std::string_view token = file_.next_token(); !token.empty(); token = file_.next_token()) {
    const std::string keyword = lower_case(token);
    const auto* section = std::find_if(std::begin(kSections), std::end(kSections),
                                       [&](const auto& entry) { return keyword == entry.first; });
    if (section != std::end(kSections)) {
      check_order(keyword);
      section->second(*this);
    } else if (!attribute(keyword)) {
      file_.fail(
          fmt::format("found {} where a section keyword (POINTS, LINES, POINT_DATA, ...) is "
                      "expected. The count of the section before is wrong or the file is "
                      "damaged.",
                      in_quotes(token)));
    }
  }
  if (!seen_points_) file_.fail("the file has no POINTS section. Save it with its points.");
  if (out_.cell_type.size() != out_.cells.size()) {
    file_.fail(
        fmt::format("CELLS has {} cells but CELL_TYPES {}; both must be there with equal counts.",
                    out_.cells.size(), out_.cell_type.size()));
  }
}

void VtkParser::points() {
  const std::uint64_t n = count("the number of POINTS");
  const VtkType& info = type("POINTS");
  start_data();
  VtkPlace place;
  const std::vector<double> xyz = values<double>(info, n, 3, "POINTS", place);
  out_.point.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    out_.point[i] = Vec3(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
    if (is_coordinate(out_.point[i])) continue;
    file_.fail_at(
        out_.position(place, 3 * i),
        fmt::format("node {} has the coordinates ({}, {}, {}); {}. Repair or remove the node.", i,
                    xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2], kCoordinateRule));
  }
  seen_points_ = true;
}

}  // namespace acinus::geometry
