#include "solve/operator.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "core/numbers/exact_sum.hpp"
#include "core/parallel/make_room.hpp"
#include "core/parallel/threads.hpp"
#include "solve/kernels.hpp"

namespace acinus::solve {

// The first part of the scratch holds one packed vector in double; the second another one.
static_assert(sizeof(Packed<double>) == 2 * sizeof(Packed<float>));
static_assert(sizeof(Packed<double>) == sizeof(SymBlock));
static_assert(kLanes * sizeof(Packed<double>) <= 5 * kPointStride * sizeof(float));

template <class T>
Operator::PackedVectors<T> Operator::packed() const {
  auto* const x = reinterpret_cast<Packed<T>*>(scratch_.data());
  return {x, x + system_->n_row * kLanes};
}
SymBlock* Operator::diagonal() const { return reinterpret_cast<SymBlock*>(scratch_.data()); }

template <class F>
void Operator::for_each_range(F f) {
  for_each_part(range_.size(), [&](std::size_t k) { f(range_[k]); });
}
template <class F>
void Operator::for_each_range(F f) const {
  for_each_part(range_.size(), [&](std::size_t k) { f(range_[k]); });
}

template <class F>
double Operator::sum_ranges(F f) const {
  thread_local std::vector<ExactSum> kept;  // a step asks for no memory
  kept.assign(range_.size(), {});
  const std::span<ExactSum> sum(kept);
  for_each_part(range_.size(), [&](std::size_t k) {
    ExactSum own;
    f(range_[k], own);
    sum[k] = own;
  });
  for (std::size_t k = 1; k < sum.size(); ++k) sum[0].add(sum[k]);
  system_->ownership.ranks.sum(sum.first(1));
  return sum[0].value();
}

template <class F>
void Operator::for_each_block(const ThreadRange& range, F f) const {
  for (std::size_t b = range.first_block; b < range.last_block; ++b)
    if (system_->ownership.owns(b))
      f(b, system_->block[b].first_row, system_->block[b].pattern->n_point);
}

LinkSet<Link> Operator::links_of(const ThreadRange& range) const {
  return {system_->links.link, range.link};
}
LinkSet<PointLink> Operator::point_links_of(const ThreadRange& range) const {
  return {system_->point_links, range.point_link};
}

/// Divides the blocks into one range per thread, with about as many own rows each.
void Operator::divide() {
  const System& s = *system_;
  const std::size_t n_block = s.block.size();
  std::size_t n_own_row = 0;
  for (const auto& [first, last] : s.own) n_own_row += s.row_of(last) - s.row_of(first);
  const std::size_t n = std::max<std::size_t>(1, std::min(count_threads(n_own_row), n_block));
  range_.resize(n);
  std::size_t b = 0, row = 0;
  for (std::size_t k = 0; k < n; ++k) {
    range_[k].first_block = b;
    for (; b < n_block; ++b) {
      const std::size_t rows = s.ownership.owns(b) ? s.row_of(b + 1) - s.row_of(b) : 0;
      // By the middle of a block: there may be no more than two or three to a thread.
      if (k + 1 < n && row + rows / 2 >= (k + 1) * n_own_row / n) break;
      row += rows;
    }
    range_[k].last_block = b;
  }
  if (s.ownership.is_whole())
    set_size(range_of_row_, s.n_row);
  else
    range_of_row_ = make_zeros<int>(s.n_row);
  for (std::size_t k = 0; k < n; ++k)
    for_each_block(range_[k], [&](std::size_t, std::size_t first_row, std::size_t n_row) {
      std::fill_n(range_of_row_.begin() + static_cast<std::ptrdiff_t>(first_row), n_row,
                  static_cast<int>(k) + 1);
    });
}

/// Distributes the links among the ranges that own one of their points, in the order of the links:
/// each thread sorts a part of all, and a range has a list from each.
template <class Ends>
void Operator::share(std::size_t n, ShareLists ThreadRange::*to, const Ends& ends) {
  const std::size_t n_range = range_.size();
  for (ThreadRange& range : range_) (range.*to).resize(n_range);
  for_each_part(n_range, [&](std::size_t part) {
    thread_local ShareLists mine;  // side by side while they are filled
    mine.resize(n_range);
    for (std::size_t k = 0; k < n_range; ++k) {
      std::swap(mine[k], (range_[k].*to)[part]);
      mine[k].clear();
    }
    const auto give = [lists = mine.data()](int range, Share share) {
      if (range < 0) return;
      LargeVector<Share>& list = lists[range];
      make_room(list, 1);
      list.push_back(share);
    };
    for (std::size_t l = part * n / n_range; l < (part + 1) * n / n_range; ++l) {
      const auto [end_a, end_b] = ends(l);
      const int a = range_of(end_a), b = range_of(end_b);
      const auto number = static_cast<std::uint32_t>(l);
      if (a == b) {
        give(a, {number, 1, 1});
      } else {
        give(a, {number, 1, 0});
        give(b, {number, 0, 1});
      }
    }
    for (std::size_t k = 0; k < n_range; ++k) std::swap(mine[k], (range_[k].*to)[part]);
  });
}

/// Distributes the contacts among the ranges: all of them, or those with a matrix.
void Operator::share_links(bool with_matrix) {
  const System& s = *system_;
  constexpr std::array kNone{kNowhere, kNowhere};
  const auto counts = [&](const auto& l) {
    return !with_matrix || has_matrix(l, s.stiffness_scale);
  };
  share(s.links.size(), &ThreadRange::link, [&](std::size_t l) {
    const Link& k = s.links.link[l];
    return counts(k) ? std::array{k.a.point[0], k.b.point[0]} : kNone;
  });
  share(s.point_links.size(), &ThreadRange::point_link, [&](std::size_t l) {
    const PointLink& k = s.point_links[l];
    return counts(k) ? std::array{k.a, k.b} : kNone;
  });
}

void Operator::merge_links() {
  const System& s = *system_;
  if (merged_ || !merger_.merge(s, merge_)) return;
  const PointPairs& pairs = merge_.pairs;
  share(pairs.row.size(), &ThreadRange::pair, [&](std::size_t k) {
    const PointPairs::Row& row = pairs.row[k];
    return std::array{row.a, pairs.b[row.first]};
  });
  for_each_range([&](ThreadRange& range) {
    range.single.resize(range.link.size());
    for (std::size_t k = 0; k < range.link.size(); ++k) {
      range.single[k].clear();
      for (const Share l : range.link[k])
        if (!is_merged(s, s.links.link[l.link])) range.single[k].push_back(l);
    }
  });
  merged_ = true;
}

void Operator::compute_inverse() {
  const System& s = *system_;
  set_size(inverse_, s.n_row * kSymStride);
  rank_one_.resize(s.rank_one.size());
  for (std::size_t k = 0; k < rank_one_.size(); ++k)
    set_size(rank_one_[k], s.rank_one[k].vector.size());
  SymBlock* const diagonal_blocks = diagonal();
  const LinkScales scales{s.stiffness_scale, s.friction_scale};
  for_each_range([&](const ThreadRange& range) {
    for_each_block(range, [&](std::size_t, std::size_t row, std::size_t n) {
      std::fill_n(diagonal_blocks + row * kLanes, n * kLanes, SymBlock{});
    });
    add_diagonal(links_of(range), scales, diagonal_blocks);
    add_diagonal(point_links_of(range), scales, diagonal_blocks);
    thread_local std::vector<double> d;
    for_each_block(range, [&](std::size_t b, std::size_t row, std::size_t n) {
      d.resize(n * kSymStride);
      const SymBlock* from = diagonal_blocks + row * kLanes;
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < 6; ++c)
          for (std::size_t l = 0; l < kLanes; ++l)
            d[i * kSymStride + c * kLanes + l] = static_cast<double>(from[i * kLanes + l][c]);
      const BlockView block = view_block(s, b);
      add_diagonal(block, d.data());
      invert_blocks(static_cast<int>(n), d.data(), inverse_.data() + row * kSymStride);
      InverseView inverse = inverse_of(b);
      const std::size_t n_family = inverse.n_family;
      for (inverse.n_family = 0; inverse.n_family < n_family; ++inverse.n_family) {
        const std::size_t k = inverse.n_family;
        invert_rank_one(inverse, block.vector[k], block.coefficient[k],
                        rank_one_[k].data() + row * kPointStride);
      }
    });
  });
}

