#include "geometry/edit_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "core/error.hpp"

namespace acinus::geometry {

namespace {

const Vec3& at(const Network& network, int node) { return network.node[node]; }

double length_of(const Network& network, std::size_t segment) {
  const auto& [a, b] = network.segment[segment];
  return (at(network, b) - at(network, a)).norm();
}

// The nodes that segments use, in their order, and the segments renumbered.
Network compacted(const Network& network) {
  std::vector<int> rank(network.node.size(), -1);
  for (const auto& segment : network.segment) {
    for (const int node : segment) rank[node] = 0;
  }
  Network out;
  for (std::size_t node = 0; node < rank.size(); ++node) {
    if (rank[node] < 0) continue;
    rank[node] = static_cast<int>(out.node.size());
    out.node.push_back(network.node[node]);
  }
  out.segment = network.segment;
  out.radius = network.radius;
  for (auto& segment : out.segment) {
    for (int& node : segment) node = rank[node];
  }
  return out;
}

// Equal coordinates become one node; segments without length and repeated pairs go.
Network merged(const Network& network) {
  std::map<std::array<double, 3>, int> first;
  std::vector<int> same(network.node.size());
  for (std::size_t node = 0; node < same.size(); ++node) {
    const Vec3& x = network.node[node];
    same[node] = first.try_emplace({x.x() + 0.0, x.y() + 0.0, x.z() + 0.0}, static_cast<int>(node))
                     .first->second;
  }
  Network out;
  out.node = network.node;
  std::set<std::array<int, 2>> seen;
  for (std::size_t s = 0; s < network.segment.size(); ++s) {
    const int a = same[network.segment[s][0]];
    const int b = same[network.segment[s][1]];
    if (a == b || !seen.insert({std::min(a, b), std::max(a, b)}).second) continue;
    out.segment.push_back({a, b});
    out.radius.push_back(network.radius[s]);
  }
  return out;
}

// A run of segments through nodes of degree 2: node[k] to node[k+1] with radius[k] at its two ends.
struct Chain {
  std::vector<int> node;
  std::vector<std::array<double, 2>> radius;
};

std::vector<Chain> find_chains(const Network& network) {
  std::vector<std::vector<std::size_t>> around(network.node.size());
  for (std::size_t s = 0; s < network.segment.size(); ++s) {
    for (const int node : network.segment[s]) around[node].push_back(s);
  }
  std::vector<char> used(network.segment.size(), 0);
  std::vector<Chain> chains;
  const auto follow = [&](int node, std::size_t segment) {
    Chain chain;
    chain.node = {node};
    while (true) {
      used[segment] = 1;
      const bool forward = network.segment[segment][0] == node;
      const auto& [ra, rb] = network.radius[segment];
      chain.radius.push_back(forward ? std::array{ra, rb} : std::array{rb, ra});
      node = network.segment[segment][forward ? 1 : 0];
      chain.node.push_back(node);
      const auto& next = around[node];
      if (next.size() != 2) break;
      segment = used[next[0]] ? next[1] : next[0];
      if (used[segment]) break;  // round a loop
    }
    chains.push_back(std::move(chain));
  };
  for (const bool loops :
       {false, true}) {  // chains from branch points and ends first, then closed rings
    for (std::size_t node = 0; node < around.size(); ++node) {
      if (!loops && around[node].size() == 2) continue;
      for (const std::size_t segment : around[node]) {
        if (!used[segment]) follow(static_cast<int>(node), segment);
      }
    }
  }
  return chains;
}

// Sums along a chain, so that a span of any number of its segments costs the same.
struct ChainSums {
  std::vector<double> length = {0};  ///< along the chain up to node k
  std::vector<double> area = {0};    ///< integral of the radius over that length
};

ChainSums make_sums(const Network& network, const Chain& chain) {
  ChainSums sums;
  for (std::size_t k = 0; k + 1 < chain.node.size(); ++k) {
    const double part = (at(network, chain.node[k + 1]) - at(network, chain.node[k])).norm();
    sums.length.push_back(sums.length.back() + part);
    sums.area.push_back(sums.area.back() + part * (chain.radius[k][0] + chain.radius[k][1]) / 2);
  }
  return sums;
}

// Never 0 / 0: merged() left no segment without length.
double mean_radius(const ChainSums& sums, std::size_t from, std::size_t to) {
  return (sums.area[to] - sums.area[from]) / (sums.length[to] - sums.length[from]);
}

// Radii at the ends of the span from chain node `from` to `to`, as one segment.
std::array<double, 2> span_radius(const Chain& chain, const ChainSums& sums, std::size_t from,
                                  std::size_t to) {
  const double start = chain.radius[from][0], end = chain.radius[to - 1][1];
  if (to - from == 1) return {start, end};
  double smallest = start;
  for (std::size_t k = from; k < to; ++k)
    smallest = std::min({smallest, chain.radius[k][0], chain.radius[k][1]});
  const double shift = mean_radius(sums, from, to) - (start + end) / 2;
  return {std::max(start + shift, smallest), std::max(end + shift, smallest)};
}

// Indices into the chain of the nodes to keep, the first and the last among them.
std::vector<std::size_t> kept_nodes(const Network& network, const Chain& chain,
                                    const ChainSums& sums) {
  const std::size_t last = chain.node.size() - 1;
  // Judged by the radius the span will have: span_radius may raise it above the mean.
  const auto is_long = [&](std::size_t from, std::size_t to) {
    const double chord = (at(network, chain.node[to]) - at(network, chain.node[from])).norm();
    if (chord < mean_radius(sums, from, to) / 2) return false;  // the same for less work
    const auto& [start, end] = span_radius(chain, sums, from, to);
    return chord >= (start + end) / 4;
  };
  std::vector<std::size_t> kept = {0};
  for (std::size_t k = 1; k < last; ++k) {
    if (is_long(kept.back(), k)) kept.push_back(k);
  }
  // The last span may be short still: give its nodes to the one before.
  while (kept.size() > 1 && !is_long(kept.back(), last)) kept.pop_back();
  kept.push_back(last);
  // A ring needs three segments to stay a ring.
  if (chain.node.front() == chain.node.back() && kept.size() < 4) {
    kept.resize(chain.node.size());
    for (std::size_t k = 0; k < kept.size(); ++k) kept[k] = k;
  }
  return kept;
}

}  // namespace

double largest_motion(const Network& now, const Network& then) {
  if (now.segment != then.segment || now.node.size() != then.node.size())
    return std::numeric_limits<double>::infinity();
  double moved2 = 0, wider = 0;
  for (std::size_t i = 0; i < now.node.size(); ++i)
    moved2 = std::max(moved2, (now.node[i] - then.node[i]).squaredNorm());
  for (std::size_t s = 0; s < now.radius.size(); ++s)
    for (const std::size_t end : {0, 1})
      wider = std::max(wider, std::abs(now.radius[s][end] - then.radius[s][end]));
  return std::sqrt(moved2) + wider;
}

double total_length(const Network& network) {
  double length = 0;
  for (std::size_t s = 0; s < network.segment.size(); ++s) length += length_of(network, s);
  return length;
}

Network transform_network(const Network& network, const NetworkTransform& transform) {
  for (const auto& [name, value] :
       {std::pair{"unit", transform.unit}, std::pair{"scale", transform.scale},
        std::pair{"radius_scale", transform.radius_scale}}) {
    check(std::isfinite(value) && value > 0,
          fmt::format("vessel network: {} is {}; it must be a number above 0.", name, value));
  }
  check(transform.shift.allFinite(), "vessel network: the shift must be three finite numbers.");
  Network out = network;
  const double scale = transform.unit * transform.scale;
  for (Vec3& x : out.node) x *= scale;
  for (auto& radius : out.radius) {
    for (double& r : radius) r *= scale * transform.radius_scale;
  }
  Vec3 shift = transform.shift;
  if (transform.center && !out.node.empty()) {
    Vec3 low = out.node[0], high = out.node[0];
    for (const Vec3& x : out.node) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    shift -= (low + high) / 2;
  }
  for (Vec3& x : out.node) x += shift;
  return out;
}

Network crop_network(const Network& network, const std::array<Vec3, 2>& box) {
  const auto& [low, high] = box;
  check((low.array() <= high.array()).all(),
        fmt::format("vessel network: the crop box runs from ({}, {}, {}) to ({}, {}, {}); each low "
                    "coordinate must "
                    "not exceed the high one.",
                    low.x(), low.y(), low.z(), high.x(), high.y(), high.z()));
  Network kept;
  kept.node = network.node;
  for (std::size_t s = 0; s < network.segment.size(); ++s) {
    const Vec3& a = at(network, network.segment[s][0]);
    const Vec3 way = at(network, network.segment[s][1]) - a;
    double enter = 0, leave = 1;  // part of the segment inside the slabs so far
    for (int k = 0; k < 3; ++k) {
      if (way[k] == 0) {
        if (a[k] < low[k] || a[k] > high[k]) leave = -1;
        continue;
      }
      const double to_low = (low[k] - a[k]) / way[k], to_high = (high[k] - a[k]) / way[k];
      enter = std::max(enter, std::min(to_low, to_high));
      leave = std::min(leave, std::max(to_low, to_high));
    }
    if (enter > leave) continue;
    kept.segment.push_back(network.segment[s]);
    kept.radius.push_back(network.radius[s]);
  }
  return compacted(kept);
}

Network resample_network(const Network& network) {
  const Network clean = merged(network);
  Network out;
  out.node = clean.node;
  for (const Chain& chain : find_chains(clean)) {
    const ChainSums sums = make_sums(clean, chain);
    const std::vector<std::size_t> kept = kept_nodes(clean, chain, sums);
    for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
      out.segment.push_back({chain.node[kept[k]], chain.node[kept[k + 1]]});
      out.radius.push_back(span_radius(chain, sums, kept[k], kept[k + 1]));
    }
  }
  return compacted(out);
}

