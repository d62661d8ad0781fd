#include "cbm/pair_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/jkr.hpp"
#include "contact/jkr_lanes.hpp"
#include "contact/pair_adhesion.hpp"
#include "core/parallel/make_room.hpp"
#include "core/parallel/threads.hpp"

namespace acinus::cbm {
namespace {

/// Number of cells below which starting threads costs more than it saves.
constexpr std::size_t kParallelCells = 2000;

/// Eight pairs: input and output of the law.
struct alignas(64) Batch {
  // in
  double xa[3][kLanes], xb[3][kLanes], radius_a[kLanes], radius_b[kLanes];
  double compliance[kLanes];  ///< 1 / E^
  double adhesion[kLanes], was_touching[kLanes];
  // out; all zero where not touching
  double normal[3][kLanes], force[kLanes], stiffness[kLanes], area[kLanes], touching[kLanes];
  double overlap[kLanes];  ///< um
};

ACINUS_KERNEL void evaluate(Batch& p) {
  const Lane dx = load(p.xa[0]) - load(p.xb[0]), dy = load(p.xa[1]) - load(p.xb[1]),
             dz = load(p.xa[2]) - load(p.xb[2]);
  const Lane zero = lane_of(0), one = lane_of(1);
  const Lane distance = lane_sqrt(dx * dx + dy * dy + dz * dz);
  const Lane ra = load(p.radius_a), rb = load(p.radius_b), sum = ra + rb;
  const Lane overlap = sum - distance;
  const contact::JkrLanes law = contact::jkr_force_lanes(
      ra * rb / sum, 1.0 / load(p.compliance), load(p.adhesion), overlap, load(p.was_touching));
  const Lane inverse = distance > 0.0 ? 1.0 / distance : zero;
  store(p.normal[0], distance > 0.0 ? dx * inverse : one);
  store(p.normal[1], dy * inverse);
  store(p.normal[2], dz * inverse);
  store(p.force, law.force);
  store(p.stiffness, lane_max0(law.stiffness));
  store(p.area, kPi * law.squared_radius);
  store(p.touching, law.touching);
  store(p.overlap, overlap);
}

/// Scales all actions of each pair by its share; without a share it does not touch.
void weaken(const double (&share)[kLanes], Batch& p) {
  for (std::size_t l = 0; l < kLanes; ++l) {
    for (double* v : {&p.force[l], &p.stiffness[l], &p.area[l]}) *v *= share[l];
    if (share[l] <= 0) p.touching[l] = 0;
  }
}

void compute_type_factors(std::span<const Params> params, const ContactParams& options,
                          ContactWorkspace& work) {
  work.type_softness.clear();
  work.type_pair.clear();
  const auto root = [&](const Params& p) {
    return std::sqrt(options.adhesion_factor * p.adhesion);
  };
  for (const Params& p : params) {
    work.type_softness.push_back(1 - p.poisson * p.poisson);
    for (std::size_t q = 0; q < params.size(); ++q)
      work.type_pair.push_back(
          {p.adhesion_with.empty() ? root(p) * root(params[q])
                                   : options.adhesion_factor * p.adhesion_with[q],
           options.friction_factor * std::sqrt(p.cell_friction * params[q].cell_friction)});
  }
}

FaceModulus face_toward(const ContactInput& in, const ContactWorkspace& work, std::size_t cell,
                        double overlap) {
  const Modulus& crowd = work.modulus[cell];
  if (work.coupling.empty()) return {crowd};  // no type has a law
  const StiffnessLaw& law = in.params[in.state.type[cell]].correction;
  return modulus_toward(law, in.state.young[cell], crowd, overlap);
}

/// Batch of up to eight near pairs, and their law.
class PairBatch {
 public:
  PairBatch(const ContactInput& in, const ContactWorkspace& work)
      : in_(in), s_(in.state), cells_(in.cells), work_(work) {}

