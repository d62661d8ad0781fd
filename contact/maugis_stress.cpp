#include "contact/maugis_stress.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace acinus::contact {

namespace {

constexpr double square(double x) { return x * x; }

/// Radius at which Hertz' pressure and the adhesive one cancel. In w = sqrt(a^2 - r^2), hertz w =
/// (2 sigma0/pi) atan2(edge, w); the difference is concave, so Newton's method rises to the root.
double find_reversal(const MaugisStress& s) {
  if (s.cohesive == 0.0) return s.a;
  const double factor = 2.0 * s.cohesive / kPi;
  const auto difference = [&](double w) { return s.hertz * w - factor * std::atan2(s.edge, w); };
  if (s.a == 0.0 || difference(s.a) <= 0.0) return 0.0;
  double w = 0.0;
  for (int k = 0; k < 50; ++k) {
    const double up = -difference(w) / (s.hertz + factor * s.edge / (square(s.edge) + square(w)));
    w += up;
    if (!(up > 1e-15 * w)) break;
  }
  return std::sqrt(std::max(0.0, (s.a - w) * (s.a + w)));
}

/// G within a, as a function of r^2 and w = sqrt(a^2 - r^2).
double enclosed_within(const MaugisStress& s, double r2, double w) {
  const double hertz = s.hertz / 3.0 * (square(s.a) * s.a - square(w) * w);
  if (s.cohesive == 0.0) return hertz;
  return hertz - s.cohesive / kPi *
                     (s.sector - (square(s.c) - r2) * std::atan2(s.edge, w) + s.edge * (s.a - w));
}

/// Node and weight of Gauss' rule on [-1, 1]; each stands for itself and its mirror image.
struct GaussPoint {
  double place, weight;
};
constexpr std::array<GaussPoint, 3> kSixPoints = {{{0.2386191860831969, 0.4679139345726910},
                                                   {0.6612093864662645, 0.3607615730481386},
                                                   {0.9324695142031521, 0.1713244923791704}}};
constexpr std::array<GaussPoint, 2> kFourPoints = {
    {{0.3399810435848563, 0.6521451548625461}, {0.8611363115940526, 0.3478548451374538}}};
constexpr std::array<GaussPoint, 1> kTwoPoints = {{{0.5773502691896257, 1.0}}};

/// Rule for an interval of a smooth function, relative to the scale on which it varies: errors of
/// 1e-7 at most.
std::span<const GaussPoint> rule_for(double extent) {
  if (extent < 0.6) return kFourPoints;
  return kSixPoints;
}

/// Calls visit(x, weight) for the quadrature points of an interval.
template <class Visit>
void for_each_gauss_point(std::span<const GaussPoint> rule, double low, double high, Visit visit) {
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  for (const auto& [place, weight] : rule)
    for (const double sign : {-1.0, 1.0}) visit(middle + sign * half * place, half * weight);
}

/// Values of both states that do not depend on the polygon.
struct Levels {
  double push, push2;  ///< G at the reversal, of the first and the second state
  double pull, pull2;  ///< G at c less G at the reversal
};

/// Integrals along a piece of an edge within a.
struct InnerIntegral {
  const MaugisStress &first, &second;
  double h2;                            ///< um^2, squared distance of the edge
  double base = 0, base2 = 0, end = 0;  ///< nN/rad, levels of G
  double force = 0, moment = 0, growth = 0;

  /// @param place  x -> (t, dt/dx)
  template <class Place>
  void add(double from, double to, double extent, Place place) {
    const double a2 = square(first.a);
    const auto value_at = [&](double r2) {
      return enclosed_within(first, r2, std::sqrt(std::max(0.0, a2 - r2))) - base;
    };
    for_each_gauss_point(rule_for(extent), from, to, [&](double x, double weight) {
      const auto [t, slope] = place(x);
      const double r2 = h2 + square(t), dt = weight * slope, value = value_at(r2);
      force += dt / r2 * value;
      moment += dt * (value - end);
    });
    for_each_gauss_point(kTwoPoints, from, to, [&](double x, double weight) {
      const auto [t, slope] = place(x);
      const double r2 = h2 + square(t);
      const double more = enclosed_stress(second, std::sqrt(r2)) - base2 - value_at(r2);
      growth += weight * slope / r2 * more;
    });
  }
};

/// Integrals along one edge of a polygon.
class EdgeIntegral {
 public:
  EdgeIntegral(const MaugisStress& first, const MaugisStress& second, const Levels& level,
               StressParts& out)
      : s_(first), second_(second), level_(level), out_(out) {}

