#include "geometry/readers/read_vmv.hpp"

#include <fmt/format.h>

#include <unordered_map>
#include <vector>

#include "core/error.hpp"
#include "geometry/readers/radius_array.hpp"

namespace acinus::geometry {
namespace {

class VmvParser {
 public:
  explicit VmvParser(InputFile& file) : file_(file) {}

  Network read() {
    while (file_.remaining() > 0) {
      const std::string_view word = file_.next_token();
      if (word == "$NUM_VERTS") {
        said_nodes_ = file_.next_integer("a number of nodes");
      } else if (word == "$NUM_STRANDS") {
        said_strands_ = file_.next_integer("a number of strands");
      } else if (word == "$VERT_LIST_BEGIN") {
        read_nodes();
      } else if (word == "$STRANDS_LIST_BEGIN") {
        read_strands();
      }  // connectivity and simulated radii are not needed
    }
    if (bad_.any()) file_.fail_at(bad_.place(), bad_.message("the radius"));
    check_count("$NUM_VERTS", said_nodes_, static_cast<std::int64_t>(out_.node.size()));
    check_count("$NUM_STRANDS", said_strands_, n_strand_);
    check(!out_.node.empty(),
          fmt::format("{}: no list of nodes: VMV files have $VERT_LIST_BEGIN, lines \"number x y z "
                      "radius\" and $VERT_LIST_END.",
                      file_.path()));
    check(
        !out_.segment.empty(),
        fmt::format("{}: no strands: VMV files have $STRANDS_LIST_BEGIN, lines \"number node node "
                    "...\" and $STRANDS_LIST_END.",
                    file_.path()));
    return std::move(out_);
  }

 private:
  bool at_end(std::string_view end) {
    if (file_.remaining() == 0 || file_.peek_token().empty())
      throw Error(fmt::format("{}: the file ends before {}. It is truncated.", file_.path(), end));
    return file_.peek_token() == end;
  }

  void check_count(const char* key, std::int64_t said, std::int64_t found) const {
    check(said < 0 || said == found,
          fmt::format("{}: {} says {}, but the list has {}. The file is truncated or damaged.",
                      file_.path(), key, said, found));
  }

  /// Tokens of the next line that has any.
  std::vector<std::string_view> next_words(std::size_t& place) {
    std::vector<std::string_view> words;
    while (words.empty() && file_.remaining() > 0) {
      place = file_.position();
      const std::string_view line = file_.next_line();
      for (std::size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != line.npos;) {
        const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
        words.push_back(line.substr(at, end - at));
        at = end;
      }
    }
    return words;
  }

  void read_nodes() {
    while (!at_end("$VERT_LIST_END")) {
      std::size_t place = 0;
      const std::vector<std::string_view> words = next_words(place);
      constexpr std::size_t kFewest = 5;  // further attributes may follow
      std::int64_t id = 0;
      std::array<double, 4> value{};
      bool good = words.size() >= kFewest && parse_integer(words[0], id);
      for (std::size_t k = 0; good && k < value.size(); ++k)
        good = parse_double(words[k + 1], value[k]);
      if (!good)
        file_.fail_at(place, fmt::format("found {}; a line of the list of nodes is \"number x y z "
                                         "radius\". Repair it.",
                                         in_quotes(words.empty() ? "" : words[0])));
      const Vec3 x(value[0], value[1], value[2]);
      if (!is_coordinate(x))
        file_.fail_at(place, fmt::format("node {} has the coordinates ({}, {}, {}); {}. Repair or "
                                         "remove it.",
                                         id, x[0], x[1], x[2], kCoordinateRule));
      if (!BadRadii::is_good(value[3])) bad_.add(place, fmt::format("node {}", id), value[3]);
      if (!number_.try_emplace(id, static_cast<int>(out_.node.size())).second)
        file_.fail_at(place, fmt::format("node {} is defined a second time. Give every node its "
                                         "own number.",
                                         id));
      out_.node.push_back(x);
      radius_.push_back(value[3]);
    }
    file_.next_token();
  }

  void read_strands() {
    while (!at_end("$STRANDS_LIST_END")) {
      std::size_t place = 0;
      const std::vector<std::string_view> words = next_words(place);
      ++n_strand_;
      int last = -1;
      for (std::size_t k = 1; k < words.size(); ++k) {
        std::int64_t id = 0;
        const auto found = parse_integer(words[k], id) ? number_.find(id) : number_.end();
        if (found == number_.end())
          file_.fail_at(place, fmt::format("strand {} names the node {}, which is not in the list "
                                           "before. Repair it.",
                                           in_quotes(words[0]), in_quotes(words[k])));
        const int node = found->second;
        if (node == last)
          file_.fail_at(place, fmt::format("strand {} joins node {} to itself. Remove it.",
                                           in_quotes(words[0]), id));
        if (last >= 0) {
          out_.segment.push_back({last, node});
          out_.radius.push_back({radius_[last], radius_[node]});
        }
        last = node;
      }
      constexpr std::size_t kFewest = 3;
      if (words.size() < kFewest)
        file_.fail_at(place, fmt::format("a strand has {} nodes; a line of the list of strands is "
                                         "\"number node node ...\" with two or more. Repair it.",
                                         words.empty() ? 0 : words.size() - 1));
    }
    file_.next_token();
  }

  InputFile& file_;
  Network out_;
  BadRadii bad_{"node"};
  std::int64_t said_nodes_ = -1, said_strands_ = -1, n_strand_ = 0;  ///< -1: not stated
  std::vector<double> radius_;                                       ///< [node]
  std::unordered_map<std::int64_t, int> number_;  ///< node of a number of the file
};

}  // namespace

Network read_vmv(InputFile& file) {
  file.skip_byte_order_mark();
  return VmvParser(file).read();
}

}  // namespace acinus::geometry