void Operator::start(const System& system) {
  ACINUS_ASSERT(system.rank_one.size() <= kMaxFamilies);
  system_ = &system;
  const std::size_t bytes =
      system.n_row * kLanes * sizeof(Packed<double>) + 5 * system.n_dof() * sizeof(float);
  set_size(scratch_, (bytes + sizeof(Line) - 1) / sizeof(Line));
  divide();
  merged_ = false;
}

void Operator::prepare(const System& system) {
  start(system);
  share_links(true);
  exchange_.plan(system);
  for_each_range([&](ThreadRange& range) {
    range.external.clear();
    for (const LargeVector<Share>& list : range.link)
      for (const Share l : list)
        if (!system.links.link[l.link].b.exists()) range.external.push_back(l.link);
    range.external_point.clear();
    for (const LargeVector<Share>& list : range.point_link)
      for (const Share l : list)
        if (system.point_links[l.link].b == kNowhere) range.external_point.push_back(l.link);
  });
  compute_inverse();
}

InverseView Operator::inverse_of(std::size_t block) const {
  const Block& b = system_->block[block];
  InverseView view{b.pattern->n_point, inverse_.data() + b.first_row * kSymStride, 0, {}};
  for (const RowVector<float>& u : rank_one_)
    if (!b.still && b.first_row * kPointStride < u.size())
      view.vector[view.n_family++] = u.data() + b.first_row * kPointStride;
  return view;
}