  void add(const Vec2& x, const Vec2& y) {
    const Vec2 along = y - x;
    const double length = along.norm();
    if (length == 0.0) return;
    const Vec2 direction = along / length;
    normal_ = Vec2(direction.y(), -direction.x());
    h_ = normal_.dot(x);
    // Places along the edge from the foot of the perpendicular, cut where r = reversal, a, c.
    std::array<double, 8> cut{};
    std::size_t n = 0;
    const double low = direction.dot(x), high = low + length;
    cut[n++] = low;
    const double radii[] = {s_.c, s_.a, s_.reversal};
    for (const double radius : radii) add_cut(-reach(radius), low, high, n, cut);
    for (int k = 2; k >= 0; --k) add_cut(reach(radii[k]), low, high, n, cut);
    cut[n++] = high;
    for (std::size_t k = 0; k + 1 < n; ++k)
      if (cut[k + 1] > cut[k]) add_piece(cut[k], cut[k + 1]);
  }

 private:
  /// Half length of the line of the edge within a radius.
  double reach(double radius) const {
    return std::sqrt(std::max(0.0, (radius - std::abs(h_)) * (radius + std::abs(h_))));
  }
  static void add_cut(double t, double low, double high, std::size_t& n,
                      std::array<double, 8>& cut) {
    if (t > low && t < high && t > cut[n - 1]) cut[n++] = t;
  }

  void add_piece(double t1, double t2) {
    const double r2 = square(h_) + square(0.5 * (t1 + t2));
    if (r2 >= square(s_.c))
      add_outside(t1, t2);
    else if (r2 >= square(s_.a))
      add_ring(t1, t2);
    else
      add_within(t1, t2, r2 < square(s_.reversal));
  }

  double angle(double t1, double t2) const {
    return std::atan2(h_ * (t2 - t1), square(h_) + t1 * t2);
  }
  /// Everything of the repulsive part, seen from outside the reversal.
  void add_push(double turn) {
    out_.push.force += level_.push * turn;
    out_.push.area += 0.5 * square(s_.reversal) * turn;
    out_.push.growth += (level_.push2 - level_.push) * turn;
  }

  void add_outside(double t1, double t2) {
    const double turn = angle(t1, t2);
    add_push(turn);
    out_.pull.force += level_.pull * turn;
    out_.pull.area += 0.5 * (square(s_.c) - square(s_.reversal)) * turn;
    out_.pull.growth += (level_.pull2 - level_.pull) * turn;
  }

  /// Between a and c the stress is -sigma0.
  void add_ring(double t1, double t2) {
    const bool centered = s_.a == 0.0;  // no turn about the centre is needed then
    const double turn = centered ? 0.0 : angle(t1, t2), length = t2 - t1;
    add_push(turn);
    const double at_a = centered ? 0.0 : enclosed_within(s_, square(s_.a), 0.0);
    const double level = at_a + 0.5 * s_.cohesive * square(s_.a) - level_.push;
    const double half = 0.5 * s_.cohesive;
    out_.pull.force += level * turn - half * h_ * length;
    out_.pull.area += 0.5 * (h_ * length - square(s_.reversal) * turn);
    const double cubes = (square(t1) + t1 * t2 + square(t2)) / 3.0;
    out_.pull.moment += length * (level - half * (square(h_) + cubes) - level_.pull) * normal_;
    double second = 0.0;
    for_each_gauss_point(kTwoPoints, t1, t2, [&](double t, double weight) {
      const double r2 = square(h_) + square(t);
      second += weight * h_ / r2 * (enclosed_stress(second_, std::sqrt(r2)) - level_.push2);
    });
    out_.pull.growth += second - (level * turn - half * h_ * length);
  }

