#include "coupling/vessels/beam.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::coupling {
namespace {

/// Beam in its present configuration.
struct Placed {
  double length;
  Vec3 chord;  ///< unit
  std::array<Vec3, 2> axis;
  Vec3 sum, difference;  ///< of the axis directions
};

Placed place(const BeamEnds& e) {
  const Vec3 apart = e.place[1] - e.place[0];
  Placed p;
  p.length = apart.norm();
  p.chord = apart / p.length;
  p.axis = {e.frame[0].col(0), e.frame[1].col(0)};
  p.sum = p.axis[0] + p.axis[1];
  p.difference = p.axis[0] - p.axis[1];
  return p;
}

Vec3 across(const Vec3& chord, const Vec3& v) { return v - chord.dot(v) * chord; }

double square(double x) { return x * x; }

}  // namespace

BeamLoad compute_load(const Beam& b, const BeamEnds& e) {
  const Placed p = place(e);
  BeamLoad load;
  const double longer = p.length - b.length;
  const double tension = b.stretch * longer - b.push;
  const Vec3 sum = across(p.chord, p.sum), difference = across(p.chord, p.difference);
  load.energy = 0.5 * b.stretch * square(longer) - b.push * longer +
                b.bend * (1.5 * sum.squaredNorm() + 0.5 * difference.squaredNorm());
  // |t x s|^2 = s^2 - (t s)^2, whose derivative for t is -2 (t s) s.
  const Vec3 for_chord =
      -b.bend * (3 * p.chord.dot(p.sum) * p.sum + p.chord.dot(p.difference) * p.difference);
  load.force = -tension * p.chord - across(p.chord, for_chord) / p.length;
  load.moment[0] = -p.axis[0].cross(b.bend * (3 * sum + difference));
  load.moment[1] = -p.axis[1].cross(b.bend * (3 * sum - difference));
  // sin of the twist, from the directions across
  const auto &f = e.frame[0], &g = e.frame[1];
  const double twist = 0.5 * (g.col(1).dot(f.col(2)) - g.col(2).dot(f.col(1)));
  const Vec3 turn = 0.5 * (g.col(1).cross(f.col(2)) - g.col(2).cross(f.col(1)));
  load.energy += 0.5 * b.twist * square(twist);
  load.moment[1] -= b.twist * twist * turn;
  load.moment[0] += b.twist * twist * turn;
  return load;
}

BeamStiffness compute_stiffness(const Beam& b, const BeamEnds& e) {
  const Placed p = place(e);
  BeamStiffness s;
  s.along = p.chord;
  s.axial = b.stretch;
  s.lateral = std::max(0.0, b.stretch * (p.length - b.length) - b.push) / p.length;
  const double root = std::sqrt(3 * b.bend);
  s.turn[0] = root * p.chord.unitOrthogonal();
  s.turn[1] = p.chord.cross(s.turn[0]);
  for (std::size_t k = 0; k < 2; ++k) s.place[k] = 2 / p.length * p.chord.cross(s.turn[k]);
  s.twist = b.twist;
  s.bend = b.bend;
  return s;
}

double Tube::area() const { return kPi * (square(radius) - square(inner())); }
double Tube::second_moment() const {
  return kPi / 4 * (square(square(radius)) - square(square(inner())));
}

Beam make_beam(const Tube& tube, double length, double young, double poisson, double pressure) {
  const double bend = young * tube.second_moment() / length;
  return {length, young * tube.area() / length, bend, bend / (1 + poisson),
          pressure * kPi * square(tube.inner()) * (1 - 2 * poisson)};
}

double radius_ratio(const Tube& tube, double young, double poisson, double pressure,
                    double strain) {
  const double hoop =
      2 * pressure * square(tube.inner()) / (square(tube.radius) - square(tube.inner()));
  return 1 + hoop / young * (1 - square(poisson)) - poisson * strain;
}

}  // namespace acinus::coupling
