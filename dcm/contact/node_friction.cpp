#include "dcm/contact/node_friction.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "core/parallel/append_in_order.hpp"
#include "core/parallel/threads.hpp"
#include "dcm/contact/contact_loads.hpp"
#include "dcm/contact/contact_params.hpp"
#include "dcm/contact/contact_points.hpp"
#include "dcm/contact/contact_sides.hpp"

namespace acinus::dcm {
namespace {

/// Consecutive contacts that join the same two bodies.
struct ContactRun {
  std::array<int, 2> body{};  ///< the lower one first
  std::size_t first = 0, last = 0;
};

/// Runs of contacts between cells, sorted by pairs of bodies.
std::vector<ContactRun> find_runs(std::span<const contact::Contact> contacts) {
  std::vector<ContactRun> runs;
  for (std::size_t k = 0, next; k < contacts.size(); k = next) {
    const contact::Contact& first = contacts[k];
    const auto belongs = [&](const contact::Contact& other) {
      return other.a == first.a && other.b == first.b && other.partner == first.partner;
    };
    for (next = k; next < contacts.size() && belongs(contacts[next]);) ++next;
    if (first.partner == contact::Partner::kSurface && !first.is_fold())
      runs.push_back({{std::min(first.a, first.b), std::max(first.a, first.b)}, k, next});
  }
  std::ranges::stable_sort(runs, {}, &ContactRun::body);
  return runs;
}

/// Nodes that a contact point represents.
std::span<const int> nodes_of(const contact::PointStencil& s) {
  return {s.node.data(), static_cast<std::size_t>(s.n)};
}

/// Friction between the nodes of two bodies.
class NodePairs {
 public:
  void start(std::size_t n_a, std::size_t n_b) {
    for (const PairFriction& e : entry_) slot_[slot_of(e.a, e.b)] = 0;
    entry_.clear();
    n_b_ = n_b;
    if (slot_.size() < n_a * n_b) slot_.resize(n_a * n_b, 0);
  }
  void add(int a, int b, double friction) {
    std::uint32_t& slot = slot_[slot_of(a, b)];
    if (slot == 0) {
      entry_.push_back({a, b, 0});
      slot = static_cast<std::uint32_t>(entry_.size());
    }
    entry_[slot - 1].friction += friction;
  }
  template <class F>
  void for_each(F f) const {
    for (const PairFriction& e : entry_) f(e.a, e.b, e.friction);
  }

 private:
  struct PairFriction {
    int a, b;
    double friction;  ///< nN s/um
  };
  std::size_t slot_of(int a, int b) const { return a * n_b_ + b; }
  std::size_t n_b_ = 0;
  std::vector<std::uint32_t> slot_;  ///< [n_a][n_b] 1 + number of the entry; 0: none
  std::vector<PairFriction> entry_;
};

/// Friction of a contact, nN s/um.
double friction_of(const ContactInput& in, const ContactWorkspace& work,
                   const contact::Contact& s) {
  const ContactParams& c = in.options;
  if (is_triangle_contact(c, s)) return c.friction_factor * c.cell_friction * s.touching;
  const std::size_t a = s.a;
  return 0.5 *
         point_area(*work.body[a].topology, c.quadrature, s.point,
                    in.lanes.radius[work.lane_of_body[a]]) *
         cell_friction_at(c, work, s);
}

/// Adds the contacts of a run to the pairs of its bodies' nodes.
void add_run(const ContactInput& in, const ContactWorkspace& work,
             std::span<const contact::Contact> run, NodePairs& table) {
  const ContactParams& c = in.options;
  for (const contact::Contact& s : run) {
    const std::size_t a = s.a, b = s.b;
    const double friction = friction_of(in, work, s);
    if (friction == 0) continue;
    const contact::PointStencil at = stencil_of(c, work.body[a], s);
    const auto own = nodes_of(at);
    const auto& other = (*work.body[b].triangle)[s.triangle];
    const double each = friction / static_cast<double>(own.size() * other.size());
    for (const int i : own)
      for (const int j : other)
        if (s.a < s.b)
          table.add(i, j, each);
        else
          table.add(j, i, each);
  }
}

}  // namespace

void add_node_friction(const ContactInput& in, const ContactWorkspace& work,
                       const contact::ContactList& contacts, solve::PointLinks& links) {
  const ContactParams& c = in.options;
  if (c.friction_factor * c.cell_friction == 0) return;
  const std::span<const contact::Contact> surface = contacts.surface();
  const std::vector<ContactRun> runs = find_runs(surface);
  std::vector<std::size_t> group;  // where each pair of bodies starts
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (k == 0 || runs[k].body != runs[k - 1].body) group.push_back(k);
  group.push_back(runs.size());
  const auto add_group = [&](std::size_t g, solve::PointLinks& out) {
    thread_local NodePairs table;  // keeps its memory
    const int a = runs[group[g]].body[0], b = runs[group[g]].body[1];
    const auto& body_a = work.body[a];
    const auto& body_b = work.body[b];
    table.start(body_a.node.size(), body_b.node.size());
    for (std::size_t k = group[g]; k < group[g + 1]; ++k)
      add_run(in, work, surface.subspan(runs[k].first, runs[k].last - runs[k].first), table);
    auto point = [&](int body, int node) {
      return side_at(in.state, work.lane_of_body[body], {1, {node, 0, 0}, {1, 0, 0}}).point[0];
    };
    table.for_each([&](int i, int j, double friction) {
      out.push_back({point(a, i), point(b, j), {}, 0, static_cast<float>(friction)});
    });
  };
  append_in_order(group.size() - 1, worth_threads(in.state.n_row()), links, add_group);
}

}  // namespace acinus::dcm
