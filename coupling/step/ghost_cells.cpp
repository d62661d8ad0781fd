#include "coupling/step/ghost_cells.hpp"

#include <algorithm>
#include <compare>
#include <span>

#include "core/sort_unique.hpp"

namespace acinus::coupling {
namespace {

/// Cell sent to or received from another process.
struct SharedCell {
  int rank = 0, cell = 0;
  auto operator<=>(const SharedCell&) const = default;
};

/// Exchange lists between processes, derived from contacts that both sides know.
struct SharedCells {
  std::vector<SharedCell> send, receive;

  void sort() {
    sort_unique(send);
    sort_unique(receive);
  }
  /// Calls f(rank, first and last of send, first and last of receive) for every peer.
  template <class F>
  void for_each_peer(F f) const {
    auto from = send.begin();
    auto to = receive.begin();
    while (from != send.end() || to != receive.end()) {
      int rank = from != send.end() ? from->rank : to->rank;
      if (to != receive.end()) rank = std::min(rank, to->rank);
      const auto first = from;
      const auto begin = to;
      while (from != send.end() && from->rank == rank) ++from;
      while (to != receive.end() && to->rank == rank) ++to;
      f(rank, std::span(first, from), std::span(begin, to));
    }
  }
};

int owner_of_sphere(const Workspace& w, std::size_t sphere) {
  return owner_of_lane(w, w.dcm_lanes + sphere);
}

}  // namespace

int owner_of_lane(const Workspace& w, std::size_t lane) {
  return w.system.ownership.owner[lane / kLanes];
}

void mark_ghost_cells(const World& world, Workspace& w) {
  const State& s = world.state;
  w.dcm_lanes = s.dcm.n_lane();
  w.dcm.ghost.clear();
  w.cbm.ghost.clear();
  const solve::Ownership& ownership = w.system.ownership;
  if (ownership.is_whole()) return;
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l)
    w.dcm.ghost.push_back(ownership.owns(l / kLanes) ? 0 : 1);
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c)
    w.cbm.ghost.push_back(ownership.owns((w.dcm_lanes + c) / kLanes) ? 0 : 1);
}

void exchange_shares(Workspace& w) {
  if (w.system.ownership.is_whole()) return;
  SharedCells bodies;
  const int self = w.system.ownership.ranks.rank();
  const auto meet = [&](int body, int other_owner) {
    const int owner = owner_of_lane(w, w.dcm.lane_of_body[static_cast<std::size_t>(body)]);
    if (owner == other_owner) return;
    if (owner == self)
      bodies.send.push_back({other_owner, body});
    else
      bodies.receive.push_back({owner, body});
  };
  for (const contact::Contact& k : w.contacts.surface())
    if (k.partner == contact::Partner::kSurface)
      meet(k.a, owner_of_lane(w, w.dcm.lane_of_body[static_cast<std::size_t>(k.b)]));
  for (const contact::Contact& k : w.contacts.interface())
    meet(k.a, owner_of_sphere(w, static_cast<std::size_t>(k.b)));
  bodies.sort();
  w.bodies_sent = bodies.send.size();

  ExchangePlan plan;
  std::vector<double> out;
  std::size_t n_in = 0;
  bodies.for_each_peer([&](int rank, auto send, auto receive) {
    ExchangePlan::Peer peer{rank, out.size(), 0, n_in, 0};
    for (const SharedCell& c : send) {
      const std::vector<double>& share = w.dcm.share[static_cast<std::size_t>(c.cell)];
      out.insert(out.end(), share.begin(), share.end());
    }
    for (const SharedCell& c : receive)
      n_in += w.dcm.share[static_cast<std::size_t>(c.cell)].size();
    peer.send_end = out.size();
    peer.receive_end = n_in;
    plan.peer.push_back(peer);
  });
  std::vector<double> in(n_in);
  w.system.ownership.ranks.exchange<double>(plan, out, in);
  auto next = in.begin();
  for (const SharedCell& c : bodies.receive)
    for (double& share : w.dcm.share[static_cast<std::size_t>(c.cell)]) share = *next++;
}

SphereExchange plan_sphere_exchange(const Workspace& w) {
  SphereExchange spheres;
  if (w.system.ownership.is_whole() || w.cbm.ghost.empty()) return spheres;
  SharedCells cells;
  const int self = w.system.ownership.ranks.rank();
  const auto meet = [&](int sphere, int other_owner) {
    const int owner = owner_of_sphere(w, static_cast<std::size_t>(sphere));
    if (owner == other_owner) return;
    if (owner == self)
      cells.send.push_back({other_owner, sphere});
    else
      cells.receive.push_back({owner, sphere});
  };
  for (const auto& [a, b] : w.cbm.pair) {
    meet(a, owner_of_sphere(w, static_cast<std::size_t>(b)));
    meet(b, owner_of_sphere(w, static_cast<std::size_t>(a)));
  }
  for (const auto& [body, sphere] : w.interface.near)
    meet(sphere, owner_of_lane(w, w.dcm.lane_of_body[static_cast<std::size_t>(body)]));
  cells.sort();
  cells.for_each_peer([&](int rank, auto send, auto receive) {
    ExchangePlan::Peer peer{rank, spheres.send.size(), 0, spheres.receive.size(), 0};
    for (const SharedCell& c : send) spheres.send.push_back(c.cell);
    for (const SharedCell& c : receive) spheres.receive.push_back(c.cell);
    peer.send_end = spheres.send.size();
    peer.receive_end = spheres.receive.size();
    spheres.plan.peer.push_back(peer);
  });
  return spheres;
}

void exchange_values(const Workspace& w, const SphereExchange& spheres,
                     std::vector<double>& value) {
  if (value.empty() || spheres.plan.empty()) return;
  std::vector<double> out, in(spheres.receive.size());
  for (const int c : spheres.send) out.push_back(value[static_cast<std::size_t>(c)]);
  w.system.ownership.ranks.exchange<double>(spheres.plan, out, in);
  for (std::size_t k = 0; k < in.size(); ++k)
    value[static_cast<std::size_t>(spheres.receive[k])] = in[k];
}

}  // namespace acinus::coupling