template <class T>
Operator::PackedVectors<T> Operator::pack(In<T> x) const {
  const PackedVectors<T> work = packed<T>();
  for_each_range([&](const ThreadRange& range) {
    for_each_block(range, [&](std::size_t, std::size_t row, std::size_t n) {
      pack_points(x.data() + row * kPointStride, n, work.x + row * kLanes);
      std::fill_n(work.y + row * kLanes, n * kLanes, Packed<T>{});
    });
  });
  exchange_.fetch_packed(work.x);
  return work;
}

template <class T>
double Operator::apply(In<T> x, Out<T> y) const {
  const System& s = *system_;
  const PackedVectors<T> work = pack<T>(x);
  const LinkScales scales{s.stiffness_scale, s.friction_scale};
  return sum_ranges([&](const ThreadRange& range, ExactSum& sum) {
    const float* edge = nullptr;
    if constexpr (std::is_same_v<T, float>) {
      if (merged_) {
        edge = merge_.edge.data();
        multiply_pairs(merge_.pairs, range.pair, work.x, work.y);
      }
    }
    multiply_links(LinkSet<Link>{s.links.link, edge ? range.single : range.link}, scales, work.x,
                   work.y);
    multiply_links(point_links_of(range), scales, work.x, work.y);
    for_each_block(range, [&](std::size_t b, std::size_t row, std::size_t) {
      sum.add(multiply_block(view_block(s, b, edge), x.data() + row * kPointStride,
                             work.y + row * kLanes, y.data() + row * kPointStride));
    });
  });
}

void Operator::apply_within(std::span<const double> x, std::span<double> y) const {
  for_each_range([&](const ThreadRange& range) {
    Packed<double>* const none = packed<double>().y;
    for_each_block(range, [&](std::size_t b, std::size_t row, std::size_t n) {
      std::fill_n(none + row * kLanes, n * kLanes, Packed<double>{});
      multiply_block(view_block(*system_, b), x.data() + row * kPointStride, none + row * kLanes,
                     y.data() + row * kPointStride);
    });
  });
}

void Operator::apply_friction(std::span<const double> x, std::span<double> y) const {
  const System& s = *system_;
  const PackedVectors<double> work = pack<double>(x);
  const LinkScales scales{0, s.friction_scale};
  for_each_range([&](const ThreadRange& range) {
    multiply_links(links_of(range), scales, work.x, work.y);
    multiply_links(point_links_of(range), scales, work.x, work.y);
    for_each_block(range, [&](std::size_t b, std::size_t row, std::size_t) {
      multiply_friction(view_block(s, b), x.data() + row * kPointStride, work.y + row * kLanes,
                        y.data() + row * kPointStride);
    });
  });
}

