#include "dcm/contact/contact_lists.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "contact/boundary.hpp"
#include "core/parallel/threads.hpp"

namespace acinus::dcm {
namespace {

/// Extra distance at which bodies count as near each other, um: their possible approach before
/// pairs are searched again.
constexpr double kReserve = 2;
/// Number of pairs of bodies from which on their former lists are searched on all threads.
constexpr std::size_t kWorthThreads = 500;

bool is_constrained(const ListInput& in, std::size_t body) {
  return body >= in.body.size() || (!in.constrained.empty() && in.constrained[body] != 0);
}

/// True if another process computes the contacts of a body. A static mesh, whose contacts no
/// process computes, counts as such.
bool is_ghost(const ListInput& in, std::size_t body) {
  return !in.ghost.empty() && (body >= in.body.size() || in.ghost[body] != 0);
}

/// True if lists made earlier are of use for the present input.
bool made_alike(const ContactLists& lists, const ListInput& in) {
  const contact::SearchOptions &a = lists.options, &b = in.options;
  return a.quadrature == b.quadrature && a.max_depth == b.max_depth && a.skin == b.skin &&
         a.self_range == b.self_range && a.triangles == b.triangles &&
         lists.n_fixed == in.fixed.size();
}

/// True if the listed pairs include all near ones, of the same bodies.
bool pairs_hold(const ListInput& in, const ContactLists& lists) {
  if (lists.body.size() != in.body.size()) return false;
  const double wider = std::max(in.options.range - lists.options.range, 0.0);
  const double room = 0.5 * (kReserve - wider);
  for (std::size_t k = 0; k < in.body.size(); ++k) {
    const ListedBody& b = lists.body[k];
    if (b.lineage != in.lineage[k] || b.topology != in.body[k].topology ||
        b.constrained != is_constrained(in, k) || b.ghost != is_ghost(in, k))
      return false;
    const Box within = b.box.grown(room);
    if (!within.contains(in.body[k].box.low) || !within.contains(in.body[k].box.high)) return false;
  }
  return true;
}

/// Former number of each body; -1: none, or none with lists of use.
std::vector<int> match_bodies(const ListInput& in, const ContactLists& lists) {
  std::vector<int> was(in.body.size(), -1);
  if (!made_alike(lists, in)) return was;
  std::unordered_map<std::int64_t, int> before;
  for (std::size_t k = 0; k < lists.body.size(); ++k)
    before.emplace(lists.body[k].lineage, static_cast<int>(k));
  for (std::size_t k = 0; k < in.body.size(); ++k) {
    const auto found = before.find(in.lineage[k]);
    if (found == before.end()) continue;
    if (lists.body[found->second].topology == in.body[k].topology) was[k] = found->second;
    before.erase(found);
  }
  return was;
}

/// Counts the lists of every time.
void count_lists(ContactLists& lists) {
  for (ListedBody& b : lists.body)
    for (ListTime& t : b.time) t.lists = 0;
  const auto count = [&](int body, int time) {
    if (time >= 0) ++lists.body[body].time[time].lists;
  };
  for (std::size_t k = 0; k < lists.pair.size(); ++k) {
    count(lists.pair[k].body_a, lists.age[k].a);
    count(lists.pair[k].body_b, lists.age[k].b);
  }
  for (std::size_t k = 0; k < lists.segment.size(); ++k)
    count(static_cast<int>(k), lists.segment_age[k].a);
}

/// Search for pairs of near bodies; existing lists are kept.
void renew_pairs(const ListInput& in, ContactLists& lists) {
  const std::vector<int> was = match_bodies(in, lists);
  ContactLists next;
  next.options = in.options;
  next.n_fixed = in.fixed.size();
  next.network = std::move(lists.network);
  next.checked = lists.checked;
  next.made = lists.made;
  next.body.resize(in.body.size());
  next.segment.resize(in.body.size());
  next.segment_age.resize(in.body.size());
  for (std::size_t k = 0; k < in.body.size(); ++k) {
    ListedBody& b = next.body[k];
    if (was[k] >= 0) {
      const std::size_t from = was[k];
      b = std::move(lists.body[from]);
      if (!is_ghost(in, k)) {
        next.segment[k] = std::move(lists.segment[from]);
        next.segment_age[k] = lists.segment_age[from];
      }
    }
    b.lineage = in.lineage[k];
    b.topology = in.body[k].topology;
    b.constrained = is_constrained(in, k);
    b.ghost = is_ghost(in, k);
    b.box = in.body[k].box;
  }
  next.pair = contact::list_pairs(in.body, in.fixed, in.options, kReserve);
  std::erase_if(next.pair, [&](const contact::Candidates& c) {
    return (is_constrained(in, c.body_a) && is_constrained(in, c.body_b)) ||
           (is_ghost(in, c.body_a) && is_ghost(in, c.body_b));
  });
  next.age.resize(next.pair.size());
  const auto number_before = [&](int body) {
    const std::size_t k = body;
    return k < was.size() ? was[k] : body - static_cast<int>(was.size() - lists.body.size());
  };
  const auto bodies_of = [](const contact::Candidates& c) { return std::pair(c.body_a, c.body_b); };
  for_each_index(next.pair.size(), next.pair.size() > kWorthThreads, [&](std::size_t k) {
    contact::Candidates& c = next.pair[k];
    const std::pair before(number_before(c.body_a), number_before(c.body_b));
    const auto found = std::ranges::lower_bound(lists.pair, before, {}, bodies_of);
    if (found == lists.pair.end() || bodies_of(*found) != before) return;
    next.age[k] = lists.age[found - lists.pair.begin()];
    const auto [a, b] = bodies_of(c);
    c = std::move(*found);
    c.body_a = a;
    c.body_b = b;
  });
  lists = std::move(next);
  count_lists(lists);
}

NodeMotion compute_motion(const ListedNodes& from, const contact::SurfaceBody& now) {
  const std::size_t n = from.node.size();
  const auto moved = [&](std::size_t i) -> Vec3 {
    const auto& [x, y, z] = from.node[i];
    return (now.node[i] - from.origin) - from.unit * Vec3(x, y, z);
  };
  Vec3 mean = Vec3::Zero();
  for (std::size_t i = 0; i < n; ++i) mean += moved(i);
  mean /= static_cast<double>(n);
  double spread2 = 0;
  for (std::size_t i = 0; i < n; ++i) spread2 = std::max(spread2, (moved(i) - mean).squaredNorm());
  // Every place is wrong by up to half a diagonal of its unit, and so is the mean of all: thrice
  // that in the deviation and the mean.
  return {mean, std::sqrt(spread2) + 1.5 * std::sqrt(3.0) * from.unit};
}

/// True if the network moved farther than the lists of segments allow. The present network then
/// becomes the new reference of its motion.
bool network_moved(const ListInput& in, double most, ContactLists& lists) {
  if (!in.network_moves || geometry::largest_motion(in.network, lists.network) <= most)
    return false;
  lists.network = in.network;
  return true;
}

/// Motion of a body since one of its times.
NodeMotion motion_since(const ListedBody& body, int time) {
  return body.time[static_cast<std::size_t>(time)].motion + body.motion;
}

/// Allocates a slot for a time of a body.
int allocate_time(ListedBody& body) {
  std::size_t place = 0;
  while (place < body.time.size() && body.time[place].lists > 0) ++place;
  if (place == body.time.size()) body.time.emplace_back();
  body.time[place].lists = 1;
  return static_cast<int>(place);
}

ListedNodes round_nodes(const contact::SurfaceBody& now, ListedNodes memory) {
  ListedNodes nodes = std::move(memory);
  nodes.origin = 0.5 * (now.box.low + now.box.high);
  constexpr double kSteps = 32767;
  nodes.unit = 0.5 * (now.box.high - now.box.low).maxCoeff() / kSteps;
  const double per_unit = nodes.unit > 0 ? 1 / nodes.unit : 0;
  const auto steps = [&](double x) {  // to the nearest: conversion cuts off
    return static_cast<std::int16_t>(static_cast<int>(x * per_unit + kSteps + 1.5) -
                                     static_cast<int>(kSteps + 1));
  };
  nodes.node.resize(now.node.size());
  for (std::size_t i = 0; i < nodes.node.size(); ++i) {
    const Vec3 x = now.node[i] - nodes.origin;
    nodes.node[i] = {steps(x[0]), steps(x[1]), steps(x[2])};
  }
  return nodes;
}

/// Makes the present time the latest of a body: that of the slot. Motions since earlier times are
/// sums of motions, of which the spreads are bounds too.
void begin_time(const contact::SurfaceBody& now, int slot, ListedBody& body) {
  for (ListTime& t : body.time) t.motion = t.motion + body.motion;
  body.time[static_cast<std::size_t>(slot)].motion = {};
  body.latest = round_nodes(now, std::move(body.latest));
  body.motion = {};
}

/// Search for the segments within reach of every site of a body.
void find_segments(const contact::SurfaceBody& b, const contact::SearchOptions& o,
                   const geometry::Network& network, SegmentCandidates& list) {
  list.site.clear();
  list.segment.clear();
  list.start.assign(1, 0);
  const double margin = std::max(o.range, o.max_depth) + o.skin;
  thread_local std::vector<int> near;
  near.clear();
  for (std::size_t s = 0; s < network.segment.size(); ++s) {
    Box box;
    for (int n : network.segment[s]) box.include(network.node[n]);
    const double r = std::max(network.radius[s][0], network.radius[s][1]);
    if (box.grown(r + margin).overlaps(b.box)) near.push_back(static_cast<int>(s));
  }
  if (near.empty()) return;
  // A node includes the segments in the middle of its faces; an edge need not as well.
  double widest = 0;
  for (std::size_t t = 0; t < b.triangle->size(); ++t)
    widest = std::max(widest, contact::triangle_reach(b, t));
  for (std::size_t site = 0; site < contact::n_sites(b, o.quadrature); ++site) {
    const bool node = !contact::has_face_sites(o.quadrature) && site < b.node.size();
    const Vec3 at = contact::site_place(b, o.quadrature, site);
    const double reach = (node ? widest : contact::site_reach(b, o.quadrature, site)) + margin;
    const std::size_t before = list.segment.size();
    for (int s : near)
      if (contact::gap_to_segment(network, s, at).gap < reach) list.segment.push_back(s);
    if (list.segment.size() == before) continue;
    list.site.push_back(static_cast<int>(site));
    list.start.push_back(static_cast<std::uint32_t>(list.segment.size()));
  }
}

}  // namespace

double relative_motion(const ContactLists& lists, std::size_t pair) {
  const contact::Candidates& list = lists.pair[pair];
  const ListAge& age = lists.age[pair];
  const NodeMotion a = motion_since(lists.body[list.body_a], age.a);
  if (age.b < 0) return a.spread + a.mean.norm();  // a static mesh
  if (list.body_a == list.body_b) return 2 * a.spread;
  const NodeMotion b = motion_since(lists.body[list.body_b], age.b);
  return a.spread + b.spread + (a.mean - b.mean).norm();
}

void refresh_pairs(const ListInput& in, ContactLists& lists) {
  if (!made_alike(lists, in) || !pairs_hold(in, lists)) renew_pairs(in, lists);
}

namespace {

/// Collects in the scratch the pairs of bodies and the bodies at vessels whose lists expired.
void find_expired(const ListInput& in, ContactLists& lists) {
  const double range = in.options.range, skin = in.options.skin;
  ListScratch& scratch = lists.scratch;
  scratch.expired.clear();
  scratch.segments_expired.clear();
  std::vector<std::uint8_t>& is_expired = scratch.is_expired;
  is_expired.resize(lists.pair.size());
  for_each_index(is_expired.size(), is_expired.size() > kWorthThreads, [&](std::size_t k) {
    const ListAge& age = lists.age[k];
    is_expired[k] = !age.made() || relative_motion(lists, k) + range - age.range > skin ? 1 : 0;
  });
  for (std::size_t k = 0; k < is_expired.size(); ++k)
    if (is_expired[k] != 0) scratch.expired.push_back(k);
  if (in.network.segment.empty()) return;
  // Half the skin is for the body, half for the motion of vessels, in either direction.
  const double allowed = in.network_moves ? 0.5 * skin : skin;
  const bool moved = network_moved(in, 0.25 * skin, lists);
  for (std::size_t k = 0; k < in.body.size(); ++k) {
    if (is_constrained(in, k) || is_ghost(in, k)) continue;
    const ListAge& age = lists.segment_age[k];
    const auto holds = [&] {
      const NodeMotion motion = motion_since(lists.body[k], age.a);
      return motion.spread + motion.mean.norm() + range - age.range <= allowed;
    };
    if (moved || !age.made() || !holds()) scratch.segments_expired.push_back(k);
  }
}

}  // namespace

void refresh_lists(const ListInput& in, ContactLists& lists) {
  const std::size_t n_body = in.body.size();
  const bool shared =
      n_body > 0 && worth_threads(n_body * in.body[0].node.size() / std::size_t{kLanes});
  for_each_index(n_body, shared, [&](std::size_t k) {
    ListedBody& b = lists.body[k];
    if (std::ranges::any_of(b.time, [](const ListTime& t) { return t.lists > 0; }))
      b.motion = compute_motion(b.latest, in.body[k]);
  });
  find_expired(in, lists);
  ListScratch& scratch = lists.scratch;
  const std::vector<std::size_t>&expired = scratch.expired, &segments = scratch.segments_expired;
  lists.checked += static_cast<std::int64_t>(lists.pair.size() + lists.segment.size());
  lists.made += static_cast<std::int64_t>(expired.size() + segments.size());
  if (expired.empty() && segments.empty()) return;

  const double range = in.options.range;
  std::vector<int>& now = scratch.now;
  now.assign(n_body, -1);
  const auto time_of = [&](std::size_t body) {
    if (body >= n_body) return -1;
    if (now[body] < 0) now[body] = allocate_time(lists.body[body]);
    return now[body];
  };
  scratch.to_fill.clear();
  for (const std::size_t k : expired) {
    contact::Candidates& list = lists.pair[k];
    const int a = time_of(list.body_a), b = time_of(list.body_b);
    lists.age[k] = {a, b, range};
    scratch.to_fill.push_back(&list);
  }
  for (const std::size_t k : segments) lists.segment_age[k] = {time_of(k), -1, range};
  for_each_index(n_body, shared, [&](std::size_t k) {
    if (now[k] >= 0) begin_time(in.body[k], now[k], lists.body[k]);
  });
  count_lists(lists);
  contact::fill_candidates(in.body, in.fixed, in.options, scratch.to_fill);
  for_each_index(segments.size(), shared, [&](std::size_t e) {
    const std::size_t k = segments[e];
    find_segments(in.body[k], in.options, in.network, lists.segment[k]);
  });
}

}  // namespace acinus::dcm