  std::size_t size() const { return n_; }
  void clear() { n_ = 0; }

  /// Adds pair k of the list of near pairs. Pairs in the order of the list are fastest.
  /// @return true if the batch is full
  bool push(std::size_t k) {
    index[n_] = k;
    const auto [a, b] = work_.pair[k];
    const std::size_t i = a, j = b;
    const Address at_a = cell_address(0, i), at_b = cell_address(0, j);
    const double* x = s_.position.data();
    for (std::size_t m = 0; m < 3; ++m) {
      value.xa[m][n_] = x[at_a + m * kLanes];
      value.xb[m][n_] = x[at_b + m * kLanes];
    }
    value.radius_a[n_] = cells_.radius[i];
    value.radius_b[n_] = cells_.radius[j];
    if (!cells_.strength.empty()) share_[n_] = cells_.pair_share(i, j);
    const std::size_t ta = s_.type[i], tb = s_.type[j];
    const Modulus *of_a = &work_.modulus[i], *of_b = &work_.modulus[j];
    if (!work_.coupling.empty()) {  // a law corrects
      const double overlap = overlap_now();
      face[n_] = {face_toward(in_, work_, i, overlap), face_toward(in_, work_, j, overlap)};
      of_a = &face[n_][0];
      of_b = &face[n_][1];
    }
    const std::vector<double>& softness = work_.type_softness;
    value.compliance[n_] = softness[ta] / of_a->value + softness[tb] / of_b->value;
    const TypePair& types = work_.type_pair[ta * softness.size() + tb];
    value.adhesion[n_] =
        contact::scale_adhesion(types.adhesion, cells_.adhesion, i, cells_.adhesion, j);
    friction_[n_] = types.friction;
    value.was_touching[n_] = was_touching({a, b}) ? 1 : 0;
    return ++n_ == kLanes;
  }

  /// Evaluates the law of all pairs of the batch.
  void evaluate_all() {
    for (std::size_t l = n_; l < kLanes; ++l) {  // idle lanes repeat the last pair
      for (std::size_t m = 0; m < 3; ++m) {
        value.xa[m][l] = value.xa[m][n_ - 1];
        value.xb[m][l] = value.xb[m][n_ - 1];
      }
      value.radius_a[l] = value.radius_a[n_ - 1];
      value.radius_b[l] = value.radius_b[n_ - 1];
      value.compliance[l] = value.compliance[n_ - 1];
      value.adhesion[l] = value.adhesion[n_ - 1];
      value.was_touching[l] = value.was_touching[n_ - 1];
    }
    evaluate(value);
    if (!cells_.strength.empty()) weaken(share_, value);
    if (!work_.coupling.empty())
      for (std::size_t l = 0; l < n_; ++l) stiffen(l);
  }

  /// Growth of the slope of a contact because the modulus of a side grows with its overlap, nN/um.
  /// dF/dE^ is (2/3) (overlap / E^) dF/d overlap, since F depends on overlap E^(2/3) alone.
  double by_modulus(std::size_t cell, const Modulus& m, std::size_t l) const {
    const double softness = work_.type_softness[s_.type[cell]];
    const double by_own = 2.0 / 3 * std::max(value.overlap[l], 0.0) * value.stiffness[l] *
                          softness / (value.compliance[l] * m.value * m.value);
    return by_own * m.slope / (value.radius_a[l] + value.radius_b[l]);
  }

  /// Friction of pair l of the batch, nN s/um.
  double friction(std::size_t l) const { return friction_[l] * value.area[l]; }

  Batch value{};
  std::array<std::array<FaceModulus, 2>, kLanes> face{};  ///< of both sides, if a law corrects
  std::size_t index[kLanes] = {};                         ///< in the list of near pairs

