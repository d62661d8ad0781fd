#pragma once
/// Error against CPU time of numerical settings: a scene run from one relaxed state with each
/// setting, compared with a converged run.

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/output/bench_table.hpp"
#include "core/vec.hpp"
#include "coupling/world/world.hpp"

namespace acinus::bench {

/// Spatial discretisation of deformable cells; ignored by spheres.
struct Discretisation {
  int nodes = 162;
  std::string quadrature = "3-point";
  auto operator<=>(const Discretisation&) const = default;
};

/// One setting of the numerics.
struct PrecisionSetting {
  Discretisation space;
  coupling::Integrator integrator = coupling::Integrator::kLinearlyImplicit;
  double step = 60;                                    ///< s; the longest if adaptive
  double cg_tolerance = solve::CgOptions{}.tolerance;  ///< as solver.tolerance
  bool adaptive = false;     ///< step-size control and displacement cap as by default
  double tolerance = 0.01;   ///< as time.tolerance, um; Newton's method stops at a tenth of it
  bool extrapolate = false;  ///< as time.extrapolate
};

/// Scene and the way to the state from which all settings start.
struct WorkScene {
  std::string name;                                        ///< stem of file names
  std::string title;                                       ///< one line
  std::function<std::string(const Discretisation&)> text;  ///< scene text
  std::function<void(coupling::World&)> prepare{};         ///< before the warm-up; may be empty
  double warm_up = 0, warm_up_step = 1;                    ///< s
  int grow_to = 0;  ///< least number of cells at the start, by division; 0: as placed
  std::function<void(coupling::World&)> begin{};  ///< after the warm-up, at t = 0; may be empty
  bool deformable = true;
  Vec3 axis = Vec3::Zero();  ///< of the strain of the first cell; zero: not measured
};

/// Settings compared with one reference over one time window.
struct PrecisionStudy {
  std::string title;
  double window = 0;  ///< s
  int samples = 1;    ///< equally spaced sampling times, including the end
  PrecisionSetting reference;
  std::vector<PrecisionSetting> setting;
};

/// Cells at one time.
struct Sample {
  std::vector<std::int64_t> id;                         ///< lineages, ascending
  std::vector<Vec3> center;                             ///< um
  std::vector<double> pressure, volume, contact_force;  ///< kPa (cytosol), um^3, nN
  double strain = 0;                                    ///< of the first cell, along the axis
};

/// Samples of one run with its cost.
struct Trajectory {
  std::vector<Sample> sample;  ///< fewer than asked for after a failure
  std::string failure;         ///< cause of an early end; "" = none
  double cpu = 0;              ///< of the steps alone, s
  std::int64_t steps = 0, rejected = 0, cg_iterations = 0;
};

/// Errors over all samples and the cells of both trajectories: rms difference over rms of the
/// reference; of centres after removing the rigid motion of the whole cluster.
struct Errors {
  double pressure = 0, volume = 0, contact_force = 0, strain = 0;  ///< relative
  double center_max = 0, center_rms = 0;                           ///< um
};

/// Cost and error of one setting.
struct PrecisionOutcome {
  PrecisionSetting setting;
  std::string failure;
  double cpu = 0;     ///< s; median of repetitions for short runs
  double window = 0;  ///< simulated time, s
  int cells = 0;
  std::int64_t steps = 0, rejected = 0, cg_iterations = 0;
  Errors error{};  ///< valid without a failure
  /// Error that ranks the settings: of pressure, or of strain if measured.
  double main_error = 0;
};

/// Scene relaxed once per discretisation.
class WarmScene {
 public:
  explicit WarmScene(WorkScene scene) : scene_(std::move(scene)) {}
  const WorkScene& scene() const { return scene_; }

  /// Runs from the relaxed state. With fixed steps a rejected step ends the run.
  Trajectory run(const PrecisionSetting& setting, double window, int samples);

 private:
  const coupling::World& start(const Discretisation& space);
  WorkScene scene_;
  std::map<Discretisation, coupling::World> start_;
};

/// Errors of a trajectory.
/// @pre no failures, equal number of samples
Errors compute_errors(const Trajectory& trajectory, const Trajectory& reference);

/// Runs the reference, then every setting.
/// @param done  called with every outcome
/// @throws Error if the reference fails
std::vector<PrecisionOutcome> run_study(
    WarmScene& scene, const PrecisionStudy& study,
    const std::function<void(const PrecisionOutcome&)>& done = {});

/// Outcome of least CPU time with at most this error; null if there is none.
const PrecisionOutcome* find_cheapest(const std::vector<PrecisionOutcome>& outcomes, double error);

}  // namespace acinus::bench
