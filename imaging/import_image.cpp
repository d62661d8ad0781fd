#include "imaging/import_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/threads.hpp"
#include "core/sphere.hpp"
#include "imaging/background.hpp"
#include "imaging/label_surface.hpp"
#include "imaging/pieces.hpp"

namespace acinus::imaging {
namespace {

/// Edge length of the triangles relative to the radius of a ball of the label's volume: some 2500
/// triangles a cell.
constexpr double kEdgeOverRadius = 0.12;
/// Least edge length, in voxel sides.
constexpr double kLeastEdgeInVoxels = 0.7;

double edge_for(const LabelRows& image, const Piece& piece) {
  const double volume = static_cast<double>(piece.n_voxel) * image.voxel_volume();
  return std::max(kEdgeOverRadius * sphere_radius(volume),
                  kLeastEdgeInVoxels * image.voxel.minCoeff());
}

void check_uneven(const LabelRows& image, std::vector<std::string>& warnings) {
  constexpr double kMostAspectRatio = 4;
  const double ratio = image.voxel.maxCoeff() / image.voxel.minCoeff();
  if (ratio <= kMostAspectRatio) return;
  warnings.push_back(
      fmt::format("voxels of {:.3g} x {:.3g} x {:.3g} um are {:.2g} times as long as wide: shapes "
                  "along the long side are guesses between slices",
                  image.voxel[0], image.voxel[1], image.voxel[2], ratio));
}

/// Voxels that are vessels, and those of them that were part of a cell.
struct VesselCount {
  std::size_t any = 0, both = 0;
};

/// Moves the vessels of one line into a line of their own, with label 1.
/// @param other  line of the image of vessels, not 0 inside them; nothing: no such image
VesselCount take_vessels(Label vessel_label, const LabelLine* other, LabelLine& cells,
                         LabelLine& vessels) {
  VesselCount n;
  LabelLine rest;
  const auto take = [&](int first, int end, Label label, bool given) {
    const bool named = vessel_label != 0 && label == vessel_label, vessel = given || named;
    append_row(end, vessel ? 0 : label, rest);
    append_row(end, vessel ? 1 : 0, vessels);
    n.any += vessel ? end - first : 0;
    n.both += vessel && !named && label != 0 ? end - first : 0;
  };
  if (other != nullptr)
    visit_overlaps(cells, *other, [&](int first, int end, std::size_t i, std::size_t j) {
      take(first, end, cells[i].label, (*other)[j].label != 0);
    });
  else
    for (std::size_t k = 0; k < cells.size(); ++k)
      take(first_of(cells, k), cells[k].end, cells[k].label, false);
  rest.shrink_to_fit();
  vessels.shrink_to_fit();
  cells = std::move(rest);
  return n;
}

/// Moves the vessels from the image of the cells into an image of their own, with label 1.
/// @return nothing if the options name no vessels
std::optional<LabelRows> take_vessels(const ImportOptions& o, LabelRows& cells,
                                      std::vector<std::string>& warnings) {
  if (o.vessels.empty() && o.vessel_label == 0) return std::nullopt;
  LabelRows other;
  if (!o.vessels.empty()) {
    ReadImage read = o.read;
    read.voxel = cells.voxel;
    read.unit = 0;
    read.second = true;
    other = read_image(o.vessels, read, &warnings);
    check(other.size == cells.size,
          fmt::format("{}: {} x {} x {} voxels, but {} has {} x {} x {}. Both must show the same.",
                      o.vessels, other.size[0], other.size[1], other.size[2], o.image,
                      cells.size[0], cells.size[1], cells.size[2]));
  }
  LabelRows vessels{cells, std::vector<LabelLine>(cells.line.size()), cells.most_label};
  VesselCount all;
  for (std::size_t k = 0; k < cells.line.size(); ++k) {
    const VesselCount n = take_vessels(o.vessel_label, o.vessels.empty() ? nullptr : &other.line[k],
                                       cells.line[k], vessels.line[k]);
    all.any += n.any;
    all.both += n.both;
  }
  if (all.both > 0)
    warnings.push_back(
        fmt::format("{} voxels belong to a cell and to a vessel: vessels have them", all.both));
  check(all.any > 0,
        fmt::format("{}: no voxel is {}.", o.vessels.empty() ? o.image : o.vessels,
                    o.vessels.empty() ? fmt::format("labelled {}", o.vessel_label) : "not 0"));
  return vessels;
}

/// Refuses images whose labels overflowed 8 bits: many labels then consist of several large pieces.
void check_overflow(const ImportOptions& o, const LabelRows& image, const Pieces& pieces) {
  constexpr double kLargePart = 0.3, kMostRepeated = 0.1;
  std::size_t labels = 0, twice = 0;
  Label first = 0;
  for (std::size_t k = 0; k < pieces.piece.size(); ++k) {
    const Piece& p = pieces.piece[k];
    if (k > 0 && pieces.piece[k - 1].label == p.label) continue;
    ++labels;
    const bool large = k + 1 < pieces.piece.size() && pieces.piece[k + 1].label == p.label &&
                       static_cast<double>(pieces.piece[k + 1].n_voxel) >
                           kLargePart * static_cast<double>(p.n_voxel);
    if (large && twice++ == 0) first = p.label;
  }
  const bool many = static_cast<double>(twice) > kMostRepeated * static_cast<double>(labels);
  check(!many || o.split,
        fmt::format(
            "{}: {} of {} labels are in several large pieces, label {} first{}. Give --split to "
            "make every piece a cell, or label the cells anew.",
            o.image, twice, labels, first,
            image.most_label <= 255
                ? ": its type counts to 255 only, and there are probably more cells than that"
                : ""));
}

/// Calls visit(row, piece) for every row of a piece. @pre the pieces are those of the image
template <class Visit>
void visit_piece_rows(const Pieces& pieces, LabelRows& image, const Visit& visit) {
  std::size_t k = 0;
  for (LabelLine& line : image.line)
    for (LabelRow& row : line)
      if (const int piece = pieces.of_row[k++]; piece >= 0) visit(row, piece);
}

/// Selection of the pieces that become cells; all others are erased from the image.
class Sorting {
 public:
  Sorting(const ImportOptions& o, LabelRows& image, ImportedTissue& tissue)
      : o_(o), image_(image), tissue_(tissue) {}

