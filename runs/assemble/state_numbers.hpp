#pragma once
/// Conversion of parts of a state to the flat arrays of a checkpoint, and back.

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/numbers/ramp.hpp"
#include "core/vec.hpp"
#include "io/checkpoint.hpp"

namespace acinus::runs {

inline void append_numbers(const Ramp& r, std::vector<double>& out) {
  out.insert(out.end(), {r.from, r.to, r.start, r.end});
}
inline void append_numbers(const Vec3& x, std::vector<double>& out) {
  out.insert(out.end(), {x.x(), x.y(), x.z()});
}

/// Numbers of ramps or points, one after the other.
template <class Values>
std::vector<double> flatten(const Values& values) {
  std::vector<double> v;
  for (const auto& x : values) append_numbers(x, v);
  return v;
}
inline std::vector<Ramp> unflatten(const std::vector<double>& v) {
  std::vector<Ramp> ramps;
  for (std::size_t k = 0; k + 3 < v.size(); k += 4)
    ramps.push_back({v[k], v[k + 1], v[k + 2], v[k + 3]});
  return ramps;
}

inline std::vector<Vec3> unflatten_points(const std::vector<double>& v) {
  std::vector<Vec3> points;
  for (std::size_t k = 0; k + 2 < v.size(); k += 3) points.emplace_back(v[k], v[k + 1], v[k + 2]);
  return points;
}

/// Calls f(name, value) for every floating-point member of the clock and the force balance.
template <class Clock, class Balance, class F>
void visit_numbers(Clock& c, Balance& b, F f) {
  f("clock/time", c.time);
  f("clock/origin", c.origin);
  f("clock/phase_start", c.phase_start);
  f("clock/step", c.step);
  f("clock/last_step", c.last_step);
  f("balance/momentum", b.momentum);
  f("balance/torque", b.torque);
  f("balance/friction_torque", b.friction_torque);
}

/// Calls f(name, value) for every integer member of the clock.
template <class Clock, class F>
void visit_counts(Clock& c, F f) {
  f("clock/accepted", c.accepted);
  f("clock/rejected", c.rejected);
  f("clock/cg_iterations", c.cg_iterations);
  f("clock/solves", c.solves);
}

/// Checks the number of entries of an array.
/// @throws Error(kFileError)
inline void check_same(const io::CheckpointData& data, const std::string& what, std::size_t found,
                       std::size_t expected) {
  check(found == expected,
        fmt::format("{}: {} has {} entries, {} are needed. The file is damaged or was written by "
                    "another version; resume from the previous checkpoint or start anew.",
                    data.source(), what, found, expected),
        Exit::kFileError);
}

}  // namespace acinus::runs
