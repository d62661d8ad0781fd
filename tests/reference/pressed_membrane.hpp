#pragma once
/// Exact force that compresses a closed elastic membrane between two plates without friction:
/// the continuum limit of a deformable cell without bending, solved on its meridian.

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "core/vec.hpp"

namespace acinus::reference {

/// Sphere that is at rest at the radius.
struct PressedMembrane {
  double radius = 12;         ///< um
  double spring = 0;          ///< nN/um, k_s of a triangular net
  double area_modulus = 0;    ///< nN/um, K_A
  double bulk_modulus = 2.5;  ///< kPa, K_V
};

struct Pressed {
  double gap = 0, force = 0;                ///< um, nN
  double contact_radius = 0, pressure = 0;  ///< um, kPa
  double residual = 0;                      ///< of the equations, relative
};

namespace pressed {

/// Principal tensions of the net, nN/um of deformed length, and how the first grows with either
/// stretch. Energy per area at rest: sqrt(3) k <(s - 1)^2>, mean over the directions of springs, of
/// which s^2 = (a cos)^2 + (b sin)^2 is the stretch.
struct Tension {
  double along = 0, across = 0, along_by_a = 0, along_by_b = 0;
};
inline Tension tension(double k, double a, double b) {
  constexpr int kDirections = 24;  // even functions of the angle with period pi: spectral accuracy
  double wa = 0, wb = 0, waa = 0, wab = 0;
  for (int n = 0; n < kDirections; ++n) {
    const double angle = kPi * (n + 0.5) / kDirections;
    const double c = std::pow(std::cos(angle), 2), s = 1 - c;
    const double stretch = std::sqrt(a * a * c + b * b * s), strain = stretch - 1;
    wa += 2 * strain * a * c / stretch;
    wb += 2 * strain * b * s / stretch;
    waa += 2 * (strain * c / stretch + a * c * a * c / std::pow(stretch, 3));
    wab += 2 * a * c * b * s / std::pow(stretch, 3);
  }
  const double f = std::sqrt(3.0) * k / kDirections;
  return {f * wa / b, f * wb / a, f * waa / b, f * (wab - wa / b) / b};
}

/// Along the meridian of the sphere at rest, by the angle t from the pole: distance from the axis,
/// stretch along, slope, depth below the plate, and the sums for area and volume.
using Point = Eigen::Matrix<double, 6, 1>;

/// Unknowns of the shooting: stretch at the pole, pressure, tension of the whole surface.
using Unknowns = Eigen::Vector3d;

inline Point slope_of(const PressedMembrane& m, const Unknowns& u, bool free, double t,
                      const Point& y) {
  const double r = y[0], a = y[1], angle = free ? y[2] : 0.0;
  const double at_rest = m.radius * std::sin(t), b = r / at_rest;
  const Tension q = tension(m.spring, a, b);
  const double ds = m.radius * a, dr = ds * std::cos(angle);
  const double db = dr / at_rest - b * std::cos(t) / std::sin(t);
  // d(r T1) = T2 dr along the membrane, which slides.
  const double da = ((q.across - q.along) * dr / r - q.along_by_b * db) / q.along_by_a;
  const double bend =
      free ? (u[1] - (q.across + u[2]) * std::sin(angle) / r) / (q.along + u[2]) : 0;
  Point out;
  out << dr, da, ds * bend, ds * std::sin(angle), 2 * kPi * r * ds,
      kPi * r * r * ds * std::sin(angle);
  return out;
}

inline void march(const PressedMembrane& m, const Unknowns& u, bool free, double from, double to,
                  Point& y) {
  constexpr int kSteps = 400;
  const double h = (to - from) / kSteps;
  for (int n = 0; n < kSteps; ++n) {
    const double t = from + n * h;
    const Point k1 = slope_of(m, u, free, t, y);
    const Point k2 = slope_of(m, u, free, t + h / 2, y + h / 2 * k1);
    const Point k3 = slope_of(m, u, free, t + h / 2, y + h / 2 * k2);
    const Point k4 = slope_of(m, u, free, t + h, y + h * k3);
    y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
}

}  // namespace pressed

/// Membrane when all that was within the angle `contact` of the pole lies on the plate.
/// Newton on: the equator stands upright; pressure and tension follow from volume and area.
inline Pressed press_membrane(const PressedMembrane& m, double contact, Eigen::Vector3d& guess) {
  using namespace pressed;
  const double area_at_rest = 4 * kPi * m.radius * m.radius;
  const double volume_at_rest = area_at_rest * m.radius / 3;
  Pressed out;
  const auto miss = [&](const Unknowns& u) {
    constexpr double kPole = 1e-4;
    Point y;
    y << m.radius * u[0] * std::sin(kPole), u[0], 0, 0, 0, 0;
    march(m, u, false, kPole, contact, y);
    const double rim = y[0];
    march(m, u, true, contact, kPi / 2, y);
    out.gap = 2 * y[3];
    out.contact_radius = rim;
    out.pressure = u[1];
    out.force = u[1] * kPi * rim * rim;
    const double area = 2 * y[4], volume = 2 * y[5];
    // In units in which each is of the order of a strain.
    return Eigen::Vector3d(
        y[2] - kPi / 2, volume / volume_at_rest * std::exp(u[1] / m.bulk_modulus) - 1,
        area / area_at_rest - 1 -
            (m.area_modulus > 0 ? u[2] / m.area_modulus : u[2] + area / area_at_rest - 1));
  };
  for (int round = 0; round < 12; ++round) {
    const Eigen::Vector3d f = miss(guess);
    out.residual = f.norm();
    if (out.residual < 1e-11) break;
    Eigen::Matrix3d slope;
    for (int k = 0; k < 3; ++k) {
      constexpr double kStep = 1e-7;
      Eigen::Vector3d more = guess, less = guess;
      more[k] += kStep;
      less[k] -= kStep;
      slope.col(k) = (miss(more) - miss(less)) / (2 * kStep);
    }
    Eigen::Vector3d step = -slope.fullPivLu().solve(f);
    // Not so far that the membrane goes slack.
    double scale = 1;
    while (scale > 1e-6 && !(miss(guess + scale * step).norm() < f.norm())) scale /= 2;
    guess += scale * step;
  }
  miss(guess);
  return out;
}

}  // namespace acinus::reference
