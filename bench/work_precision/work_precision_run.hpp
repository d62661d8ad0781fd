#pragma once
/// Error against CPU time: one scene from one relaxed state, with one choice of numerics after the
/// other, each compared with a converged run.

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

/// How cells are made discrete; of no meaning to spheres.
struct Discretisation {
  int nodes = 162;
  std::string quadrature = "3-point";
  auto operator<=>(const Discretisation&) const = default;
};

/// One choice of numerics.
struct PrecisionSetting {
  Discretisation space;
  coupling::Integrator integrator = coupling::Integrator::kLinearlyImplicit;
  double step = 60;                                    ///< s; the longest when adaptive
  double cg_tolerance = solve::CgOptions{}.tolerance;  ///< as solver.tolerance
  bool adaptive = false;     ///< step-size control and displacement cap as a scene has them
  double tolerance = 0.01;   ///< um, as time.tolerance; Newton's method stops at a tenth of it
  bool extrapolate = false;  ///< as time.extrapolate
};

/// What a scene is and how it gets to the state all settings start from.
struct WorkScene {
  std::string name;                                        ///< of files
  std::string title;                                       ///< one line
  std::function<std::string(const Discretisation&)> text;  ///< the scene
  std::function<void(coupling::World&)> prepare{};         ///< before the warm-up; may be empty
  double warm_up = 0, warm_up_step = 1;                    ///< s
  int grow_to = 0;  ///< cells at least before it starts, by division; 0: as many as there are
  std::function<void(coupling::World&)> begin{};  ///< after the warm-up, at t = 0; may be empty
  bool deformable = true;
  Vec3 axis = Vec3::Zero();  ///< strain of the first cell is measured along it; zero: is not
};

/// Settings that are compared with one reference over one stretch of time.
struct PrecisionStudy {
  std::string title;
  double window = 0;  ///< s
  int samples = 1;    ///< equally spaced moments at which results are compared, the end included
  PrecisionSetting reference;
  std::vector<PrecisionSetting> setting;
};

/// The cells at one moment.
struct Sample {
  std::vector<std::int64_t> id;                         ///< of the cells, ascending
  std::vector<Vec3> center;                             ///< um
  std::vector<double> pressure, volume, contact_force;  ///< kPa (cytosol), um^3, nN
  double strain = 0;                                    ///< of the first cell, along the axis
};

struct Trajectory {
  std::vector<Sample> sample;  ///< fewer than asked when it failed
  std::string failure;         ///< why it stopped early; empty: it did not
  double cpu = 0;              ///< s, of the steps alone
  std::int64_t steps = 0, rejected = 0, cg_iterations = 0;
};

/// Against the reference, over all samples and the cells that are there in both: rms of the
/// difference over rms of the reference; centres after removing the rigid motion of the whole
/// cluster.
struct Errors {
  double pressure = 0, volume = 0, contact_force = 0, strain = 0;  ///< relative
  double center_max = 0, center_rms = 0;                           ///< um
};

struct PrecisionOutcome {
  PrecisionSetting setting;
  std::string failure;
  double cpu = 0;     ///< s, median of repetitions when they are short
  double window = 0;  ///< s, simulated
  int cells = 0;
  std::int64_t steps = 0, rejected = 0, cg_iterations = 0;
  Errors error{};  ///< meaningful without a failure
  /// What the cheapest setting is chosen by: pressure, or strain where strain is measured.
  double main_error = 0;
};

/// A scene relaxed once for every discretisation asked for.
class WarmScene {
 public:
  explicit WarmScene(WorkScene scene) : scene_(std::move(scene)) {}
  const WorkScene& scene() const { return scene_; }

  /// Runs from the relaxed state. Fixed steps stay what they are: one that is rejected ends the
  /// run.
  Trajectory run(const PrecisionSetting& setting, double window, int samples);

 private:
  const coupling::World& start(const Discretisation& space);
  WorkScene scene_;
  std::map<Discretisation, coupling::World> start_;
};

/// @pre both without failure, with equally many samples
Errors compute_errors(const Trajectory& trajectory, const Trajectory& reference);

/// Runs the reference, then every setting. `done` is told of every outcome as it comes.
/// @throws Error when the reference fails
std::vector<PrecisionOutcome> run_study(
    WarmScene& scene, const PrecisionStudy& study,
    const std::function<void(const PrecisionOutcome&)>& done = {});

/// The outcome of least CPU time whose error is at most this; null: none.
const PrecisionOutcome* find_cheapest(const std::vector<PrecisionOutcome>& outcomes, double error);

}  // namespace acinus::bench
