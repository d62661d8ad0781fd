#pragma once
/// Rules by which the behaviour of cells responds to signals: constants and state.

#include <cstdint>
#include <vector>

#include "core/vec.hpp"

namespace acinus::coupling {

/// Behaviour of a cell that responds to a signal.
enum class Behaviour : std::uint8_t {
  kGrowth,
  kDeath,
  kMotility,
  kChemotaxis,
  kSecretion,
  kUptake,
  kAdhesion
};

/// Quantity that cells respond to. All but concentration and age are measured on the time grid of
/// life and hold until its next point (measure/signals.hpp).
enum class Signal : std::uint8_t {
  kConcentration,  ///< of a substance
  kPressure,       ///< kPa, CellMeasure::pressure
  kVolume,         ///< um^3, CellMeasure::volume
  kContactArea,    ///< um^2 of its surface in contact with other living cells
  kNeighbours,     ///< number of other living cells in contact
  kLayer,          ///< layer behind the edge of a lesion around the vein axis, from 1
  kAge             ///< s since birth; of initial cells since t = 0
};

inline bool is_measured(Signal signal) {
  return signal != Signal::kConcentration && signal != Signal::kAge;
}

/// Response of cells to a signal s: a Hill function, s^power / (half_max^power + s^power), or 1
/// minus it. Negative signals count as 0.
struct SignalRule {
  Signal signal = Signal::kConcentration;
  int substance = 0;  ///< kConcentration: its index
  int partner = -1;   ///< kContactArea, kNeighbours: cell type of the others; -1: all
  Behaviour behaviour = Behaviour::kGrowth;
  bool decreases = false;  ///< the response falls with the signal
  int type = -1;           ///< cell type; -1: all
  int lysing_type = -1;    ///< type of its cells in lysis; -1: the same
  double half_max = 1;     ///< in the unit of the signal
  double power = 4;
  /// kSecretion, kUptake: index of the substance that is exchanged; kChemotaxis: of the one whose
  /// gradient leads.
  int of = -1;
  double rate = 0;   ///< 1/s, kDeath: rate at full response
  double force = 0;  ///< nN, kChemotaxis: force up the gradient at full response; < 0: down
  double sensitivity =
      0.01;  ///< kChemotaxis: relative difference across the cell of half the force
};

/// Rules of a scene, and the vein axis that layers are counted around.
struct RuleParams {
  std::vector<SignalRule> rule;
  Vec3 axis_point = Vec3::Zero();  ///< um
};

/// Measured signals, held between two points of the time grid of life.
struct SignalState {
  /// [rule][dcm lanes, then cbm cells] in the unit of the signal; empty for a rule whose signal is
  /// not measured. Empty: not measured yet.
  std::vector<std::vector<double>> value;
  std::int64_t interval = -1;  ///< grid interval of the measurement
};

/// Motion of a cell that signals change.
struct Guidance {
  double motility = 1;          ///< factor on the diffusion coefficient of random motion
  Vec3 force = Vec3::Zero();    ///< nN, chemotaxis
  Vec3 heading = Vec3::Zero();  ///< of leaders; shorter than 1 where the gradient is weak
};

}  // namespace acinus::coupling
