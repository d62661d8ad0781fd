#include "cbm/pair_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/jkr.hpp"
#include "contact/jkr_lanes.hpp"
#include "core/parallel/make_room.hpp"
#include "core/parallel/threads.hpp"

namespace acinus::cbm {
namespace {

/// Below this many cells starting threads costs more than it saves.
constexpr std::size_t kParallelCells = 2000;

/// Eight pairs on their way through the law.
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

/// Leaves each pair its share of all that it does; without a share it does not touch.
void weaken(const double (&share)[kLanes], Batch& p) {
  for (std::size_t l = 0; l < kLanes; ++l) {
    for (double* v : {&p.force[l], &p.stiffness[l], &p.area[l]}) *v *= share[l];
    if (share[l] <= 0) p.touching[l] = 0;
  }
}

void find_type_factors(std::span<const Params> params, double adhesion_factor,
                       std::vector<TypeFactors>& factors) {
  factors.clear();
  for (const Params& p : params)
    factors.push_back({1 - p.poisson * p.poisson, std::sqrt(adhesion_factor * p.adhesion)});
}

FaceModulus face_toward(const ContactInput& in, const ContactWorkspace& work, std::size_t cell,
                        double overlap) {
  const Modulus& crowd = work.modulus[cell];
  if (work.coupling.empty()) return {crowd};  // no type has a law
  const StiffnessLaw& law = in.params[in.state.type[cell]].correction;
  return modulus_toward(law, in.state.young[cell], crowd, overlap);
}

/// One thread's cells [first, last): all pairs that have a side among them.
class RangeSearch {
 public:
  RangeSearch(const ContactInput& in, std::pair<std::size_t, std::size_t> range,
              ContactWorkspace& work, std::vector<solve::PointLink>& link,
              std::vector<std::pair<int, int>>& touching)
      : in_(in),
        s_(in.state),
        friction_(in.options.friction_factor * in.options.cell_friction),
        cells_(in.cells),
        first_row_(in.first_row),
        first_(static_cast<int>(range.first)),
        last_(static_cast<int>(range.second)),
        work_(work),
        link_(link),
        touching_(touching) {}

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
    const std::size_t from = first_, to = last_;
    std::fill(work_.contact_area.begin() + first_, work_.contact_area.begin() + last_, 0.0);
    std::fill(work_.force.begin() + static_cast<std::ptrdiff_t>(from / kLanes * kPointStride),
              work_.force.begin() +
                  static_cast<std::ptrdiff_t>((to + kLanes - 1) / kLanes * kPointStride),
              0.0);
    touching_.clear();
  }

  void push(std::size_t k) {
    index_[n_] = k;
    const auto [a, b] = work_.pair[k];
    const std::size_t i = a, j = b;
    const Address at_a = cell_address(0, i), at_b = cell_address(0, j);
    const double* x = s_.position.data();
    for (std::size_t m = 0; m < 3; ++m) {
      batch_.xa[m][n_] = x[at_a + m * kLanes];
      batch_.xb[m][n_] = x[at_b + m * kLanes];
    }
    batch_.radius_a[n_] = cells_.radius[i];
    batch_.radius_b[n_] = cells_.radius[j];
    if (!cells_.strength.empty()) share_[n_] = cells_.pair_share(i, j);
    const std::size_t ta = s_.type[i], tb = s_.type[j];
    const Modulus *of_a = &work_.modulus[i], *of_b = &work_.modulus[j];
    if (!work_.coupling.empty()) {  // a law corrects
      const double overlap = overlap_now();
      face_[n_] = {face_toward(in_, work_, i, overlap), face_toward(in_, work_, j, overlap)};
      of_a = &face_[n_][0];
      of_b = &face_[n_][1];
    }
    const TypeFactors &of_ta = work_.type_factors[ta], &of_tb = work_.type_factors[tb];
    batch_.compliance[n_] = of_ta.softness / of_a->value + of_tb.softness / of_b->value;
    batch_.adhesion[n_] = of_ta.root_adhesion * of_tb.root_adhesion;
    batch_.was_touching[n_] = was_touching({a, b}) ? 1 : 0;
    if (++n_ == kLanes) flush();
  }

  /// Of the pair being pushed, over the sum of its radii.
  double overlap_now() const {
    double squared = 0;
    for (std::size_t m = 0; m < 3; ++m) {
      const double d = batch_.xa[m][n_] - batch_.xb[m][n_];
      squared += d * d;
    }
    return 1 - std::sqrt(squared) / (batch_.radius_a[n_] + batch_.radius_b[n_]);
  }

  /// Pairs come in the order of the touching set, so that a finger moves along both.
  bool was_touching(std::pair<int, int> p) {
    const auto& t = s_.touching;
    if (finger_ == kUnset || (finger_ > 0 && !(t[finger_ - 1] < p)))
      finger_ = static_cast<std::size_t>(std::ranges::lower_bound(t, p) - t.begin());
    while (finger_ < t.size() && t[finger_] < p) ++finger_;
    return finger_ < t.size() && t[finger_] == p;
  }

  void flush() {
    if (n_ == 0) return;
    for (std::size_t l = n_; l < kLanes; ++l) {  // idle lanes repeat the last pair
      for (std::size_t m = 0; m < 3; ++m) {
        batch_.xa[m][l] = batch_.xa[m][n_ - 1];
        batch_.xb[m][l] = batch_.xb[m][n_ - 1];
      }
      batch_.radius_a[l] = batch_.radius_a[n_ - 1];
      batch_.radius_b[l] = batch_.radius_b[n_ - 1];
      batch_.compliance[l] = batch_.compliance[n_ - 1];
      batch_.adhesion[l] = batch_.adhesion[n_ - 1];
      batch_.was_touching[l] = batch_.was_touching[n_ - 1];
    }
    evaluate(batch_);
    if (!cells_.strength.empty()) weaken(share_, batch_);
    if (!work_.coupling.empty())
      for (std::size_t l = 0; l < n_; ++l) stiffen(l);
    for (std::size_t l = 0; l < n_; ++l) spread(index_[l], l);
    n_ = 0;
  }

