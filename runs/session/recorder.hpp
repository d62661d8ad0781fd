#pragma once
/// Output of a run to its folder: frames, series and events in the run file, checkpoints, summary.
/// Counters continue those of a resumed run. With several processes the first one writes; the
/// others take part in computing.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/parallel/clock.hpp"
#include "coupling/simulation.hpp"
#include "geometry/surface.hpp"
#include "io/field_file.hpp"
#include "io/run_file.hpp"
#include "runs/assemble/notes.hpp"
#include "runs/experiments/observe.hpp"
#include "runs/experiments/observed_run.hpp"
#include "runs/session/attempts.hpp"
#include "runs/session/audit_world.hpp"
#include "runs/session/idle_rules.hpp"
#include "runs/session/make_frame.hpp"
#include "runs/session/run_options.hpp"
#include "runs/session/run_outcome.hpp"
#include "runs/session/soundness.hpp"
#include "runs/session/totals.hpp"

namespace acinus::runs {

/// Writer of the files of a run.
class Recorder {
 public:
  /// Recorder of a simulation, which it only reads.
  /// @param simulation  must outlive the recorder
  Recorder(const Scene& scene, const RunOptions& options, coupling::Simulation& simulation);

  void create();  ///< Creates the run file. @throws Error(kFileError)
  /// Continues an existing run file and sets the world to the state of the checkpoint.
  /// @return notes on the resumption
  /// @throws Error(kBadInput, kFileError)
  Notes resume();

  /// Writes a frame and audits its overlaps.
  /// @param last  no later frame can resolve an overlap
  /// @return overlaps that end the run; depth_um = 0 if it may go on, since overlaps of the start
  /// may shrink from frame to frame
  Excess write_frame(bool last);
  void write_series(const coupling::StepResult& step);
  void add_event(const std::string& code, const std::string& message,
                 const std::vector<std::int64_t>& cells = {});
  void add_life(const coupling::LifeReport& report);
  /// Adds a note to the summary.
  void add_note(const std::string& note) { notes_.info.push_back(note); }
  void add_warning(const std::string& warning) { notes_.warnings.push_back(warning); }

  void save();  ///< Writes a checkpoint. Collective. @throws Error(kFileError)
  /// Writes checkpoint, run file and summary in their final form. Collective.
  void close(RunOutcome status, const std::string& cause);

  double last_frame() const { return last_frame_; }  ///< time of the last frame, s since t = 0
  /// Reason why the frames so far complete the experiment; empty if they do not.
  std::string completion_reason() const { return why_over(scene_.experiment, observed_.measures); }
  /// Warning of cells that have left the box of the fields; empty: none, or warned before.
  std::string warn_of_outside();
  bool has_frame() const { return last_frame_ > kNoFrame; }
  /// Unresolvable overlaps of the last frame.
  const Excess& excess() const { return excess_; }
  /// Wall time including the runs it continues, s.
  double wall_s() const { return wall_before_ + wall_seconds() - started_; }
  const RunTotals& totals() const { return totals_; }
  /// All attempts of the run with this one.
  Attempts attempts() const { return add_attempt(before_, simulation_.work().timings); }
  int start_cells() const { return static_cast<int>(life_.start_cells); }
  const Measures& measures() const { return observed_.measures; }
  /// Rules of life that never acted so far. Collective.
  std::vector<std::string> idle_rules() const {
    return list_idle_rules(scene_, observed_.measures, simulation_.world(), simulation_.time());
  }

 private:
  const Ranks& ranks() const { return simulation_.world().ranks; }
  std::string run_file() const { return options_.out + "/run.vtkhdf"; }
  io::RunFileOptions file_options() const;
  io::CheckpointSource make_checkpoint();
  void write_fields(double time);

  const Scene& scene_;
  const RunOptions& options_;
  coupling::Simulation& simulation_;
  std::optional<StaticBodies> static_bodies_;  ///< prepared with the first frame
  geometry::Surface drawn_boundary_;
  std::optional<io::RunFile> file_;       ///< none on processes that do not write
  std::optional<io::FieldFiles> fields_;  ///< none without substances, or as above
  RunTotals totals_;
  LifeTotals life_;
  bool warned_of_outside_ = false;
  ObservedRun observed_;
  Notes notes_;
  Attempts before_;  ///< attempts that this one continues
  double started_ = wall_seconds(), started_cpu_ = cpu_seconds();
  double wall_before_ = 0, cpu_before_ = 0;  ///< of the runs this one continues, s
  static constexpr double kNoFrame = -1e300;
  double last_frame_ = kNoFrame;
  /// Infinite before the first frame, whose overlaps contact may resolve.
  Excess excess_{std::numeric_limits<double>::infinity(), {}, {}};
};

}  // namespace acinus::runs
