/// The law of the room: hand values, forces against differences of the energy, balance, invariance.

#include "cbm/room.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/sphere.hpp"

namespace acinus::cbm {
namespace {

struct Crowd {
  std::vector<Vec3> center;
  std::vector<double> radius;
  std::vector<RoomWall> walls;
  RoomInput input() const { return {center, radius, walls}; }
};

/// Cells of several sizes about the corners of a cube and in its middle, all full.
Crowd crowd() {
  Crowd c;
  c.center.emplace_back(0.3, -0.2, 0.1);
  for (int k = 0; k < 8; ++k)
    c.center.emplace_back((k & 1 ? 10 : -11) + 0.3 * k, (k & 2 ? 11 : -10) - 0.2 * k,
                          (k & 4 ? 10 : -10) + 0.1 * k);
  for (std::size_t k = 0; k < c.center.size(); ++k)
    c.radius.push_back(11.5 + 0.15 * static_cast<double>(k));
  return c;
}

/// A plane at z = low under all cells.
void add_floor(double low, Crowd& c) {
  c.walls.clear();
  for (std::size_t k = 0; k < c.center.size(); ++k)
    c.walls.push_back({static_cast<int>(k), -Vec3::UnitZ(), c.center[k].z() - low});
}

double energy(Crowd c, bool floor) {
  if (floor) add_floor(-17, c);
  return total_room_energy(c.input(), {}, find_rooms(c.input(), RoomLaw{}.reach));
}

RoomForces forces(const Crowd& c) {
  return find_room_forces(c.input(), {}, find_rooms(c.input(), RoomLaw{}.reach));
}

TEST(Room, PressesByHowFullItIs) {
  const RoomLaw law{.bulk_modulus = 2, .reach = 1.1, .full = 1, .onset = 0.1};
  EXPECT_EQ(room_pressure(law, 1.2), 0);
  EXPECT_NEAR(room_pressure(law, 1.0), 0.05, 1e-15);  // 2 x 0.1^2 / 0.4
  EXPECT_NEAR(room_pressure(law, 0.9), 0.2, 1e-15);
  EXPECT_NEAR(room_pressure(law, 0.7), 0.6, 1e-15);
  EXPECT_NEAR(room_energy(law, 1.0), 2 * 0.001 / 1.2, 1e-15);
  constexpr double kStep = 1e-6;
  for (const double q : {1.05, 0.95, 0.8})  // a parabola's or a cubic's: the error is K step^2
    EXPECT_NEAR(room_pressure(law, q),
                (room_energy(law, q - kStep) - room_energy(law, q + kStep)) / (2 * kStep), 1e-9);
}

TEST(Room, IsTheCellOfALattice) {
  Crowd c;  // the middle one has a cube of 20 um, whose corners the ball does not reach
  for (int k = 0; k < 27; ++k) {
    c.center.emplace_back(20.0 * (k % 3 - 1), 20.0 * (k / 3 % 3 - 1), 20.0 * (k / 9 - 1));
    c.radius.push_back(12);
  }
  EXPECT_NEAR(find_rooms(c.input(), 1.5)[13].volume, 8000, 1e-9);
  const double h = 1 - 10 / 13.2, cap = kPi / 3 * h * h * (3 - h) * std::pow(13.2, 3);
  EXPECT_NEAR(find_rooms(c.input(), 1.1)[13].volume, sphere_volume(13.2) - 6 * cap, 1e-9);
}

TEST(Room, ForceOfTwoCells) {
  const Crowd c{{Vec3(0, 0, 0), Vec3(14, 0, 0)}, {12, 12}, {}};
  const std::vector<Room> rooms = find_rooms(c.input(), 1.1);
  const double area = kPi * (13.2 * 13.2 - 49),
               cap = kPi / 3 * (13.2 - 7) * (13.2 - 7) * (2 * 13.2 + 7);
  EXPECT_NEAR(rooms[0].volume, sphere_volume(13.2) - cap, 1e-9);
  RoomLaw law;
  law.full = 1.2;  // so that they are full
  const RoomForces f = find_room_forces(c.input(), law, rooms);
  const double pressure = room_pressure(law, rooms[0].volume / sphere_volume(12));
  ASSERT_GT(pressure, 0);
  EXPECT_NEAR((f.force[0] - Vec3(-pressure * area, 0, 0)).norm(), 0, 1e-11 * pressure * area);
  EXPECT_NEAR(f.normal_force[0], pressure * area, 1e-11 * pressure * area);
  EXPECT_NEAR(f.pressure[1], pressure * area * 7 / (3 * sphere_volume(12)), 1e-11 * pressure);
}

TEST(Room, ForcesAreMinusTheGradient) {
  for (const bool floor : {false, true}) {
    Crowd c = crowd();
    if (floor) add_floor(-17, c);
    const RoomForces f = forces(c);
    constexpr double kStep = 1e-4;
    for (std::size_t i = 0; i < c.center.size(); ++i)
      for (int m = 0; m < 3; ++m) {
        Crowd more = c, less = c;
        more.center[i][m] += kStep;
        less.center[i][m] -= kStep;
        const double slope = (energy(more, floor) - energy(less, floor)) / (2 * kStep);
        // Forces are of order 100 nN over lengths of 10 um: 100 (1e-4/10)^2 = 1e-8; the energy of
        // 1e4 fJ is known to 1e-12 of itself, over the step 1e-4.
        EXPECT_NEAR(f.force[i][m], -slope, 1e-6) << floor << " " << i << " " << m;
      }
  }
}

TEST(Room, ForcesAndTorquesSumToNothing) {
  const Crowd c = crowd();
  const RoomForces f = forces(c);
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  double size = 0;
  for (std::size_t i = 0; i < c.center.size(); ++i) {
    force += f.force[i];
    torque += c.center[i].cross(f.force[i]);
    size += f.force[i].norm();
  }
  ASSERT_GT(size, 1);
  EXPECT_LT(force.norm(), 1e-13 * size);
  EXPECT_LT(torque.norm(), 1e-11 * 20 * size) << "arms of 20 um, faces known to 1e-12";
}

TEST(Room, TurnsWithItsCells) {
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(2, 1, -1).normalized()).toRotationMatrix();
  Crowd turned = crowd();
  for (Vec3& x : turned.center) x = turn * x + Vec3(100, -50, 20);
  const RoomForces a = forces(crowd()), b = forces(turned);
  for (std::size_t i = 0; i < turned.center.size(); ++i) {
    EXPECT_LT((turn * a.force[i] - b.force[i]).norm(), 1e-9)
        << "forces of 100 nN, places of 100 um";
    EXPECT_NEAR(a.pressure[i], b.pressure[i], 1e-12);
  }
}

}  // namespace
}  // namespace acinus::cbm
