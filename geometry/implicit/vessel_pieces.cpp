#include "geometry/implicit/vessel_pieces.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::geometry {
namespace {

/// Ends of pieces about as long as the vessel is thick, from 0 to 1 along a segment.
std::vector<double> find_ends(const geometry::Network& n, std::size_t segment) {
  constexpr double kShortest = 0.005;
  const auto& [a, b] = n.segment[segment];
  const auto& [ra, rb] = n.radius[segment];
  const double length = (n.node[b] - n.node[a]).norm();
  std::vector<double> ends{0};
  while (ends.back() < 1) {
    const double t = ends.back(), step = std::max(kShortest, (ra + t * (rb - ra)) / length);
    ends.push_back(t + 1.5 * step < 1 ? t + step : 1);
  }
  return ends;
}

}  // namespace

VesselPieces cut_vessels(const geometry::Network& n, double of_radius) {
  VesselPieces out;
  out.network.node = n.node;
  for (std::size_t s = 0; s < n.segment.size(); ++s) {
    const auto [a, b] = n.segment[s];
    const auto [ra, rb] = n.radius[s];
    const auto radius_at = [&](double t) { return ra + t * (rb - ra); };
    const auto size_of = [&](double low, double high) {
      const double thinnest = std::min(ra, rb), thin = std::min(radius_at(low), radius_at(high));
      // In powers of two, so that pieces of much the same size are one.
      return of_radius * thinnest * std::exp2(std::floor(std::log2(thin / thinnest)));
    };
    const std::vector<double> end = find_ends(n, s);
    int from = a;
    double r_from = ra;
    for (std::size_t k = 1; k < end.size(); ++k) {
      const bool last = k + 1 == end.size();
      const double size = size_of(end[k - 1], end[k]);
      if (!last && size == size_of(end[k], end[k + 1])) continue;  // one piece with the next
      int to = b;
      if (!last) {
        to = static_cast<int>(out.network.node.size());
        out.network.node.push_back(n.node[a] + end[k] * (n.node[b] - n.node[a]));
      }
      const double r_to = last ? rb : radius_at(end[k]);
      out.network.segment.push_back({from, to});
      out.network.radius.push_back({r_from, r_to});
      out.whole.push_back(static_cast<int>(s));
      out.size.push_back(size);
      from = to;
      r_from = r_to;
    }
  }
  return out;
}

}  // namespace acinus::geometry