  /// Selects pieces and erases the rest.
  /// @return the pieces to keep, each the only one of its label
  std::vector<Piece> run() {
    Pieces pieces = find_pieces(image_);
    check(!pieces.piece.empty(),
          fmt::format("{}: all voxels are 0, the background. Is this the label image?", o_.image));
    check_overflow(o_, image_, pieces);
    const double smallest = o_.smallest > 0 ? o_.smallest : 0.1 * median_volume(pieces);
    std::vector<Piece> kept;
    std::vector<char> keep(pieces.piece.size(), 0);
    for (std::size_t k = 0; k < pieces.piece.size(); ++k) {
      Piece& p = pieces.piece[k];
      const std::string why = reason(pieces, k, smallest);
      if (!why.empty()) {
        tissue_.left_out.push_back({p.label, p.n_voxel, p.center, why});
        continue;
      }
      keep[k] = 1;
      kept.push_back(p);
    }
    warn_of_giant(kept);
    if (o_.split) number_anew(pieces, keep, kept);
    visit_piece_rows(pieces, image_, [&](LabelRow& row, int piece) {
      if (keep[piece] == 0) row.label = 0;
    });
    return kept;
  }

 private:
  double volume(const Piece& p) const {
    return static_cast<double>(p.n_voxel) * image_.voxel_volume();
  }
  /// Median volume of the pieces by voxels, um^3. Weighting by voxels excludes specks; a piece
  /// larger than all others together is left out.
  double median_volume(const Pieces& pieces) const {
    std::vector<double> all;
    for (const Piece& p : pieces.piece) all.push_back(volume(p));
    std::ranges::sort(all, std::greater());
    double total = 0, sum = 0;
    for (const double v : all) total += v;
    if (all.size() > 2 && 2 * all.front() > total) {
      total -= all.front();
      all.erase(all.begin());
    }
    for (const double v : all)  // half of all voxels are in pieces at least as large
      if ((sum += v) >= 0.5 * total) return v;
    return all.back();
  }
  std::string reason(const Pieces& pieces, std::size_t k, double smallest) const {
    constexpr std::size_t kLeastVoxels = 27;
    const Piece& p = pieces.piece[k];
    const bool main = k == 0 || pieces.piece[k - 1].label != p.label;
    if (!main && !o_.split)
      return "a part of its label that does not hang together with the largest";
    if (p.n_voxel < kLeastVoxels) return fmt::format("a speck: fewer than {} voxels", kLeastVoxels);
    if (volume(p) < smallest) return fmt::format("a speck: smaller than {:.3g} um^3", smallest);
    if (p.at_border && !o_.keep_border) return "cut off by the border of the image";
    return {};
  }
  /// Warns of a piece with many times the median volume: probably a background that does not
  /// enclose the image.
  void warn_of_giant(const std::vector<Piece>& kept) {
    constexpr double kGiantRatio = 50;
    std::vector<double> all;
    for (const Piece& p : kept) all.push_back(volume(p));
    if (all.size() < 3) return;
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::ranges::nth_element(all, middle);
    for (const Piece& p : kept)
      if (volume(p) > kGiantRatio * *middle)
        tissue_.warnings.push_back(
            fmt::format("label {} has {:.0f} times the volume of the cell in the middle: if it is "
                        "the background, give --background {}",
                        p.label, volume(p) / *middle, p.label));
  }
  /// Gives every piece of a label but the largest a label of its own.
  void number_anew(const Pieces& pieces, const std::vector<char>& keep, std::vector<Piece>& kept) {
    Label next = pieces.piece.back().label;
    std::vector<Label> label(pieces.piece.size());
    std::size_t at = 0;
    for (std::size_t k = 0; k < pieces.piece.size(); ++k) {
      const bool main = k == 0 || pieces.piece[k - 1].label != pieces.piece[k].label;
      label[k] = main ? pieces.piece[k].label : ++next;
      if (keep[k] != 0) kept[at++].label = label[k];
    }
    visit_piece_rows(pieces, image_, [&](LabelRow& row, int piece) { row.label = label[piece]; });
    std::ranges::sort(kept, {}, &Piece::label);
  }

