#pragma once
/// Spheres that press because their room is full, not because two of them overlap: a candidate for
/// the law of dense tissue, measured by `acinus bench out-of-sample`; no run uses it yet.
/// (docs/decisions/0036.md)

#include <span>
#include <vector>

#include "core/vec.hpp"
#include "geometry/cut_ball.hpp"

namespace acinus::cbm {

/// The room of a cell is a ball, somewhat wider than its sphere, cut where it meets the room of
/// another cell (power diagram of the balls) and at walls: a deformable cell fills the corners
/// between its neighbours and the angle at a wall, but does not reach far out where nothing is.
/// With q = V/V0, the room over the reference volume, and x = full - q the cell presses with
///   p = K (x + onset)^2 / (4 onset)   for |x| < onset,   0 below,   K x above,
/// the derivative of an energy, so that forces are its exact gradient.
struct RoomLaw {
  double bulk_modulus = 2.5;  ///< kPa, K
  double reach = 1.1;         ///< radius of the ball over that of the sphere
  double full = 0.98;         ///< q at which the cell is full
  double onset = 0.04;        ///< half the width over which it comes to press as its bulk does
};

/// kPa.
double room_pressure(const RoomLaw& law, double relative_room);

/// Energy over the reference volume, kPa; its derivative by q is -p.
double room_energy(const RoomLaw& law, double relative_room);

/// A rigid wall near a cell, taken for the plane that touches it where it is nearest.
struct RoomWall {
  int cell = 0;
  Vec3 normal = Vec3::UnitZ();  ///< unit, out of the room
  double distance = 0;          ///< um, from the centre
};

/// One face of a room.
struct RoomFace {
  int other = -1;  ///< the cell behind it; -1 - k: walls[k]
  geometry::CutFace cut;
};

struct Room {
  double volume = 0;  ///< um^3
  std::vector<RoomFace> face;
};

struct RoomInput {
  std::span<const Vec3> center;    ///< [n_cell] um
  std::span<const double> radius;  ///< [n_cell] um
  std::span<const RoomWall> walls;
};

/// [n_cell]
std::vector<Room> find_rooms(const RoomInput& in, double reach);

/// fJ, of all cells. @param rooms  of find_rooms
double total_room_energy(const RoomInput& in, const RoomLaw& law, std::span<const Room> rooms);

/// What rooms do to their cells.
struct RoomForces {
  std::vector<Vec3> force;           ///< [n_cell] nN, minus the gradient of the energy
  std::vector<double> normal_force;  ///< [n_cell] nN, sum over faces along their normals
  std::vector<double> pressure;      ///< [n_cell] kPa, as coupling::CellMeasure::pressure
};

/// @pre walls are planes where `force` is to be the gradient: that a touching plane turns with the
/// cell along a curved wall is left out
RoomForces find_room_forces(const RoomInput& in, const RoomLaw& law, std::span<const Room> rooms);

}  // namespace acinus::cbm
