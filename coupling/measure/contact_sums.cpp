#include "coupling/measure/contact_sums.hpp"

#include <algorithm>
#include <compare>
#include <cstdint>
#include <limits>
#include <tuple>

#include "core/parallel/disjoint_sets.hpp"
#include "core/sort_unique.hpp"
#include "coupling/measure/cell_numbers.hpp"

namespace acinus::coupling {
namespace {

constexpr std::uint32_t kBoundary = std::numeric_limits<std::uint32_t>::max();

/// Pair of a contact.
struct PairKey {
  std::uint32_t a = 0, b = kBoundary;  ///< cells, a < b
  std::int32_t index = 0;              ///< of the boundary, within its kind
  contact::Partner kind{};             ///< of the boundary
  auto order() const { return std::tuple(b != kBoundary, a, b, kind, index); }
  bool operator==(const PairKey&) const = default;
  auto operator<=>(const PairKey& other) const { return order() <=> other.order(); }
};

PairKey key_of(const ContactForce& c) {
  const auto number = [](std::size_t cell) { return static_cast<std::uint32_t>(cell); };
  if (c.b == kNoCell) return {number(c.a), kBoundary, c.index, c.kind};
  return {number(std::min(c.a, c.b)), number(std::max(c.a, c.b)), 0, {}};
}

/// Share of one contact in the sums of its pair.
struct Part {
  bool exists = false;
  bool counts = false;  ///< true if the force does
  std::array<double, 2> area{};
};

Part part_of(const ContactForce& c, const AreasOfContact& areas) {
  Part part;
  part.counts = c.b == kNoCell ? !c.fades : c.touching || c.fades;
  if (areas && c.a != c.b) part.area = areas(c);
  part.exists = part.counts || part.area[0] > 0 || part.area[1] > 0;
  return part;
}

void add_part(const ContactForce& c, const Part& part, CellContact& sum) {
  const bool swapped = c.b < c.a;
  sum.area_a += part.area[swapped ? 1 : 0];
  sum.area_b += part.area[swapped ? 0 : 1];
  if (!part.counts) return;
  sum.force += c.a < c.b ? c.force : Vec3(-c.force);
  sum.touching = sum.touching || c.touching;
  if (c.b == kNoCell) sum.normal_force += c.force.dot(c.normal);
}

/// Ascending set of keys. Many contacts of a surface have the same, so repeated ones are dropped
/// each time the list has doubled.
class PairKeys {
 public:
  void add(const PairKey& key) {
    if (!key_.empty() && key_.back() == key) return;
    if (key_.size() >= limit_) {
      sort_unique(key_);
      limit_ = std::max(limit_, 2 * key_.size());
    }
    key_.push_back(key);
  }
  std::vector<PairKey> take() {
    sort_unique(key_);
    return std::move(key_);
  }

 private:
  std::vector<PairKey> key_;
  std::size_t limit_ = 4096;
};

/// Index of a key. That of the contact before, or the next one, is tried first.
std::size_t find_key(const std::vector<PairKey>& keys, const PairKey& key, std::size_t last) {
  for (const std::size_t k : {last, last + 1})
    if (k < keys.size() && keys[k] == key) return k;
  return static_cast<std::size_t>(std::ranges::lower_bound(keys, key) - keys.begin());
}

}  // namespace

std::vector<CellContact> sum_contacts(const World& world, const Workspace& w,
                                      const AreasOfContact& areas) {
  PairKeys found;
  visit_contacts(world, w, [&](const ContactForce& c) {
    if (part_of(c, areas).exists) found.add(key_of(c));
  });
  const std::vector<PairKey> keys = found.take();
  std::vector<CellContact> list(keys.size());
  std::size_t at = 0;
  visit_contacts(world, w, [&](const ContactForce& c) {
    const Part part = part_of(c, areas);
    if (!part.exists) return;
    at = find_key(keys, key_of(c), at);
    add_part(c, part, list[at]);
  });
  const std::vector<Vec3> center = list_centers(world, w);
  const std::size_t n_deformable = number_cells(world.state, w).lane.size();
  for (std::size_t k = 0; k < keys.size(); ++k) {
    CellContact& c = list[k];
    std::tie(c.a, c.partner, c.index) = std::tie(keys[k].a, keys[k].kind, keys[k].index);
    if (keys[k].b == kBoundary) continue;
    c.b = keys[k].b;
    c.partner = c.b < n_deformable ? contact::Partner::kSurface : contact::Partner::kSphere;
    c.normal_force = c.force.dot((center[c.a] - center[c.b]).normalized());
  }
  return list;
}

std::vector<CellPair> find_touching(const World& world, const Workspace& w) {
  PairKeys found;
  visit_contacts(world, w, [&](const ContactForce& c) {
    if (c.touching) found.add(key_of(c));
  });
  std::vector<CellPair> own, all;
  for (const PairKey& key : found.take()) own.push_back({key.a, key.b});
  if (w.system.ownership.is_whole()) return own;
  w.system.ownership.ranks.gather<CellPair>(own, all);
  sort_unique(all);
  return all;
}

std::vector<int> cluster_sizes(std::size_t n_cell, const std::vector<CellPair>& touching) {
  DisjointSets clusters(n_cell);
  for (const auto& [a, b] : touching) clusters.join(static_cast<int>(a), static_cast<int>(b));
  std::vector<int> members(n_cell, 0), size;
  for (int i = 0; i < static_cast<int>(n_cell); ++i) ++members[clusters.find(i)];
  for (int i = 0; i < static_cast<int>(n_cell); ++i) size.push_back(members[clusters.find(i)]);
  return size;
}

}  // namespace acinus::coupling