  /// Within a.
  void add_within(double t1, double t2, bool pushes) {
    const double whole = reach(s_.a);
    InnerIntegral sum{s_, second_, square(h_)};
    sum.base = pushes ? 0.0 : level_.push;
    sum.base2 = pushes ? 0.0 : level_.push2;
    sum.end = pushes ? level_.push : level_.pull;
    // Near the rim the root in w is not smooth in t, but in the angle whose sine is t / reach.
    if (std::max(std::abs(t1), std::abs(t2)) < 0.6 * whole)
      sum.add(t1, t2, (t2 - t1) / whole, [](double t) { return std::pair(t, 1.0); });
    else {
      const double from = std::asin(std::clamp(t1 / whole, -1.0, 1.0)),
                   to = std::asin(std::clamp(t2 / whole, -1.0, 1.0));
      sum.add(from, to, to - from,
              [&](double x) { return std::pair(whole * std::sin(x), whole * std::cos(x)); });
    }
    StressPart& part = pushes ? out_.push : out_.pull;
    part.force += h_ * sum.force;
    part.moment += sum.moment * normal_;
    part.growth += h_ * sum.growth;
    const double across = 0.5 * h_ * (t2 - t1);
    if (pushes) {
      part.area += across;
      out_.pull.moment -= level_.pull * (t2 - t1) * normal_;
    } else {
      const double turn = s_.reversal == 0.0 ? 0.0 : angle(t1, t2);
      add_push(turn);
      part.area += across - 0.5 * square(s_.reversal) * turn;
    }
  }

  const MaugisStress &s_, &second_;
  const Levels& level_;
  StressParts& out_;
  Vec2 normal_ = Vec2::Zero();
  double h_ = 0;  ///< um, of the edge from the contact point along the outward normal
};

}  // namespace

MaugisStress make_maugis_stress(const MaugisPair& pair, const MaugisPoint& state) {
  MaugisStress s;
  s.hertz = 2.0 * pair.pair.modulus / (kPi * pair.pair.radius);
  s.cohesive = pair.pair.adhesion > 0.0 ? pair.cohesive_stress : 0.0;
  s.a = state.contact_radius;
  s.c = std::max(state.cohesive_radius, state.contact_radius);
  s.edge = std::sqrt((s.c - s.a) * (s.c + s.a));
  s.sector = square(s.c) * std::atan2(s.edge, s.a);
  s.reversal = find_reversal(s);
  return s;
}

double stress_at(const MaugisStress& s, double r) {
  if (r >= s.c) return 0.0;
  if (r >= s.a) return -s.cohesive;
  const double w = std::sqrt((s.a - r) * (s.a + r));
  return s.hertz * w - 2.0 * s.cohesive / kPi * std::atan2(s.edge, w);
}

double enclosed_stress(const MaugisStress& s, double r) {
  const double within = std::min(r, s.a);
  const double w = std::sqrt((s.a - within) * (s.a + within));
  const double inner = s.a > 0.0 ? enclosed_within(s, square(within), w) : 0.0;
  return inner - 0.5 * s.cohesive * (square(std::clamp(r, s.a, s.c)) - square(s.a));
}

StressParts integrate_stress(const MaugisStress& first, const MaugisStress& second,
                             std::span<const Vec2> polygon) {
  StressParts out;
  const double push = enclosed_stress(first, first.reversal),
               push2 = enclosed_stress(second, first.reversal);
  const Levels level{push, push2, enclosed_stress(first, first.c) - push,
                     enclosed_stress(second, first.c) - push2};
  EdgeIntegral edge(first, second, level, out);
  for (std::size_t k = 0; k < polygon.size(); ++k)
    edge.add(polygon[k], polygon[(k + 1) % polygon.size()]);
  return out;
}

}  // namespace acinus::contact
