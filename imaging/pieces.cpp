#include "imaging/pieces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/disjoint_sets.hpp"

namespace acinus::imaging {
namespace {

/// Number of the first row of every line, in the order of the image; one more at the end.
std::vector<std::size_t> number_rows(const LabelRows& image) {
  std::vector<std::size_t> first{0};
  first.reserve(image.line.size() + 1);
  for (const LabelLine& line : image.line) first.push_back(first.back() + line.size());
  constexpr std::size_t kMost = std::numeric_limits<int>::max();
  check(first.back() <= kMost,
        fmt::format("the image consists of {} rows of voxels with one label; at most {} are "
                    "allowed. Is it a segmentation? Remove specks, or crop it.",
                    first.back(), kMost));
  return first;
}

/// Joins the rows of two lines that touch and have the same label.
void join_lines(const LabelRows& image, const std::vector<std::size_t>& first, std::size_t a,
                std::size_t b, DisjointSets& sets) {
  const LabelLine &p = image.line[a], &q = image.line[b];
  visit_overlaps(p, q, [&](int, int, std::size_t i, std::size_t j) {
    if (p[i].label != 0 && p[i].label == q[j].label)
      sets.join(static_cast<int>(first[a] + i), static_cast<int>(first[b] + j));
  });
}

void add_row(const LabelRows& image, const Voxel& first, int end, Piece& piece) {
  const Voxel last{end - 1, first[1], first[2]};
  if (piece.n_voxel == 0) piece.low = piece.high = first;
  for (std::size_t k = 0; k < 3; ++k) {
    piece.low[k] = std::min(piece.low[k], first[k]);
    piece.high[k] = std::max(piece.high[k], last[k]);
    piece.at_border = piece.at_border || first[k] == 0 || last[k] == image.size[k] - 1;
  }
  const int length = end - first[0];
  piece.n_voxel += length;
  piece.center += 0.5 * length * (image.center(first) + image.center(last));
}

/// Measures the sets of rows in the order of their first rows.
/// @param of_row  receives the set of every row
std::vector<Piece> measure_sets(const LabelRows& image, DisjointSets& sets,
                                std::vector<int>& of_row) {
  std::vector<Piece> found;
  of_row.assign(sets.size(), -1);
  int row = 0;
  for (int z = 0; z < image.size[2]; ++z)
    for (int y = 0; y < image.size[1]; ++y) {
      const LabelLine& line = image.line[image.line_index(y, z)];
      for (std::size_t k = 0; k < line.size(); ++k, ++row) {
        if (line[k].label == 0) continue;
        const int root = sets.find(row);  // the lowest row of the set: it came before
        if (root == row) {
          of_row[row] = static_cast<int>(found.size());
          found.emplace_back().label = line[k].label;
        }
        of_row[row] = of_row[root];
        add_row(image, {first_of(line, k), y, z}, line[k].end, found[of_row[row]]);
      }
    }
  for (Piece& p : found) p.center /= static_cast<double>(p.n_voxel);
  return found;
}

}  // namespace

Pieces find_pieces(const LabelRows& image) {
  const std::vector<std::size_t> first = number_rows(image);
  DisjointSets sets(first.back());
  const std::size_t n_y = image.size[1];
  for (std::size_t line = 0; line < image.line.size(); ++line) {
    if (line % n_y != 0) join_lines(image, first, line - 1, line, sets);
    if (line >= n_y) join_lines(image, first, line - n_y, line, sets);
  }
  Pieces pieces;
  const std::vector<Piece> found = measure_sets(image, sets, pieces.of_row);

  std::vector<int> order(found.size()), place(found.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](int a, int b) {
    const Piece &p = found[a], &q = found[b];
    return p.label != q.label ? p.label < q.label : p.n_voxel > q.n_voxel;
  });
  for (std::size_t k = 0; k < order.size(); ++k) {
    place[order[k]] = static_cast<int>(k);
    pieces.piece.push_back(found[order[k]]);
  }
  for (int& piece : pieces.of_row)
    if (piece >= 0) piece = place[piece];
  return pieces;
}

std::vector<std::array<Label, 2>> find_touching(const LabelRows& image, int least) {
  std::map<std::array<Label, 2>, int> faces;
  const auto add = [&](Label a, Label b, int n) {
    if (a != 0 && b != 0 && a != b) faces[{std::min(a, b), std::max(a, b)}] += n;
  };
  const auto add_lines = [&](const LabelLine& a, const LabelLine& b) {
    visit_overlaps(a, b, [&](int first, int end, std::size_t i, std::size_t j) {
      add(a[i].label, b[j].label, end - first);
    });
  };
  const std::size_t n_y = image.size[1];
  for (std::size_t k = 0; k < image.line.size(); ++k) {
    const LabelLine& line = image.line[k];
    for (std::size_t i = 1; i < line.size(); ++i) add(line[i - 1].label, line[i].label, 1);
    if (k % n_y != 0) add_lines(image.line[k - 1], line);
    if (k >= n_y) add_lines(image.line[k - n_y], line);
  }
  std::vector<std::array<Label, 2>> pairs;
  for (const auto& [pair, n] : faces)
    if (n >= least) pairs.push_back(pair);
  return pairs;
}

}  // namespace acinus::imaging