  const ImportOptions& o_;
  LabelRows& image_;
  ImportedTissue& tissue_;
};

/// Triangulates the surface of a piece, with stronger smoothing where it has handles at first.
/// @return cause of failure, empty on success
std::string make_surface(const LabelRows& image, const Piece& piece, double smoothing,
                         geometry::Surface& surface) {
  constexpr std::array<double, 3> kSmoothingFactors{1, 1.6, 2.5};
  constexpr double kMostLostVolume = 0.1;
  std::string why;
  for (const double more : kSmoothingFactors) {
    try {
      LabelSurface made =
          make_label_surface(image, piece, edge_for(image, piece), more * smoothing);
      if (made.handles > 0) {
        why = "it has a hole through it";
        continue;
      }
      if (made.left_out > kMostLostVolume * made.volume)
        return "its parts hang together by a few voxels only";
      surface = std::move(made.surface);
      return {};
    } catch (const Error& error) {
      return error.what();
    }
  }
  return why;
}

void add_cells(const ImportOptions& o, const LabelRows& image, const std::vector<Piece>& pieces,
               ImportedTissue& tissue) {
  std::vector<ImportedCell> cell(pieces.size());
  std::vector<std::string> why(pieces.size());
  for_each_part(pieces.size(), [&](std::size_t k) {
    const Piece& p = pieces[k];
    cell[k].label = p.label;
    cell[k].n_voxel = p.n_voxel;
    cell[k].volume = static_cast<double>(p.n_voxel) * image.voxel_volume();
    cell[k].center = p.center;
    cell[k].at_border = p.at_border;
    why[k] = make_surface(image, p, o.smoothing, cell[k].surface);
  });
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (why[k].empty())
      tissue.cell.push_back(std::move(cell[k]));
    else
      tissue.left_out.push_back({cell[k].label, cell[k].n_voxel, cell[k].center, why[k]});
  }
}

/// Counts the neighbours of every cell in the image and marks the cells that touch vessels. Vessels
/// are entered into the image, with a label of their own.
void add_neighbours(LabelRows& image, const std::optional<LabelRows>& vessels,
                    ImportedTissue& tissue) {
  constexpr int kLeastFaces = 4;  // of voxels: fewer are chance
  const Label vessel = [&] {
    Label most = 0;
    for (const ImportedCell& c : tissue.cell) most = std::max(most, c.label);
    return most + 1;
  }();
  for (std::size_t k = 0; vessels && k < image.line.size(); ++k) {
    LabelLine joined;
    const LabelLine &cells = image.line[k], &others = vessels->line[k];
    visit_overlaps(cells, others, [&](int, int end, std::size_t i, std::size_t j) {
      append_row(end, others[j].label != 0 ? vessel : cells[i].label, joined);
    });
    image.line[k] = std::move(joined);
  }
  std::map<Label, ImportedCell*> by_label;
  for (ImportedCell& c : tissue.cell) by_label[c.label] = &c;
  for (const auto& [a, b] : find_touching(image, kLeastFaces)) {
    const auto p = by_label.find(a), q = by_label.find(b);
    if (p == by_label.end()) continue;
    if (b == vessel) p->second->at_vessel = true;
    if (q == by_label.end()) continue;
    ++p->second->neighbours;
    ++q->second->neighbours;
    tissue.touching.push_back({a, b});
  }
}

void add_vessels(const ImportOptions& o, LabelRows numbered, ImportedTissue& tissue) {
  const Pieces pieces = find_pieces(numbered);
  constexpr std::size_t kLeastVoxels = 27;
  constexpr double kVesselSmoothing = 1.5, kVesselEdge = 1.5;
  visit_piece_rows(pieces, numbered,
                   [](LabelRow& row, int piece) { row.label = static_cast<Label>(piece) + 1; });
  std::size_t specks = 0;
  for (std::size_t k = 0; k < pieces.piece.size(); ++k) {
    Piece p = pieces.piece[k];
    p.label = static_cast<Label>(k) + 1;
    if (p.n_voxel < kLeastVoxels) {
      ++specks;
      continue;
    }
    // A network is thin where a cell of its volume is not; walls with the steps of voxels are
    // rough.
    const double edge = kVesselEdge * numbered.voxel.maxCoeff();
    LabelSurface made = make_label_surface(numbered, p, edge, kVesselSmoothing * o.smoothing);
    tissue.vessel.push_back(std::move(made.surface));
  }
  if (specks > 0)
    tissue.warnings.push_back(fmt::format(
        "{} specks of vessels with fewer than {} voxels are left out", specks, kLeastVoxels));
}

[[noreturn]] void fail_empty(const ImportOptions& o, const std::vector<LeftOut>& left_out) {
  const LeftOut& first = left_out.front();  // there was a label, see Sorting
  throw Error(fmt::format(
      "{}: none of its {} labels can be kept; the first: label {}, {} voxels near ({:.4g}, {:.4g}, "
      "{:.4g}) um: {}.{}",
      o.image, left_out.size(), first.label, first.n_voxel, first.center[0], first.center[1],
      first.center[2], first.why,
      o.keep_border ? "" : " --border keep keeps cells that the border cuts off."));
}

}  // namespace

ImportedTissue import_image(const ImportOptions& o) {
  ImportedTissue tissue;
  LabelRows image = read_image(o.image, o.read, &tissue.warnings);
  clear_background(o, image);
  tissue.size = image.size;
  tissue.voxel = image.voxel;
  check_uneven(image, tissue.warnings);
  std::optional<LabelRows> vessels = take_vessels(o, image, tissue.warnings);
  const std::vector<Piece> pieces = Sorting(o, image, tissue).run();
  add_cells(o, image, pieces, tissue);
  std::ranges::stable_sort(tissue.left_out, [](const LeftOut& a, const LeftOut& b) {
    return a.label != b.label ? a.label < b.label : a.n_voxel > b.n_voxel;
  });
  if (tissue.cell.empty()) fail_empty(o, tissue.left_out);
  add_neighbours(image, vessels, tissue);
  if (vessels) add_vessels(o, std::move(*vessels), tissue);
  return tissue;
}

}  // namespace acinus::imaging