  /// Adds one pair to the cells of this range.
  void spread(std::size_t k, std::size_t l) {
    const auto [a, b] = work_.pair[k];
    const bool own = a >= first_;
    if (own) write_link(k, l);
    if (batch_.touching[l] == 0) return;
    if (own) {
      make_room(touching_, 1);
      touching_.emplace_back(a, b);
    }
    auto add = [&](int cell, double sign) {
      if (cell < first_ || cell >= last_) return;
      const std::size_t i = cell;
      const Address at = cell_address(0, i);
      for (std::size_t m = 0; m < 3; ++m)
        work_.force[at + m * kLanes] += sign * batch_.force[l] * batch_.normal[m][l];
      work_.contact_area[i] += batch_.area[l];
      if (work_.coupling.empty()) return;
      const FaceModulus& face = face_[l][sign > 0 ? 0 : 1];
      if (!face.own) work_.coupling[i] = std::max(work_.coupling[i], by_modulus(i, face, l));
    };
    add(a, 1);
    add(b, -1);
  }

  /// How much stiffer a contact is because the modulus of a side grows with its overlap. dF/dE^ is
  /// (2/3) (overlap / E^) dF/d overlap, since F depends on overlap E^(2/3) alone.
  double by_modulus(std::size_t cell, const Modulus& m, std::size_t l) const {
    const double softness = work_.type_factors[s_.type[cell]].softness;
    const double by_own = 2.0 / 3 * std::max(batch_.overlap[l], 0.0) * batch_.stiffness[l] *
                          softness / (batch_.compliance[l] * m.value * m.value);
    return by_own * m.slope / (batch_.radius_a[l] + batch_.radius_b[l]);
  }

  /// Adds that to a contact whose own overlap decides.
  void stiffen(std::size_t l) {
    const auto [a, b] = work_.pair[index_[l]];
    double more = 0;
    if (face_[l][0].own) more += by_modulus(a, face_[l][0], l);
    if (face_[l][1].own) more += by_modulus(b, face_[l][1], l);
    batch_.stiffness[l] += more;
  }

  void write_link(std::size_t k, std::size_t l) {
    solve::PointLink& link = link_[k];
    link.a = cell_point(first_row_, work_.pair[k].first);
    link.b = cell_point(first_row_, work_.pair[k].second);
    for (std::size_t m = 0; m < 3; ++m) link.normal[m] = static_cast<float>(batch_.normal[m][l]);
    link.stiffness = static_cast<float>(batch_.stiffness[l]);
    link.friction = static_cast<float>(friction_ * batch_.area[l]);
  }

  static constexpr std::size_t kUnset = -1;
  const ContactInput& in_;
  const State& s_;
  double friction_;
  const CellData& cells_;
  std::size_t first_row_;
  int first_, last_;
  ContactWorkspace& work_;
  std::vector<solve::PointLink>& link_;
  std::vector<std::pair<int, int>>& touching_;
  Batch batch_{};
  std::array<std::array<FaceModulus, 2>, kLanes> face_{};  ///< of both sides
  double share_[kLanes] = {};  ///< used only when not all strengths are 1
  std::size_t index_[kLanes] = {};
  std::size_t n_ = 0, finger_ = kUnset;
};

}  // namespace

void find_pair_contacts(const ContactInput& in, ContactWorkspace& work,
                        std::vector<solve::PointLink>& link) {
  const std::size_t n = in.state.n_cell();
  work.force.resize(in.state.position.size());
  link.resize(work.pair.size());
  work.contact_area.resize(n);
  find_type_factors(in.params, in.options.adhesion_factor, work.type_factors);
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
  for (const auto& t : work.touching_part)
    work.touching.insert(work.touching.end(), t.begin(), t.end());
}

void list_pairs(const ContactInput& in, const ContactWorkspace& work,
                contact::ContactList& contacts) {
  const State& s = in.state;
  const std::span<const double> radius = in.cells.radius;
  for (const auto& [a, b] : work.touching) {
    if (b < 0) continue;  // boundary
    const std::size_t i = a, j = b;
    const std::size_t ta = s.type[i], tb = s.type[j];
    const Vec3 d = center_of(s, i) - center_of(s, j);
    const double distance = d.norm(), overlap = radius[i] + radius[j] - distance;
    const double sum = radius[i] + radius[j];
    auto softness = [&](std::size_t cell, std::size_t type) {
      return work.type_factors[type].softness / face_toward(in, work, cell, overlap / sum).value;
    };
    const contact::SpherePair pair{
        radius[i] * radius[j] / sum, 1 / (softness(i, ta) + softness(j, tb)),
        work.type_factors[ta].root_adhesion * work.type_factors[tb].root_adhesion};
    const contact::SphereForce law =
        weaken(contact::jkr_force(pair, overlap, true), in.cells.pair_share(i, j));
    const double area = kPi * law.contact_radius * law.contact_radius;
    contacts.all.push_back({.a = a,
                            .b = b,
                            .partner = contact::Partner::kSphere,
                            .friction = static_cast<float>(in.options.friction_factor *
                                                           in.options.cell_friction * area),
                            .place = {},
                            .normal = distance > 0 ? Vec3(d / distance) : Vec3::UnitX(),
                            .gap = -overlap,
                            .touching = area,
                            .force = law.force,
                            .slope = std::max(0.0, law.stiffness)});
  }
}

}  // namespace acinus::cbm
