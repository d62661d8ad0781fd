#pragma once
/// Which cells may be there: those of a start and what events say became of them. Births, deaths
/// and sizes are checked against what the parameters of life allow, not against the program's own
/// state.

#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "bench/stress/finding.hpp"
#include "coupling/world/world.hpp"
#include "io/frame.hpp"

namespace acinus::bench {

/// One cell, be it still there or not. Times s since t = 0, never < 0.
struct Relative {
  std::int64_t parent = -1, founder = -1;
  std::size_t type = 0;  ///< index into the params
  double birth = 0;
  double first_volume = 0;  ///< um^3, reference volume when it was born, or at t = 0
  double unit = 0;          ///< um^3, the reference volume with which its kind is born
  double end = std::numeric_limits<double>::infinity();        ///< it divided or died
  double dissolves = std::numeric_limits<double>::infinity();  ///< lysis began
  bool waits = false;                                          ///< a division of it failed
  bool early = false;       ///< taken away while dissolving, as the run says
  bool deformable = false;  ///< its model, as events say
};

struct Interval {
  double low = 0, high = 0;
};

class Pedigree {
 public:
  /// @param start  what build_world makes of a scene
  explicit Pedigree(const coupling::World& start);

  /// Takes note of an event. @return unborn, untimely: partners that are not there, a division
  /// before the shortest cycle is over, a death outside its rule's time
  std::vector<Finding> add(const io::Event& event);
  /// Cells that must have divided or died by then, had the rules been kept.
  std::vector<Finding> find_overdue(double time) const;
  /// Compares with the table of cells of a frame: unborn, vanished, untimely where a cell has
  /// changed its model without an event, and volume where a reference volume is outside
  /// rest_volume().
  std::vector<Finding> compare(const io::Frame& frame) const;

  /// Every cell there ever was.
  const std::map<std::int64_t, Relative>& all() const { return all_; }
  bool is_there(std::int64_t id) const;
  /// Reference volumes that a cell may have: it doubles within its cycle, and shrinks in lysis,
  /// um^3.
  Interval rest_volume(const Relative& cell, double time) const;

 private:
  const coupling::CycleParams& life_of(const Relative& cell) const {
    return params_.life.type[cell.type];
  }
  double shortest_cycle(const Relative& cell) const;
  bool may_die(std::int64_t id, const Relative& cell, double time) const;
  std::string bear(const io::Event& event);
  std::string end_life(const io::Event& event);
  std::string change_model(const io::Event& event);

  const coupling::Params& params_;
  std::map<std::int64_t, Relative> all_;
};

/// Reference volume of every cell as the frame tells, um^3.
std::map<std::int64_t, double> rest_volumes(const io::Frame& frame);

}  // namespace acinus::bench
