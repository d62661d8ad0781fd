#pragma once
/// What a run leaves in its folder: frames, series and events in the run file, checkpoints, the
/// summary. Its counters go on where a resumed run left them. Of several processes one writes, the
/// others only work out with it what there is to write.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/parallel/clock.hpp"
#include "coupling/simulation.hpp"
#include "geometry/surface.hpp"
#include "io/run_file.hpp"
#include "runs/assemble/notes.hpp"
#include "runs/experiments/observe.hpp"
#include "runs/experiments/observed_run.hpp"
#include "runs/session/make_frame.hpp"
#include "runs/session/run_options.hpp"
#include "runs/session/soundness.hpp"
#include "runs/session/totals.hpp"

namespace acinus::runs {

class Recorder {
 public:
  /// @param simulation  is only read; lives as long as the recorder
  Recorder(const Scene& scene, const RunOptions& options, coupling::Simulation& simulation);

  void create();  ///< A new run file. @throws Error(kFileError)
  /// Goes on with an older one: the world gets the state of the checkpoint.
  /// @return what was done   @throws Error(kBadInput, kFileError)
  Notes resume();

  /// @param last  no frame is to come in which an overlap could be gone
  /// @return why the run must not go on from this frame, with depth_um = 0 if it may: overlaps of
  ///         the start must shrink from frame to frame
  Excess write_frame(bool last);
  void write_series(const coupling::StepResult& step);
  void add_event(const std::string& code, const std::string& message,
                 const std::vector<std::int64_t>& cells = {});
  void add_life(const coupling::LifeReport& report);
  /// For the summary.
  void add_note(const std::string& note) { notes_.said.push_back(note); }
  void add_warning(const std::string& warning) { notes_.warned.push_back(warning); }

  void save();  ///< Writes a checkpoint. @throws Error(kFileError)
  /// Checkpoint, run file and summary in their last form.
  /// @param status  completed | stopped | failed
  void close(const std::string& status, const std::string& cause);

  double last_frame() const { return last_frame_; }  ///< s since t = 0
  /// Why the frames so far show all that the experiment is about; empty: they do not.
  std::string why_experiment_is_over() const {
    return why_over(scene_.experiment, observed_.measures);
  }
  bool has_frame() const { return last_frame_ > kNoFrame; }
  /// What was wrong with the last frame.
  const Excess& excess() const { return excess_; }
  double wall_s() const { return wall_before_ + wall_seconds() - started_; }  ///< with resumes

 private:
  const Ranks& ranks() const { return simulation_.world().ranks; }
  std::string run_file() const { return options_.out + "/run.vtkhdf"; }
  io::RunFileOptions file_options() const;
  io::CheckpointData make_checkpoint();

  const Scene& scene_;
  const RunOptions& options_;
  coupling::Simulation& simulation_;
  std::optional<StaticBodies> static_bodies_;  ///< prepared with the first frame
  geometry::Surface drawn_boundary_;
  std::optional<io::RunFile> file_;  ///< none: another process writes
  RunTotals totals_;
  LifeTotals life_;
  ObservedRun observed_;
  Notes notes_;
  double started_ = wall_seconds(), started_cpu_ = cpu_seconds();
  double wall_before_ = 0, cpu_before_ = 0;  ///< of the runs this one continues
  static constexpr double kNoFrame = -1e300;
  double last_frame_ = kNoFrame;
  /// The first frame may overlap: contact is given a chance.
  Excess excess_{std::numeric_limits<double>::infinity(), {}, {}};
};

}  // namespace acinus::runs