Network split_network(const Network& network, double longest) {
  check(
      longest > 0 && std::isfinite(longest),
      fmt::format("segments cannot be cut to at most {} um: the length must be above 0", longest));
  Network out;
  out.node = network.node;
  Network more;  // further parts
  for (std::size_t s = 0; s < network.segment.size(); ++s) {
    const auto [a, b] = network.segment[s];
    const auto [ra, rb] = network.radius[s];
    const int parts = std::max(1, static_cast<int>(std::ceil(length_of(network, s) / longest)));
    int from = a;
    for (int k = 0; k < parts; ++k) {
      const double end = (k + 1.0) / parts, begin = static_cast<double>(k) / parts;
      int to = b;
      if (k + 1 < parts) {
        to = static_cast<int>(out.node.size());
        out.node.push_back(at(network, a) + end * (at(network, b) - at(network, a)));
      }
      Network& list = k == 0 ? out : more;
      list.segment.push_back({from, to});
      list.radius.push_back({ra + begin * (rb - ra), ra + end * (rb - ra)});
      from = to;
    }
  }
  out.segment.insert(out.segment.end(), more.segment.begin(), more.segment.end());
  out.radius.insert(out.radius.end(), more.radius.begin(), more.radius.end());
  return out;
}

}  // namespace acinus::geometry
