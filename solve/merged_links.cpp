#include "solve/merged_links.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

#include "core/parallel/make_room.hpp"
#include "core/parallel/threads.hpp"

namespace acinus::solve {
namespace {

std::uint64_t cell_of(const System& s, Point p) {
  return static_cast<std::uint64_t>(s.block_of(p)) * kLanes + p % kLanes;
}

bool is_same(const std::array<Point, 3>& p, const std::array<Point, 3>& q) {
  return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

CellPoints points_of(const System& s, std::uint64_t cell) {
  const Block& b = s.block[cell / kLanes];
  return {static_cast<Point>(b.first_row * kLanes + cell % kLanes),
          static_cast<std::size_t>(b.pattern->n_point)};
}

/// Springs between the points of a face, 01 02 12, and the index of that face.
struct FaceSprings {
  std::array<Point, 3> point{kNowhere, kNowhere, kNowhere};
  std::array<std::size_t, 3> spring{};

  void find(const BlockPattern& pattern, std::size_t first_row, const std::array<Point, 3>& p) {
    if (is_same(p, point)) return;
    point = p;
    auto number = [&](std::size_t k) { return static_cast<int>(p[k] / kLanes - first_row); };
    spring = {find_spring(pattern, number(0), number(1)),
              find_spring(pattern, number(0), number(2)),
              find_spring(pattern, number(1), number(2))};
  }
};

/// Writes the springs of one block as full symmetric blocks, plus the sums of the contacts.
ACINUS_KERNEL void write_edges(const BlockPattern& pattern, const float* shape, const float* spring,
                               const SymBlock* sum, float* edge) {
  for (const auto& [i, j] : pattern.spring) {
    const auto d = load3<float>(shape + j * kPointStride) - load3<float>(shape + i * kPointStride);
    const auto a = load<float>(spring), c = load<float>(spring + kLanes);
    const auto ax = a * d.x, ay = a * d.y;
    const LaneOf<float> own[6] = {ax * d.x + c, ax * d.y, ax * d.z,
                                  ay * d.y + c, ay * d.z, a * d.z * d.z + c};
    for (std::size_t e = 0; e < 6; ++e) {
      LaneOf<float> more;
      for (std::size_t l = 0; l < kLanes; ++l) more[l] = sum[l][e];
      store(edge + e * kLanes, own[e] + more);
    }
    sum += kLanes;
    spring += kSpringStride;
    edge += kEdgeStride;
  }
}

}  // namespace

bool is_merged(const System& s, const Link& l) {
  auto on_mesh = [&](const Side& side) {
    return !s.block[s.block_of(side.point[0])].pattern->spring_of.empty();
  };
  return l.b.exists() && !l.a.is_single() && !l.a.is_on_edge() && on_mesh(l.a) &&
         (l.b.is_single() || on_mesh(l.b));
}

/// Collects runs of consecutive contacts that join the same cells, and sorts them by pair of cells.
void LinkMerger::update_runs(const System& s) {
  const auto add = [](std::vector<LinkRun>& runs, const LinkRun& next) {
    if (!runs.empty() && runs.back().last == next.first && runs.back().cells == next.cells &&
        runs.back().swapped == next.swapped)
      runs.back().last = next.last;
    else
      runs.push_back(next);
  };
  const std::size_t n_part = count_threads(s.n_row), n = s.links.size();
  found_.resize(n_part);
  for_each_part(n_part, [&](std::size_t part) {
    std::vector<LinkRun>& runs = found_[part];
    runs.clear();
    for (std::size_t l = part * n / n_part; l < (part + 1) * n / n_part; ++l) {
      const Link& k = s.links.link[l];
      if (!is_merged(s, k)) continue;
      const std::uint64_t a = cell_of(s, k.a.point[0]), b = cell_of(s, k.b.point[0]);
      const auto i = static_cast<std::uint32_t>(l);
      add(runs, {std::min(a, b) << 32 | std::max(a, b), i, i + 1, a > b});
    }
  });
  run_.clear();
  for (const std::vector<LinkRun>& runs : found_)  // one may go on in the next part
    for (const LinkRun& r : runs) add(run_, r);
  std::ranges::sort(run_, {}, [](const LinkRun& r) { return std::pair(r.cells, r.first); });
  group_.clear();
  for (std::size_t k = 0; k < run_.size(); ++k)
    if (k == 0 || run_[k].cells != run_[k - 1].cells) group_.push_back(k);
  group_.push_back(run_.size());
}

void LinkMerger::add_across(const System& s, PointPairs& pairs) {
  const std::size_t n_part = count_threads(s.n_row), n_group = group_.size() - 1;
  part_.resize(n_part - 1);
  table_.resize(std::max(table_.size(), n_part));
  const LinkScales scales{s.stiffness_scale, s.friction_scale};
  for_each_part(n_part, [&](std::size_t part) {
    PointPairs& out = part == 0 ? pairs : part_[part - 1];
    out.clear();
    PointPairTable& table = table_[part];
    for (std::size_t g = part * n_group / n_part; g < (part + 1) * n_group / n_part; ++g) {
      const std::uint64_t cells = run_[group_[g]].cells;
      table.start(points_of(s, cells >> 32), points_of(s, cells & 0xffffffff));
      for (std::size_t k = group_[g]; k < group_[g + 1]; ++k)
        for (std::size_t l = run_[k].first; l < run_[k].last; ++l) {
          const Link& link = s.links.link[l];
          if (!has_matrix(link, s.stiffness_scale)) continue;
          const SymBlock m = matrix_of(link, scales);
          if (run_[k].swapped)
            table.add(link.b, link.a, m);
          else
            table.add(link.a, link.b, m);
        }
      table.emit(out);
    }
  });
  for (const PointPairs& p : part_) pairs.append(p);
}

void LinkMerger::add_within(const System& s, RowVector<float>& edge) {
  const std::size_t n_block = s.block.size();
  set_size(edge, s.spring.size() / kSpringStride * kEdgeStride);
  end_.clear();
  for (std::uint32_t k = 0; k < run_.size(); ++k) {
    const std::uint64_t low = run_[k].cells >> 32, high = run_[k].cells & 0xffffffff;
    end_.push_back({static_cast<std::uint32_t>(low / kLanes), k, run_[k].swapped});
    end_.push_back({static_cast<std::uint32_t>(high / kLanes), k, !run_[k].swapped});
  }
  // The order of summation follows from the contacts alone.
  std::ranges::sort(end_, {}, [&](const RunEnd& e) {
    return std::tuple(e.block, e.run, e.is_b != run_[e.run].swapped);
  });

  const LinkScales scales{s.stiffness_scale, s.friction_scale};
  for_each_index(n_block, worth_threads(s.n_row), [&](std::size_t b) {
    if (!s.ownership.owns(b)) return;
    thread_local std::vector<SymBlock> sum;
    const Block& block = s.block[b];
    sum.assign(block.pattern->spring.size() * kLanes, {});
    FaceSprings face;
    for (const RunEnd& end : std::ranges::equal_range(end_, b, {}, &RunEnd::block))
      for (std::uint32_t k = run_[end.run].first; k < run_[end.run].last; ++k) {
        const Link& l = s.links.link[k];
        const Side& side = end.is_b ? l.b : l.a;
        if (side.is_single() || !has_matrix(l, s.stiffness_scale)) continue;
        face.find(*block.pattern, block.first_row, side.point);
        const SymBlock m = matrix_of(l, scales);
        const auto w = weights_of(side);
        const std::size_t lane = side.point[0] % kLanes;
        add_scaled(sum[face.spring[0] * kLanes + lane], -w[0] * w[1], m);
        add_scaled(sum[face.spring[1] * kLanes + lane], -w[0] * w[2], m);
        add_scaled(sum[face.spring[2] * kLanes + lane], -w[1] * w[2], m);
      }
    write_edges(*block.pattern, s.shape.data() + block.first_shape * kPointStride,
                s.spring.data() + block.first_spring * kSpringStride, sum.data(),
                edge.data() + block.first_spring * kEdgeStride);
  });
}

std::size_t LinkMerger::memory() const {
  std::size_t bytes = memory_of(run_) + memory_of(group_) + memory_of(end_);
  for (const std::vector<LinkRun>& runs : found_) bytes += memory_of(runs);
  for (const PointPairs& pairs : part_) bytes += pairs.memory();
  for (const PointPairTable& table : table_) bytes += table.memory();
  return bytes;
}

bool LinkMerger::merge(const System& s, MergedLinks& out) {
  update_runs(s);
  if (!s.ownership.ranks.any(!run_.empty())) return false;
  add_across(s, out.pairs);
  add_within(s, out.edge);
  return true;
}

}  // namespace acinus::solve
