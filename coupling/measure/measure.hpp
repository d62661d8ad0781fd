#pragma once
/// What a run reports of each cell and node, from the loads of one assembled moment.

#include <array>
#include <cstdint>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

struct CellMeasure {
  std::int64_t id = 0;
  std::int64_t parent = -1;  ///< lineage; -1: there from the start
  bool deformable = false;
  int type = 0;
  bool leader = false;
  Vec3 center = Vec3::Zero();   ///< um
  double radius = 0;            ///< um, reference radius (3 V0 / 4 pi)^(1/3)
  double volume = 0, area = 0;  ///< um^3, um^2; of a sphere: its intrinsic values
  /// kPa, p = tr(sum f (x) (x_contact - c)) / (-3 V0): positive when contacts press. Both models
  /// alike.
  double pressure = 0;
  double cytosol_pressure = 0;     ///< kPa, -K_V ln(V/V0); a sphere has none: its pressure again
  std::array<double, 6> stress{};  ///< kPa, xx xy xz yy yz zz of (1/V0) sum f (x) (x_contact - c)
  double contact_area = 0;         ///< um^2, of `area`, in touch with anything
  double strength = 1;             ///< of a new sphere, see cbm::CellData
  bool newborn = false;            ///< in the first ten minutes after a division
  /// nN, sum over partners of the size of the force with each. Partners are cells, walls, static
  /// meshes and segments of vessels.
  double contact_force = 0;
  /// nN, sum over partners of the force along the normal, positive where they press: with a cell
  /// along the line between the centres, with boundary along its own normal at each contact.
  double normal_force = 0;
  int contacts = 0;            ///< cells in contact
  double migration_force = 0;  ///< nN, active force on the cell
};

}  // namespace acinus::coupling

namespace acinus {
template <>
inline constexpr bool kIsPlain<coupling::CellMeasure> = true;
}  // namespace acinus

namespace acinus::coupling {

/// Makes the loads of the present moment (no step is taken, State is not touched).
void observe(const World& world, Workspace& work);

/// One entry per cell, deformable ones first, in storage order. Of all processes, to be called by
/// all of them, like all measures that follow.   @pre observe
std::vector<CellMeasure> measure_cells(const World& world, const Workspace& work);

/// Fields on the nodes of the deformable cells, body by body.   @pre observe
struct NodeMeasure {
  std::vector<Vec3> force;       ///< nN, contact force
  std::vector<double> pressure;  ///< kPa, normal contact traction, positive pressing inward
  std::vector<double>
      tension;  ///< nN/um, cortex tension [VanLiedekerke2020, Eq. (8)] plus membrane
};
NodeMeasure measure_nodes(const World& world, const Workspace& work);

}  // namespace acinus::coupling
