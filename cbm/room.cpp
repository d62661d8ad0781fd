#include "cbm/room.hpp"

#include <algorithm>

#include "core/sphere.hpp"

namespace acinus::cbm {
namespace {

/// The plane between two balls, from the middle of the first one.
double radical_distance(double apart, double own, double other) {
  return geometry::share_to_power_plane(own, other, apart) * apart;
}

}  // namespace

double room_pressure(const RoomLaw& law, double relative_room) {
  const double x = law.full - relative_room;
  if (x >= law.onset) return law.bulk_modulus * x;
  const double into = std::max(0.0, x + law.onset);
  return law.bulk_modulus * into * into / (4 * law.onset);
}

double room_energy(const RoomLaw& law, double relative_room) {
  const double x = law.full - relative_room;
  const double into = std::clamp(x + law.onset, 0.0, 2 * law.onset);
  const double ramp = law.bulk_modulus * into * into * into / (12 * law.onset);
  if (x <= law.onset) return ramp;
  return ramp + 0.5 * law.bulk_modulus * (x * x - law.onset * law.onset);
}

std::vector<Room> find_rooms(const RoomInput& in, double reach) {
  const std::size_t n = in.center.size();
  std::vector<Room> rooms(n);
  std::vector<std::vector<geometry::BallCut>> planes(n);
  const auto cut = [&](std::size_t cell, int other, const geometry::BallCut& plane) {
    rooms[cell].face.push_back({other, {}});
    planes[cell].push_back(plane);
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      const Vec3 d = in.center[j] - in.center[i];
      const double own = reach * in.radius[i], other = reach * in.radius[j], apart = d.norm();
      if (!(apart > 0) || apart >= own + other) continue;
      const Vec3 normal = d / apart;
      cut(i, static_cast<int>(j), {normal, radical_distance(apart, own, other)});
      cut(j, static_cast<int>(i), {-normal, radical_distance(apart, other, own)});
    }
  for (std::size_t k = 0; k < in.walls.size(); ++k) {
    const RoomWall& w = in.walls[k];
    if (w.distance < reach * in.radius[w.cell])
      cut(w.cell, -1 - static_cast<int>(k), {w.normal, w.distance});
  }
  for (std::size_t i = 0; i < n; ++i) {
    const geometry::CutBall ball = geometry::cut_ball(reach * in.radius[i], planes[i]);
    rooms[i].volume = ball.volume;
    for (std::size_t k = 0; k < planes[i].size(); ++k) rooms[i].face[k].cut = ball.face[k];
  }
  return rooms;
}

double total_room_energy(const RoomInput& in, const RoomLaw& law, std::span<const Room> rooms) {
  double sum = 0;
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    const double reference = sphere_volume(in.radius[i]);
    sum += reference * room_energy(law, rooms[i].volume / reference);
  }
  return sum;
}

RoomForces find_room_forces(const RoomInput& in, const RoomLaw& law, std::span<const Room> rooms) {
  const std::size_t n = rooms.size();
  RoomForces out{std::vector<Vec3>(n, Vec3::Zero()), std::vector<double>(n),
                 std::vector<double>(n)};
  std::vector<double> pressure(n);
  for (std::size_t i = 0; i < n; ++i)
    pressure[i] = room_pressure(law, rooms[i].volume / sphere_volume(in.radius[i]));
  const auto bear = [&](std::size_t cell, const Vec3& force, const Vec3& normal, double arm) {
    out.force[cell] += force;
    out.normal_force[cell] -= force.dot(normal);
    out.pressure[cell] -= force.dot(normal) * arm / (3 * sphere_volume(in.radius[cell]));
  };
  for (std::size_t i = 0; i < n; ++i)
    for (const RoomFace& f : rooms[i].face) {
      if (!(f.cut.area > 0)) continue;
      if (f.other < 0) {
        const RoomWall& w = in.walls[-1 - f.other];
        bear(i, -pressure[i] * f.cut.area * w.normal, w.normal, w.distance);
        continue;
      }
      const std::size_t j = f.other;
      if (j < i) continue;  // both sides at once, from the lower one: action equals reaction
      const Vec3 d = in.center[j] - in.center[i];
      const double apart = d.norm();
      const Vec3 normal = d / apart;
      // A shift of i moves the plane by (x - x_i)/d at its points x, and the rest of the ball as a
      // whole, which is a flow of area times normal through the faces.
      const Vec3 force =
          f.cut.area * ((pressure[i] - pressure[j]) / apart * f.cut.middle - pressure[i] * normal);
      bear(i, force, normal, radical_distance(apart, in.radius[i], in.radius[j]));
      bear(j, -force, -normal, radical_distance(apart, in.radius[j], in.radius[i]));
    }
  return out;
}

}  // namespace acinus::cbm
