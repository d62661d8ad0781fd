#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>

#include "core/error.hpp"
#include "geometry/readers/surface_formats.hpp"

namespace acinus::geometry {

namespace {

struct ObjFace {
  std::size_t place = 0;
  std::vector<int> corner;
  int group = 0;
};

// The words of the next line, with lines that end in a backslash joined and comments cut.
std::vector<std::string> next_words(InputFile& file) {
  std::string line;
  for (bool more = true; more;) {
    std::string_view part = file.next_line();
    more = !part.empty() && part.back() == '\\' && file.remaining() > 0;
    if (more) part.remove_suffix(1);
    line += part;
    line += ' ';
  }
  line.resize(std::min(line.find('#'), line.size()));
  std::vector<std::string> word;
  for (std::size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != line.npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    word.push_back(line.substr(at, end - at));
    at = end;
  }
  return word;
}

Vec3 parse_node(const InputFile& file, std::size_t place, const std::vector<std::string>& word,
                std::size_t number) {
  Vec3 x = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const bool good = k + 1 < word.size() && parse_double(word[k + 1], x[static_cast<int>(k)]);
    if (good && is_coordinate(Vec3::Constant(x[static_cast<int>(k)]))) continue;
    file.fail_at(place, fmt::format("coordinate {} of node {} is {}; allowed is \"v x y z\" with "
                                    "finite numbers below 1e15. Repair the line.",
                                    k + 1, number,
                                    k + 1 < word.size() ? in_quotes(word[k + 1]) : "missing"));
  }
  return x;
}

ObjFace parse_face(const InputFile& file, std::size_t place, const std::vector<std::string>& word,
                   std::size_t n_node) {
  ObjFace face{place, {}, 0};
  for (std::size_t k = 1; k < word.size(); ++k) {
    std::int64_t index = 0;
    const bool good = parse_integer(word[k].substr(0, word[k].find('/')), index);
    if (index < 0) index += static_cast<std::int64_t>(n_node) + 1;  // counted from the end
    if (!good || index < 1 || index > std::numeric_limits<int>::max()) {
      file.fail_at(place, fmt::format("a face uses node {}; allowed are whole numbers from 1, or "
                                      "negative ones counted back from the last node. Correct the "
                                      "index.",
                                      in_quotes(word[k])));
    }
    face.corner.push_back(static_cast<int>(index - 1));
  }
  return face;
}

/// True for a keyword of OBJ. Other words are errors: a damaged letter must not hide a face.
bool is_keyword(const std::string& word) {
  constexpr std::array<std::string_view, 40> kKnown{
      "vn",     "vt",     "vp",     "fo",       "l",        "p",     "s",          "mg",
      "usemtl", "mtllib", "usemap", "maplib",   "cstype",   "deg",   "bmat",       "step",
      "curv",   "curv2",  "surf",   "parm",     "trim",     "hole",  "scrv",       "sp",
      "end",    "con",    "bevel",  "c_interp", "d_interp", "lod",   "shadow_obj", "trace_obj",
      "ctech",  "stech",  "call",   "csh",      "vc",       "illum", "o",          "g"};
  return std::ranges::find(kKnown, word) != kKnown.end();
}

/// Throws Error at faces with nodes that are not in the file, and where its last nodes are in no
/// face: OBJ states no counts, so these alone reveal a truncated file.
void check_corners(const InputFile& file, const std::vector<ObjFace>& faces, std::size_t last_used,
                   std::size_t n_node) {
  std::size_t n_bad = 0, first_bad = 0;
  int bad_node = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const std::size_t node : faces[f].corner) {
      last_used = std::max(last_used, node + 1);
      if (node < n_node) continue;
      if (n_bad++ > 0) continue;
      first_bad = f;
      bad_node = node;
    }
  }
  if (n_bad > 0)
    file.fail_at(
        faces[first_bad].place,
        fmt::format("face {} uses node {}, but the file has {} nodes{}. Correct the index.",
                    first_bad + 1, bad_node + 1, n_node,
                    n_bad > 1 ? fmt::format("; so do {} further corners", n_bad - 1) : ""));
  check(faces.empty() || last_used == n_node,
        fmt::format("{}: nodes {} to {}, the last of the file, are in no face: the file looks "
                    "truncated. Write it again, or remove these nodes.",
                    file.path(), last_used + 1, n_node));
}

}  // namespace

Soup read_obj(const std::string& path) {
  InputFile file(path);
  file.skip_byte_order_mark();
  Soup soup;
  Surface& surface = soup.surface;
  std::vector<ObjFace> faces;  // cut after all nodes are known: OBJ allows nodes behind faces
  std::map<std::array<std::string, 2>, int> number;  // by the last names after o and g
  std::array<std::string, 2> name;
  std::size_t last_used = 0;  ///< 1 + last node used by elements other than faces
  while (file.remaining() > 0) {
    const std::size_t place = file.position();
    const std::vector<std::string> word = next_words(file);
    if (word.empty()) continue;
    if (word[0] == "v") {
      surface.node.push_back(parse_node(file, place, word, surface.node.size() + 1));
    } else if (word[0] == "f") {
      faces.push_back(parse_face(file, place, word, surface.node.size()));
      faces.back().group = number.try_emplace(name, static_cast<int>(number.size())).first->second;
    } else if (word[0] == "l" || word[0] == "p") {  // lines and points use nodes as well
      for (const std::size_t node : parse_face(file, place, word, surface.node.size()).corner)
        last_used = std::max(last_used, node + 1);
    } else if (word[0] == "g" || word[0] == "o") {
      name[word[0] == "g" ? 1 : 0] = fmt::format("{}", fmt::join(word, " "));
    } else if (!is_keyword(word[0])) {
      file.fail_at(place, fmt::format("found {} where an OBJ keyword (v, f, ...) is expected. The "
                                      "file is not OBJ text or is damaged.",
                                      in_quotes(word[0])));
    }
  }
  check_corners(file, faces, last_used, surface.node.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::string fault = add_polygon(faces[f].corner, surface);
    if (!fault.empty()) file.fail_at(faces[f].place, fmt::format("face {}{}", f + 1, fault));
    soup.group.resize(surface.triangle.size(), faces[f].group);
  }
  return soup;
}

}  // namespace acinus::geometry