 private:
  /// Relative overlap of the pair that push() adds, over the sum of its radii.
  double overlap_now() const {
    double squared = 0;
    for (std::size_t m = 0; m < 3; ++m) {
      const double d = value.xa[m][n_] - value.xb[m][n_];
      squared += d * d;
    }
    return 1 - std::sqrt(squared) / (value.radius_a[n_] + value.radius_b[n_]);
  }

  /// Test for contact at the last step. Pairs come in the order of the touching set, so that one
  /// index moves along it.
  bool was_touching(std::pair<int, int> p) {
    const auto& t = s_.touching;
    if (cursor_ == kUnset || (cursor_ > 0 && !(t[cursor_ - 1] < p)))
      cursor_ = static_cast<std::size_t>(std::ranges::lower_bound(t, p) - t.begin());
    while (cursor_ < t.size() && t[cursor_] < p) ++cursor_;
    return cursor_ < t.size() && t[cursor_] == p;
  }

  /// Adds the growth of the moduli to the slope of a contact whose own overlap sets them.
  void stiffen(std::size_t l) {
    const auto [a, b] = work_.pair[index[l]];
    double more = 0;
    if (face[l][0].own) more += by_modulus(a, face[l][0], l);
    if (face[l][1].own) more += by_modulus(b, face[l][1], l);
    value.stiffness[l] += more;
  }

  static constexpr std::size_t kUnset = -1;
  const ContactInput& in_;
  const State& s_;
  const CellData& cells_;
  const ContactWorkspace& work_;
  double friction_[kLanes] = {};  ///< nN s/um^3
  double share_[kLanes] = {};     ///< used only when not all strengths are 1
  std::size_t n_ = 0, cursor_ = kUnset;
};

/// Search over the cells [first, last) of one thread: all pairs with a side among them.
class RangeSearch {
 public:
  RangeSearch(const ContactInput& in, std::pair<std::size_t, std::size_t> range,
              ContactWorkspace& work, solve::PointLinks& link,
              std::vector<std::pair<int, int>>& touching)
      : first_row_(in.first_row),
        first_(static_cast<int>(range.first)),
        last_(static_cast<int>(range.second)),
        work_(work),
        link_(link),
        touching_(touching),
        batch_(in, work) {}

  void run() {
    clear();
    const auto& pair = work_.pair;
    auto position = [&](int cell) {
      return static_cast<std::size_t>(std::ranges::lower_bound(pair, std::pair(cell, -1)) -
                                      pair.begin());
    };
    const std::size_t own = position(first_), end = position(last_);
    // Pairs that start in an earlier range come first, as they do for a single thread.
    if (first_ > 0)
      for (std::size_t k = 0; k < own; ++k)
        if (pair[k].second >= first_ && pair[k].second < last_) push(k);
    flush();
    for (std::size_t k = own; k < end; ++k) push(k);
    flush();
  }

 private:
  void clear() {
    for (auto cell = static_cast<std::size_t>(first_); cell < static_cast<std::size_t>(last_);
         ++cell)
      if (!work_.is_far(cell)) work_.contact_area[cell] = 0;
    for (auto cell = static_cast<std::size_t>(first_); cell < static_cast<std::size_t>(last_);
         cell += kLanes)
      if (!work_.is_ghost(cell))
        std::fill_n(work_.force.data() + cell / kLanes * kPointStride, kPointStride, 0.0);
    touching_.clear();
  }

  void push(std::size_t k) {
    if (batch_.push(k)) flush();
  }

  void flush() {
    if (batch_.size() == 0) return;
    batch_.evaluate_all();
    for (std::size_t l = 0; l < batch_.size(); ++l) spread(batch_.index[l], l);
    batch_.clear();
  }