void Operator::apply_external(std::span<const double> x, std::span<double> y) const {
  apply_external(x, y, {system_->stiffness_scale, system_->friction_scale});
}
void Operator::apply_external_friction(std::span<const double> x, std::span<double> y) const {
  apply_external(x, y, {0, system_->friction_scale});
}
void Operator::apply_external(std::span<const double> x, std::span<double> y,
                              LinkScales scales) const {
  const System& s = *system_;
  for_each_range([&](const ThreadRange& range) {
    for_each_block(range, [&](std::size_t, std::size_t row, std::size_t n) {
      for (std::size_t i = row; i < row + n; ++i)
        store3(y.data() + i * kPointStride,
               (s.friction_scale * load(s.medium.data() + i * kLanes)) *
                   load3(x.data() + i * kPointStride));
    });
  });
  for_each_external([&](const Stencil& at, const auto& l) {
    Vec3 r = Vec3::Zero();
    for (int k = 0; k < at.n; ++k) r += at.weight[k] * load_point(x.data(), at.address[k]);
    const Vec3 n = normal_of(l);
    const Vec3 f = scales.stiffness * static_cast<double>(l.stiffness) * n.dot(r) * n +
                   scales.friction * static_cast<double>(l.friction) * r;
    for (int k = 0; k < at.n; ++k) add_point(y.data(), at.address[k], at.weight[k] * f);
  });
}

void Operator::add_link_forces(System& system, const LinkForce& force) {
  start(system);
  share_links(false);
  Packed<double>* const y = packed<double>().y;
  for (auto* to : {&system.force, &system.external_force})
    for_each_range([&](const ThreadRange& range) {
      const bool external = to == &system.external_force;
      for_each_block(range, [&](std::size_t, std::size_t row, std::size_t n) {
        std::fill_n(y + row * kLanes, n * kLanes, Packed<double>{});
      });
      add_forces(links_of(range), force, external, y);
      for_each_block(range, [&](std::size_t, std::size_t row, std::size_t n) {
        add_packed(y + row * kLanes, n, to->data() + row * kPointStride);
      });
    });
}

template <class T>
double Operator::precondition(In<T> r, Out<T> z) const {
  return sum_ranges([&](const ThreadRange& range, ExactSum& sum) {
    for_each_block(range, [&](std::size_t b, std::size_t row, std::size_t) {
      sum.add(precondition_block(inverse_of(b), r.data() + row * kPointStride,
                                 z.empty() ? nullptr : z.data() + row * kPointStride));
    });
  });
}

template <class T>
double Operator::descend(double alpha, In<T> p, In<T> q, Out<T> x, Out<T> r, Out<T> z) const {
  return sum_ranges([&](const ThreadRange& range, ExactSum& sum) {
    for_each_block(range, [&](std::size_t b, std::size_t row, std::size_t) {
      const std::size_t at = row * kPointStride;
      sum.add(descend_block(inverse_of(b), alpha,
                            DescentBlock<T>{p.data() + at, q.data() + at, x.data() + at,
                                            r.data() + at, z.data() + at}));
    });
  });
}

template <class T>
void Operator::redirect(In<T> z, double beta, Out<T> p) const {
  for_each_range([&](const ThreadRange& range) {
    for_each_block(range, [&](std::size_t, std::size_t row, std::size_t n) {
      redirect_range(z.data() + row * kPointStride, beta, p.data() + row * kPointStride,
                     n * kPointStride);
    });
  });
}

template <class T>
double Operator::dot(In<T> a, In<T> b) const {
  return sum_ranges([&](const ThreadRange& range, ExactSum& sum) {
    for_each_block(range, [&](std::size_t, std::size_t row, std::size_t n) {
      sum.add(dot_range(a.data() + row * kPointStride, b.data() + row * kPointStride,
                        n * kPointStride));
    });
  });
}

#define ACINUS_INSTANTIATE(T)                                                               \
  template double Operator::apply<T>(In<T>, Out<T>) const;                                  \
  template double Operator::precondition<T>(In<T>, Out<T>) const;                           \
  template double Operator::descend<T>(double, In<T>, In<T>, Out<T>, Out<T>, Out<T>) const; \
  template void Operator::redirect<T>(In<T>, double, Out<T>) const;                         \
  template double Operator::dot<T>(In<T>, In<T>) const;
ACINUS_INSTANTIATE(double)
ACINUS_INSTANTIATE(float)
#undef ACINUS_INSTANTIATE

}  // namespace acinus::solve
