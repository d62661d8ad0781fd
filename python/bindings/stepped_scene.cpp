#include "python/bindings/stepped_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/stop.hpp"
#include "core/parallel/threads.hpp"
#include "coupling/world/cell.hpp"
#include "runs/calibrate/law_cache.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/frame_times.hpp"
#include "runs/scene/shipped_scenes.hpp"

namespace acinus::python {
namespace {

runs::Scene read(const std::string& name, const std::vector<std::string>& set, int threads) {
  runs::Scene scene = runs::read_scene(runs::find_scene_file(name), set);
  const int code = runs::resolve_corrections(scene, threads, true);
  check(code == 0, fmt::format("{}: the calibration of its spheres was stopped", name),
        Exit::kStopped);
  return scene;
}

coupling::World build(const runs::Scene& scene, std::vector<std::string>& type_names) {
  runs::BuiltWorld built = runs::build_world(scene, Ranks::serial());
  type_names = std::move(built.type_names);
  return std::move(built.world);
}

bool is_finite(const Vec3& x) { return x.allFinite(); }

/// Living cell of a lineage.   @throws Error
coupling::Cell require_cell(const coupling::State& s, std::int64_t lineage) {
  const std::optional<coupling::Cell> found = coupling::find_cell(s, lineage);
  check(found.has_value(), fmt::format("there is no cell {} now", lineage));
  return *found;
}

}  // namespace

SteppedScene::SteppedScene(const std::string& scene, const std::vector<std::string>& set,
                           int threads)
    : scene_(read(scene, set, threads)),
      threads_(threads > 0 ? threads : processor_count()),
      simulation_(build(scene_, type_names_)) {}

bool SteppedScene::run_until(double end) { return advance(end, false); }
bool SteppedScene::step() { return advance(std::numeric_limits<double>::infinity(), true); }

bool SteppedScene::advance(double end, bool once) {
  set_threads(threads_);
  const StopSignals signals;
  take_back();
  const coupling::Observer observer{
      .next_moment = [this](double time) { return runs::next_frame(scene_, time); },
      .events_over = [&] { return !once && !stop_requested(); }};
  const coupling::LoopResult result = simulation_.run_until(end, observer);
  if (stop_requested()) return false;
  check(result.ok,
        fmt::format("a step of {} s still fails at t = {:.4g} h: {}. Cells concerned: {}. The "
                    "state is the last good one.",
                    scene_.numerics.min_step, time() / 3600, result.last.cause,
                    fmt::join(result.last.cells, ", ")),
        Exit::kCannotContinue);
  return true;
}

std::uint64_t SteppedScene::hash() const { return coupling::hash_state(state()); }

std::vector<coupling::CellMeasure> SteppedScene::measure() {
  set_threads(threads_);
  coupling::observe(simulation_.world(), simulation_.work());
  return coupling::measure_cells(simulation_.world(), simulation_.work());
}

std::shared_ptr<const Loan> SteppedScene::lend_positions() {
  if (!loan_) loan_ = std::make_shared<Loan>();
  return loan_;
}

/// Moving a vector leaves its numbers where they are: borrowers do not notice.
void SteppedScene::take_back() {
  if (loan_.use_count() > 1) {
    coupling::State& s = simulation_.world().state;
    HeldRows<double> dcm = s.dcm.position, cbm = s.cbm.position;
    loan_->dcm = std::exchange(s.dcm.position, std::move(dcm));
    loan_->cbm = std::exchange(s.cbm.position, std::move(cbm));
  }
  loan_.reset();
}

void SteppedScene::move(std::int64_t lineage, const std::vector<Vec3>& point) {
  coupling::State& s = simulation_.world().state;
  const coupling::Cell c = require_cell(s, lineage);
  const std::size_t n = c.deformable ? s.dcm.group[c.at / kLanes].topology->n_node : 1;
  check(point.size() == n, fmt::format("cell {} has {} points, not {}", lineage, n, point.size()));
  check(std::ranges::all_of(point, is_finite),
        fmt::format("cell {}: a coordinate is not finite", lineage));
  take_back();
  if (c.deformable) {
    dcm::store_nodes(point, c.at, s.dcm);
  } else {
    store_point(s.cbm.position.data(), cbm::cell_address(0, c.at), point[0]);
  }
  s.last_move.clear();  // says nothing of a state that was changed
  simulation_.resize();
}

void SteppedScene::set_pull(std::int64_t lineage, const Vec3& force) {
  coupling::State& s = simulation_.world().state;
  const coupling::Cell c = require_cell(s, lineage);
  check(is_finite(force), fmt::format("pull on cell {}: is not finite", lineage));
  if (c.deformable)
    s.dcm.pull[c.at] = force;
  else
    s.cbm.pull.set(c.at, force);
}

}  // namespace acinus::python
