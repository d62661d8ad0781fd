#include "solve/point_exchange.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <utility>

#include "solve/link_kernels.hpp"

namespace acinus::solve {
namespace {

/// Set of points, read in ascending order. Has memory for the points in it and for those next to
/// them.
class PointSet {
 public:
  explicit PointSet(std::size_t n) : word_(make_zeros<std::uint64_t>((n + kBits - 1) / kBits)) {}
  void add(Point p) {
    const std::size_t w = p / kBits;
    word_[w] |= std::uint64_t{1} << (p % kBits);
    first_ = std::min(first_, w);
    last_ = std::max(last_, w + 1);
  }
  void append_to(std::vector<Point>& points) const {
    for (std::size_t w = first_; w < last_; ++w)
      for (std::uint64_t left = word_[w]; left != 0; left &= left - 1)
        points.push_back(static_cast<Point>(w * kBits + std::countr_zero(left)));
  }

 private:
  static constexpr std::size_t kBits = 64;
  RowVector<std::uint64_t> word_;
  std::size_t first_ = static_cast<std::size_t>(-1), last_ = 0;  ///< words with points
};

/// Points sent to another process, and points received from it.
struct PeerPoints {
  PointSet send, receive;
};

std::span<const Point> points_of(const Side& side) {
  return std::span(side.point).first(side.is_single() ? 1 : 3);
}

/// Buffers of the calling thread, kept so that their memory is reused.
template <class T>
struct ExchangeBuffers {
  std::vector<std::array<T, 3>> out, in;
};
template <class T>
ExchangeBuffers<T>& buffers() {
  thread_local ExchangeBuffers<T> kept;
  return kept;
}

}  // namespace

void PointExchange::plan(const System& s) {
  ranks_ = s.ownership.ranks;
  plan_.peer.clear();
  send_.clear();
  receive_.clear();
  if (s.ownership.is_whole()) return;
  std::map<int, PeerPoints> peers;
  const auto join = [&](std::span<const Point> a, std::span<const Point> b) {
    const bool own_a = s.owns(a[0]);
    if (own_a == s.owns(b[0])) return;
    const auto& [own, other] = own_a ? std::pair(a, b) : std::pair(b, a);
    const int rank = s.ownership.owner[s.block_of(other[0])];
    auto at = peers.find(rank);
    if (at == peers.end()) {
      const std::size_t n = s.n_row * kLanes;
      at = peers.emplace(rank, PeerPoints{PointSet(n), PointSet(n)}).first;
    }
    PeerPoints& peer = at->second;
    for (const Point p : own) peer.send.add(p);
    for (const Point p : other) peer.receive.add(p);
  };
  for (const Link& l : s.links.link)
    if (l.b.exists()) join(points_of(l.a), points_of(l.b));
  for (const PointLink& l : s.point_links)
    if (l.b != kNowhere && has_matrix(l, s.stiffness_scale))
      join(std::span(&l.a, 1), std::span(&l.b, 1));
  for (const auto& [rank, points] : peers) {
    ExchangePlan::Peer peer{rank, send_.size(), 0, receive_.size(), 0};
    points.send.append_to(send_);
    points.receive.append_to(receive_);
    peer.send_end = send_.size();
    peer.receive_end = receive_.size();
    plan_.peer.push_back(peer);
  }
}

template <class T>
void PointExchange::fetch_packed(Packed<T>* x) const {
  if (plan_.empty()) return;
  auto& [out, in] = buffers<T>();
  out.clear();
  for (const Point p : send_) out.push_back({x[p][0], x[p][1], x[p][2]});
  in.resize(receive_.size());
  ranks_.exchange<std::array<T, 3>>(plan_, out, in);
  for (std::size_t k = 0; k < in.size(); ++k) x[receive_[k]] = {in[k][0], in[k][1], in[k][2], 0};
}

void PointExchange::fetch(std::span<double> x) const {
  if (plan_.empty()) return;
  auto& [out, in] = buffers<double>();
  out.clear();
  for (const Point p : send_) {
    const Vec3 v = load_point(x.data(), address_of(p));
    out.push_back({v.x(), v.y(), v.z()});
  }
  in.resize(receive_.size());
  ranks_.exchange<std::array<double, 3>>(plan_, out, in);
  for (std::size_t k = 0; k < in.size(); ++k)
    store_point(x.data(), address_of(receive_[k]), Vec3(in[k][0], in[k][1], in[k][2]));
}

template void PointExchange::fetch_packed<float>(Packed<float>*) const;
template void PointExchange::fetch_packed<double>(Packed<double>*) const;

}  // namespace acinus::solve
