#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <utility>

#include "geometry/readers/surface_formats.hpp"

namespace acinus::geometry {

namespace {

/// Merges corners of one solid with equal coordinates into one node: STL repeats every corner.
class CornerMerger {
 public:
  void start_solid() {
    index_.clear();
    ++solid_;
  }
  int add(const Vec3& x) {
    auto& node = soup.surface.node;
    const auto [entry, is_new] =
        index_.try_emplace({x.x() + 0.0, x.y() + 0.0, x.z() + 0.0}, static_cast<int>(node.size()));
    if (is_new) node.push_back(x);
    return entry->second;
  }
  void add_facet(const std::array<int, 3>& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return;
    soup.surface.triangle.push_back(t);
    soup.group.push_back(solid_);
  }
  Soup soup;

 private:
  std::map<std::array<double, 3>, int> index_;  // + 0.0 turns -0 into 0
  int solid_ = 0;
};

void read_stl_binary(InputFile& file, std::uint64_t n_facet, CornerMerger& merger) {
  file.set_binary(true);
  for (std::uint64_t f = 0; f < n_facet; ++f) {
    std::array<int, 3> triangle{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t begin = 84 + 50 * f + 12 * (corner + 1);
      Vec3 x;
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t raw = 0;  // little-endian
        for (std::size_t b = 4; b-- > 0;) {
          raw = raw << 8 | static_cast<unsigned char>(file.bytes()[begin + 4 * k + b]);
        }
        x[static_cast<int>(k)] = static_cast<double>(std::bit_cast<float>(raw));
      }
      if (!is_coordinate(x)) {
        file.fail_at(begin,
                     fmt::format("facet {} has a corner ({}, {}, {}); {}. Write the file again.", f,
                                 x.x(), x.y(), x.z(), kCoordinateRule));
      }
      triangle[corner] = merger.add(x);
    }
    merger.add_facet(triangle);
  }
}

void read_stl_text(InputFile& file, CornerMerger& merger) {
  std::vector<int> corner;
  bool finished = false;
  std::string name, end_name;  // of the last solid, where it begins and where it ends
  for (std::string_view token = file.next_token(); !token.empty(); token = file.next_token()) {
    const std::string word = lower_case(token);
    if (word == "solid" || word == "endsolid") {
      if (word == "solid") merger.start_solid();
      (word == "solid" ? name : end_name) = lower_case(file.next_line());
      finished = word == "endsolid";
    } else if (word == "vertex") {
      const std::size_t begin = file.position();
      Vec3 x;
      for (int k = 0; k < 3; ++k) x[k] = file.next_double("a coordinate of a vertex");
      if (!is_coordinate(x)) {
        file.fail_at(file.token_position(begin, 0),
                     fmt::format("a vertex is ({}, {}, {}); {}. Repair the line.", x.x(), x.y(),
                                 x.z(), kCoordinateRule));
      }
      corner.push_back(merger.add(x));
    } else if (word == "endloop") {
      if (corner.size() != 3) {
        file.fail(fmt::format("a facet has {} corners; STL facets have 3. Write the file again.",
                              corner.size()));
      }
      merger.add_facet({corner[0], corner[1], corner[2]});
      corner.clear();
    } else if (word == "facet") {
      file.next_line();  // the normal is not needed: the order of the corners holds it
    } else if (word != "outer" && word != "loop" && word != "endfacet") {
      file.fail(fmt::format(
          "found {} where an STL keyword (facet, vertex, endsolid, ...) is expected. The file is "
          "damaged.",
          in_quotes(token)));
    }
  }
  // A file without counts that was cut within its last line, between two solids.
  const bool cut = file.bytes().back() != '\n' && end_name != name && name.starts_with(end_name);
  if (!finished || !corner.empty() || cut)
    file.fail("the file ends before \"endsolid\" and its name. It looks truncated.");
}

}  // namespace

Soup read_stl(const std::string& path) {
  InputFile file(path);
  CornerMerger merger;
  std::uint64_t n_facet = 0;
  if (file.bytes().size() >= 84) {
    for (std::size_t b = 4; b-- > 0;)
      n_facet = n_facet << 8 | static_cast<unsigned char>(file.bytes()[80 + b]);
  }
  // A binary header may begin with "solid" too; its exact size decides.
  const bool exact = file.bytes().size() >= 84 && file.bytes().size() == 84 + 50 * n_facet;
  if (!exact) file.skip_byte_order_mark();
  if (!exact && lower_case(file.peek_token()) == "solid") {
    read_stl_text(file, merger);
  } else {
    if (!exact) {
      file.set_binary(true);
      file.fail_at(std::min<std::size_t>(80, file.bytes().size()),
                   fmt::format("{} bytes do not fit the {} facets a binary STL announces here (84 "
                               "+ 50 per facet), and "
                               "it does not begin with \"solid\". It is truncated or not STL.",
                               file.bytes().size(), n_facet));
    }
    read_stl_binary(file, n_facet, merger);
  }
  return std::move(merger.soup);
}

}  // namespace acinus::geometry
