#include <xxhash.h>

#include <array>
#include <memory>

#include "coupling/world/state_parts.hpp"

namespace acinus::coupling {
namespace {

class StateHash {
 public:
  StateHash() : state_(XXH64_createState(), XXH64_freeState) { XXH64_reset(state_.get(), 0); }
  /// Adds the bytes of a vector, an array or a span.
  template <class Values>
  void add(const Values& v) {
    if (!v.empty()) XXH64_update(state_.get(), v.data(), v.size() * sizeof(v[0]));
  }
  std::uint64_t value() const { return XXH64_digest(state_.get()); }

 private:
  std::unique_ptr<XXH64_state_t, decltype(&XXH64_freeState)> state_;
};

/// Numbers of a cycle in the order in which they are hashed.
std::array<double, 7> numbers_of(const Cycle& c) {
  return {c.birth,
          c.birth_volume,
          c.duration,
          c.wait_until,
          static_cast<double>(c.parent),
          static_cast<double>(c.founder),
          static_cast<double>(c.fate)};
}

/// Numbers of a birth shape in that order.
void append_shape(const dcm::BirthShape& b, std::vector<double>& out) {
  for (const SharedNumbers* v : {&b.edge, &b.triangle, &b.link})
    out.insert(out.end(), v->begin(), v->end());
  if (!b.edge.empty()) out.insert(out.end(), {b.area, b.weight.start, b.weight.end});
}

}  // namespace

std::uint64_t hash_state(const Ranks& ranks, const State& s) {
  StateHash hash;
  const auto add = [&hash](const auto& v) { hash.add(v); };
  const auto add_numbers = [&hash](std::span<const double> v) { hash.add(v); };
  const auto add_lanes = [&](LaneRange range, const auto& append) {
    visit_lanes(ranks, s, range, append,
                [&hash](std::size_t, std::span<const double> v) { hash.add(v); });
  };
  const LaneRange shells = shell_lanes(s), spheres = sphere_lanes(s);
  const auto add_ramps_of_spheres = [&](const auto& ramps) {
    add_lanes(spheres, [&](std::size_t lane, std::vector<double>& out) {
      const Ramp& r = ramps[lane - spheres.first];
      out.insert(out.end(), {r.from, r.to, r.start, r.end});
    });
  };
  visit_shell_positions(ranks, s, add_numbers);
  visit_sphere_positions(ranks, s, add_numbers);
  for (const Vec3& x : s.tree.node) add(std::array{x.x(), x.y(), x.z()});
  for (const Eigen::Quaterniond& q : s.tree.rotation) add(std::array{q.w(), q.x(), q.y(), q.z()});
  add(s.dcm.lineage);
  add(s.cbm.lineage);
  add_lanes(spheres, [&](std::size_t lane, std::vector<double>& out) {
    out.push_back(s.cbm.young[lane - spheres.first]);
  });
  for (const Ramp& r : s.dcm.volume) add(std::array{r.from, r.to, r.start, r.end});
  add_ramps_of_spheres(s.cbm.volume);
  add_ramps_of_spheres(s.cbm.strength);
  visit_touching(ranks, s, add);
  visit_last_move(ranks, s, add_numbers);
  add(s.leader);
  add(s.asleep);
  add(s.model_since);
  for (const FadingForce& f : s.fading) {
    add(std::array{f.a, f.b});
    add(std::array{f.force.x(), f.force.y(), f.force.z(), f.virial, f.share.start, f.share.end});
    add(std::array{f.apart.x(), f.apart.y(), f.apart.z(), f.reach});
  }
  if (!s.cycle.empty())
    add_lanes({shells.first, spheres.end}, [&s](std::size_t lane, std::vector<double>& out) {
      const auto numbers = numbers_of(s.cycle[lane]);
      out.insert(out.end(), numbers.begin(), numbers.end());
    });
  add_lanes(shells, [&s](std::size_t lane, std::vector<double>& out) {
    append_shape(s.dcm.birth[lane], out);
  });
  for (const dcm::EdgeTension& t : s.dcm.tension) {
    add(t.force);
    add(t.length);
  }
  add(std::array{s.clock.time, s.clock.origin, s.clock.step, s.clock.last_step});
  add(std::array{static_cast<std::int64_t>(s.clock.phase), s.clock.accepted,
                 static_cast<std::int64_t>(s.clock.coarse ? 1 : 0), s.leader_interval,
                 s.sleep_interval, s.life_interval, s.next_lineage, s.divisions, s.deaths});
  for (const SubstanceState& field : s.substance) {
    add(field.concentration);
    if (!field.open.empty()) add(field.open);
    if (const InsideState& inside = field.inside; !inside.cell.empty()) {
      add(inside.cell);
      add(inside.voxel);
      add(inside.volume);
      add(inside.concentration);
    }
    add(std::array{field.secreted, field.entered, field.supplied, field.decayed});
    if (field.layers != substances::Layers{}) add(field.layers);
  }
  return hash.value();
}

std::uint64_t hash_state(const State& s) { return hash_state(Ranks::serial(), s); }

}  // namespace acinus::coupling
