#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/mesh/surface_formats.hpp"

namespace acinus::mesh {

namespace {

struct ObjFace {
  std::size_t place = 0;
  std::vector<int> corner;
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
    if (good && x.allFinite()) continue;
    file.fail_at(place, fmt::format("coordinate {} of node {} is {}; allowed is \"v x y z\" with "
                                    "finite numbers. Repair the line.",
                                    k + 1, number,
                                    k + 1 < word.size() ? in_quotes(word[k + 1]) : "missing"));
  }
  return x;
}

ObjFace parse_face(const InputFile& file, std::size_t place, const std::vector<std::string>& word,
                   std::size_t n_node) {
  ObjFace face{place, {}};
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

}  // namespace

Surface read_obj(const std::string& path) {
  InputFile file(path);
  Surface soup;
  std::vector<ObjFace> faces;  // cut after all nodes are known: OBJ allows nodes behind faces
  while (file.remaining() > 0) {
    const std::size_t place = file.position();
    const std::vector<std::string> word = next_words(file);
    if (word.empty()) continue;
    if (word[0] == "v") {
      soup.node.push_back(parse_node(file, place, word, soup.node.size() + 1));
    } else if (word[0] == "f") {
      faces.push_back(parse_face(file, place, word, soup.node.size()));
    } else if (word[0].size() > 40 || word[0][0] < 'A' || word[0][0] > 'z') {
      file.fail_at(place, fmt::format("found {} where an OBJ keyword (v, f, ...) is expected. The "
                                      "file is not OBJ text or is damaged.",
                                      in_quotes(word[0])));
    }
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const int node : faces[f].corner) {
      if (static_cast<std::size_t>(node) < soup.node.size()) continue;
      file.fail_at(
          faces[f].place,
          fmt::format("face {} uses node {}, but the file has {} nodes. Correct the index.", f + 1,
                      node + 1, soup.node.size()));
    }
    add_polygon(file, faces[f].place, fmt::format("face {}", f + 1), faces[f].corner, soup);
  }
  return soup;
}

}  // namespace acinus::mesh
