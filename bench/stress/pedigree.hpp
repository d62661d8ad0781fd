#pragma once
/// Pedigree of the cells of a run, from its start and its events. Births, deaths and sizes are
/// checked against the life parameters, independent of the program's state.

#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "bench/stress/finding.hpp"
#include "coupling/world/world.hpp"
#include "io/frame.hpp"

namespace acinus::bench {

/// Cell of the pedigree, alive or ended. Times in s since t = 0, never negative.
struct Relative {
  std::int64_t parent = -1, founder = -1;
  std::size_t type = 0;  ///< index into the params
  double birth = 0;
  double first_volume = 0;  ///< reference volume at birth or t = 0, um^3
  double unit = 0;          ///< birth volume of its type, um^3
  double end = std::numeric_limits<double>::infinity();        ///< division or death
  double dissolves = std::numeric_limits<double>::infinity();  ///< start of lysis
  bool waits = false;                                          ///< a division was postponed
  bool early = false;       ///< removed during lysis, by its event
  bool deformable = false;  ///< model, by its events
};

/// Closed interval.
struct Interval {
  double low = 0, high = 0;
};

/// Family tree of all cells of a run, built from its events.
class Pedigree {
 public:
  /// Pedigree of the founder cells.
  /// @param start  of build_world(scene)
  explicit Pedigree(const coupling::World& start);

  /// Enters an event.
  /// @return unborn or untimely: missing partners, division before the shortest cycle is over,
  /// death outside the time of its rule
  std::vector<Finding> add(const io::Event& event);
  /// Cells that should have divided or died before a time (s).
  std::vector<Finding> find_overdue(double time) const;
  /// Compares with the cell table of a frame: unborn, vanished, untimely (change of model without
  /// an event), volume (reference volume outside rest_volume()).
  std::vector<Finding> compare(const io::Frame& frame) const;

  /// All cells so far, by lineage.
  const std::map<std::int64_t, Relative>& all() const { return all_; }
  bool is_there(std::int64_t id) const;
  /// Range of the reference volume of a cell, um^3: it doubles within the cycle and shrinks in
  /// lysis.
  Interval rest_volume(const Relative& cell, double time) const;

 private:
  const coupling::CycleParams& life_of(const Relative& cell) const {
    return params_.life.type[cell.type];
  }
  double shortest_cycle(const Relative& cell) const;
  bool may_die(std::int64_t id, const Relative& cell, double time) const;
  std::string add_daughters(const io::Event& event);
  std::string end_life(const io::Event& event);
  std::string change_model(const io::Event& event);

  const coupling::Params& params_;
  std::map<std::int64_t, Relative> all_;
};

/// Reference volume of every cell of a frame, um^3, by lineage.
std::map<std::int64_t, double> rest_volumes(const io::Frame& frame);

}  // namespace acinus::bench
