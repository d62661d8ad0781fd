#include "imaging/pieces.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "core/disjoint_sets.hpp"

namespace acinus::imaging {
namespace {

/// Runs of voxels of one label along x, without the background, in the order of the image.
struct Rows {
  std::vector<PieceRow> row;
  std::vector<std::size_t> first;  ///< [z * size y + y] first row of that line; one more at the end
};

Rows find_rows(const LabelImage& image) {
  Rows rows;
  for (int z = 0; z < image.size[2]; ++z)
    for (int y = 0; y < image.size[1]; ++y) {
      rows.first.push_back(rows.row.size());
      const Label* line = &image.label[image.index({0, y, z})];
      for (int x = 0; x < image.size[0];) {
        int end = x + 1;
        while (end < image.size[0] && line[end] == line[x]) ++end;
        if (line[x] != 0) rows.row.push_back({{x, y, z}, end - x, 0});
        x = end;
      }
    }
  rows.first.push_back(rows.row.size());
  return rows;
}

/// Joins the rows of two lines that touch and have the same label.
void join_lines(const LabelImage& image, const Rows& rows, std::size_t a, std::size_t b,
                DisjointSets& sets) {
  std::size_t i = rows.first[a], j = rows.first[b];
  while (i < rows.first[a + 1] && j < rows.first[b + 1]) {
    const PieceRow &p = rows.row[i], &q = rows.row[j];
    const int end_p = p.first[0] + p.length, end_q = q.first[0] + q.length;
    if (p.first[0] < end_q && q.first[0] < end_p &&
        image.label[image.index(p.first)] == image.label[image.index(q.first)])
      sets.join(static_cast<int>(i), static_cast<int>(j));
    end_p < end_q ? ++i : ++j;
  }
}

void add_row(const LabelImage& image, const PieceRow& row, Piece& piece) {
  const Voxel last{row.first[0] + row.length - 1, row.first[1], row.first[2]};
  if (piece.n_voxel == 0) piece.low = piece.high = row.first;
  piece.label = image.label[image.index(row.first)];
  for (std::size_t k = 0; k < 3; ++k) {
    piece.low[k] = std::min(piece.low[k], row.first[k]);
    piece.high[k] = std::max(piece.high[k], last[k]);
    piece.at_border = piece.at_border || row.first[k] == 0 || last[k] == image.size[k] - 1;
  }
  piece.n_voxel += row.length;
  piece.center += 0.5 * row.length * (image.center(row.first) + image.center(last));
}

}  // namespace

Pieces find_pieces(const LabelImage& image) {
  Rows rows = find_rows(image);
  DisjointSets sets(rows.row.size());
  const std::size_t n_y = image.size[1];
  for (std::size_t line = 0; line + 1 < rows.first.size(); ++line) {
    if (line % n_y != 0) join_lines(image, rows, line - 1, line, sets);
    if (line >= n_y) join_lines(image, rows, line - n_y, line, sets);
  }
  std::vector<Piece> found;
  std::vector<int> number(rows.row.size(), -1);
  for (std::size_t k = 0; k < rows.row.size(); ++k) {
    int& n = number[sets.find(static_cast<int>(k))];
    if (n < 0) {
      n = static_cast<int>(found.size());
      found.emplace_back();
    }
    rows.row[k].piece = n;
    add_row(image, rows.row[k], found[n]);
  }
  for (Piece& p : found) p.center /= static_cast<double>(p.n_voxel);

  std::vector<int> order(found.size()), place(found.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](int a, int b) {
    const Piece &p = found[a], &q = found[b];
    return p.label != q.label ? p.label < q.label : p.n_voxel > q.n_voxel;
  });
  Pieces pieces;
  for (std::size_t k = 0; k < order.size(); ++k) {
    place[order[k]] = static_cast<int>(k);
    pieces.piece.push_back(found[order[k]]);
  }
  for (PieceRow& row : rows.row) row.piece = place[row.piece];
  pieces.row = std::move(rows.row);
  return pieces;
}

std::vector<std::array<Label, 2>> find_touching(const LabelImage& image, int least) {
  std::map<std::array<Label, 2>, int> faces;
  const std::array<std::size_t, 3> stride{1, image.index({0, 1, 0}), image.index({0, 0, 1})};
  for (int z = 0; z < image.size[2]; ++z)
    for (int y = 0; y < image.size[1]; ++y)
      for (int x = 0; x < image.size[0]; ++x) {
        const Voxel v{x, y, z};
        const std::size_t at = image.index(v);
        const Label a = image.label[at];
        if (a == 0) continue;
        for (std::size_t k = 0; k < 3; ++k) {
          if (v[k] + 1 == image.size[k]) continue;
          const Label b = image.label[at + stride[k]];
          if (b != 0 && b != a) ++faces[{std::min(a, b), std::max(a, b)}];
        }
      }
  std::vector<std::array<Label, 2>> pairs;
  for (const auto& [pair, n] : faces)
    if (n >= least) pairs.push_back(pair);
  return pairs;
}

}  // namespace acinus::imaging