  /// Adds one pair to the cells of this range.
  void spread(std::size_t k, std::size_t l) {
    const auto [a, b] = work_.pair[k];
    const bool own = a >= first_;
    if (own) write_link(k, l);
    if (batch_.value.touching[l] == 0) return;
    if (own) {
      make_room(touching_, 1);
      touching_.emplace_back(a, b);
    }
    auto add = [&](int cell, double sign) {
      if (cell < first_ || cell >= last_) return;
      const std::size_t i = cell;
      const Address at = cell_address(0, i);
      for (std::size_t m = 0; m < 3 && !work_.is_ghost(i); ++m)
        work_.force[at + m * kLanes] += sign * batch_.value.force[l] * batch_.value.normal[m][l];
      work_.contact_area[i] += batch_.value.area[l];
      if (work_.coupling.empty()) return;
      const FaceModulus& face = batch_.face[l][sign > 0 ? 0 : 1];
      if (!face.own) work_.coupling[i] = std::max(work_.coupling[i], batch_.by_modulus(i, face, l));
    };
    add(a, 1);
    add(b, -1);
  }

  void write_link(std::size_t k, std::size_t l) {
    solve::PointLink& link = link_[k];
    link.a = cell_point(first_row_, work_.pair[k].first);
    link.b = cell_point(first_row_, work_.pair[k].second);
    for (std::size_t m = 0; m < 3; ++m)
      link.normal[m] = static_cast<float>(batch_.value.normal[m][l]);
    link.stiffness = static_cast<float>(batch_.value.stiffness[l]);
    link.friction = static_cast<float>(batch_.friction(l));
  }

  std::size_t first_row_;
  int first_, last_;
  ContactWorkspace& work_;
  solve::PointLinks& link_;
  std::vector<std::pair<int, int>>& touching_;
  PairBatch batch_;
};

/// Record of pair l of an evaluated batch.
contact::Contact record_of(const PairBatch& batch, std::size_t l, std::pair<int, int> pair) {
  const Batch& v = batch.value;
  return {.a = pair.first,
          .b = pair.second,
          .partner = contact::Partner::kSphere,
          .friction = static_cast<float>(batch.friction(l)),
          .normal = Vec3(v.normal[0][l], v.normal[1][l], v.normal[2][l]),
          .gap = -v.overlap[l],
          .touching = v.area[l],
          .force = v.force[l],
          .slope = v.stiffness[l]};
}

}  // namespace

void find_pair_contacts(const ContactInput& in, ContactWorkspace& work, solve::PointLinks& link) {
  const std::size_t n = in.state.n_cell();
  set_size(work.force, in.state.position.size());
  set_size(link, work.pair.size());
  set_size(work.contact_area, n);
  compute_type_factors(in.params, in.options, work);
  const std::size_t n_part = n > kParallelCells ? static_cast<std::size_t>(thread_count()) : 1;
  work.touching_part.resize(n_part - 1);
  for_each_part(n_part, [&](std::size_t k) {
    auto boundary = [&](std::size_t part) {  // whole rows: no two threads share one
      return part == n_part ? n : part * n / n_part / kLanes * kLanes;
    };
    RangeSearch(in, {boundary(k), boundary(k + 1)}, work, link,
                k == 0 ? work.touching : work.touching_part[k - 1])
        .run();
  });
  for (const auto& t : work.touching_part) {
    make_room(work.touching, t.size());
    work.touching.insert(work.touching.end(), t.begin(), t.end());
  }
}

void visit_pairs(const ContactInput& in, const ContactWorkspace& work,
                 const std::function<void(const contact::Contact&)>& visit) {
  PairBatch batch(in, work);
  const auto flush = [&] {
    if (batch.size() == 0) return;
    batch.evaluate_all();
    for (std::size_t l = 0; l < batch.size(); ++l)
      visit(record_of(batch, l, work.pair[batch.index[l]]));
    batch.clear();
  };
  std::size_t k = 0;
  for (const auto& touching : work.touching) {
    if (touching.second < 0) continue;  // contact with the boundary
    while (work.pair[k] != touching) ++k;
    if (batch.push(k)) flush();
  }
  flush();
}

}  // namespace acinus::cbm
