#include "runs/session/recorder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <ctime>

#include "acinus_version.hpp"
#include "core/error.hpp"
#include "core/parallel/clock.hpp"
#include "coupling/step/workspace_size.hpp"
#include "coupling/substances/growing_box.hpp"
#include "coupling/world/state_parts.hpp"
#include "dcm/contact/contact_bodies.hpp"
#include "runs/assemble/build_substances.hpp"
#include "runs/assemble/state_file.hpp"
#include "runs/assemble/substance_file.hpp"
#include "runs/session/run_folder.hpp"
#include "runs/session/skipped.hpp"
#include "runs/session/sphere_overlaps.hpp"
#include "runs/session/summary.hpp"

namespace acinus::runs {
namespace {

std::string now_text() {
  const std::time_t t = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&t));
  return text;
}

/// Calls f(name, count) for every kind of record in a run file.
template <class Counts, class F>
void visit(Counts& c, F f) {
  f("file/frames", c.frame);
  f("file/series", c.series);
  f("file/events", c.event);
  f("file/observables", c.observable);
}

}  // namespace

Recorder::Recorder(const Scene& scene, const RunOptions& options, coupling::Simulation& simulation)
    : scene_(scene), options_(options), simulation_(simulation) {
  life_.start_cells = coupling::count_cells(simulation.world().state);
}

io::RunFileOptions Recorder::file_options() const { return {.compress = scene_.output.compress}; }

void Recorder::create() {
  if (!ranks().is_root()) return;
  file_ = io::RunFile::create(run_file(),
                              {{"scene", scene_.resolved_json},
                               {"scene_hash", scene_.hash},
                               {"command_line", options_.command_line},
                               {"version", ACINUS_VERSION},
                               {"git", ACINUS_GIT},
                               {"compiler", ACINUS_COMPILER},
                               {"flags", ACINUS_FLAGS},
                               {"seed", std::to_string(scene_.seed)},
                               {"ranks", std::to_string(simulation_.world().ranks.size())},
                               {"threads", std::to_string(options_.threads)},
                               {"units", "um, s, nN"},
                               {"start", now_text()}},
                              file_options());
}

Notes Recorder::resume() {
  const io::LoadedCheckpoint loaded = io::load_checkpoint(options_.out);
  const io::CheckpointData& data = loaded.data;
  check_same_scene(data, scene_);
  coupling::World& world = simulation_.world();
  get_state(data, types_of(world.params), world.state);
  coupling::place_vessels(world.params.tree, world.state.tree, world.params.boundary.vessels);
  coupling::place_fields(world.params.substances, world.state);
  check_substances(world.params, world.state, data.source());
  simulation_.resize();
  get_totals(data, totals_);
  get_totals(data, life_);
  wall_before_ = totals_.wall_s;
  cpu_before_ = totals_.cpu_s;
  before_ = get_attempts(data);
  last_frame_ = data.number("file/last_frame");
  excess_ = {data.number("file/excess"), "some cells overlap beyond what contact mends", {}};
  observed_ = get_observed_run(data);
  Notes notes;
  if (!ranks().is_root()) return notes;
  io::RunFileCounts counts;
  visit(counts, [&](const char* name, std::int64_t& n) { n = data.count(name); });
  file_ = io::RunFile::open_for_append(run_file(), counts, file_options());
  if (world.params.substances.exists())
    fields_.emplace(options_.out, data.numbers("file/field_times"), scene_.output.compress);
  notes.info.push_back(
      fmt::format("resumed at {:.4g} h from {}", simulation_.time() / 3600, loaded.file));
  if (!loaded.warning.empty()) notes.warnings.push_back(loaded.warning);
  if (!file_->lost().empty())
    notes.warnings.push_back(fmt::format(
        "{}: some of its bytes are not those that were written. Lost: {}. The rest is kept and the "
        "run goes on; the damaged file is {}.damaged",
        run_file(), fmt::join(file_->lost(), ", "), run_file()));
  return notes;
}

Excess Recorder::write_frame(bool last) {
  if (reads_points(scene_, simulation_.world()))
    simulation_.complete_points();
  else
    simulation_.refresh_points();
  const coupling::World& world = simulation_.world();
  coupling::Workspace& work = simulation_.work();
  const auto scope = work.timings.scope("frames and audit");
  const Snapshot snapshot = take_snapshot(world, work);
  coupling::release_scratch(work);
  dcm::copy_all_nodes(world.state.dcm, work.dcm);
  if (!static_bodies_) static_bodies_ = prepare_static_bodies(world.params.boundary);
  const coupling::AuditResult audit = audit_world(world, work, snapshot, *static_bodies_);
  add_audit(totals_, audit);
  std::vector<io::SeriesValue> observables;
  if (simulation_.is_running())
    observables = observe_frame({scene_, world, work, snapshot, audit}, observed_);
  io::Table contacts;
  if (scene_.output.contacts)
    contacts = contact_table(coupling::list_contacts(world, work, snapshot.cells), snapshot.cells);
  if (!file_) {
    send_points(world, work);
  } else {
    if (drawn_boundary_.node.empty() || world.params.tree.exists())
      drawn_boundary_ = draw_boundary(world.params.boundary);
    io::FrameSource frame = make_frame_source(world, work, snapshot, drawn_boundary_);
    add_concentrations(world, snapshot, frame.cells);
    if (scene_.output.contacts) frame.contacts = std::move(contacts);
    file_->append(frame, observables);
  }
  write_fields(snapshot.time);
  last_frame_ = snapshot.time;
  if (audit.n_self_intersecting > 0)
    add_event("self_intersection",
              fmt::format("{} self-intersecting cells", audit.n_self_intersecting));
  Excess excess = find_excess(audit, world, work);
  if (excess.depth_um > 0) add_event("deep_overlap", excess.cause, excess.cells);
  const bool shrinks = excess.depth_um < excess_.depth_um && !last;
  excess_ = excess;
  return shrinks ? Excess{} : excess;
}

std::string Recorder::warn_of_outside() {
  if (warned_of_outside_) return {};
  const std::size_t n = find_cells_outside_fields(simulation_.world()).size();
  if (n == 0) return {};
  warned_of_outside_ = true;
  return fmt::format(
      "at t = {:.4g} h, {} cells are outside the box of the substances. They exchange with the "
      "voxels nearest to them. Give a larger substance_grid.box.",
      simulation_.time() / 3600, n);
}

void Recorder::write_fields(double time) {
  const coupling::World& world = simulation_.world();
  if (!file_ || !world.params.substances.exists()) return;
  if (!fields_) fields_.emplace(options_.out, std::vector<double>{}, scene_.output.compress);
  fields_->append(make_field_frame(world, time));
}

void Recorder::write_series(const coupling::StepResult& step) {
  if (!file_) return;
  const coupling::State& s = simulation_.world().state;
  const std::array<io::SeriesValue, 11> sample{
      {{"time", "s", simulation_.time()},
       {"dt", "s", step.step},
       {"dcm_cells", "1", static_cast<double>(dcm::count_cells(s.dcm))},
       {"cbm_cells", "1", static_cast<double>(s.cbm.n_cell())},
       {"asleep", "1", static_cast<double>(coupling::count_asleep(s))},
       {"max_move", "um", step.max_move},
       {"error", "um", step.error},
       {"rejections", "1", static_cast<double>(step.rejections)},
       {"cg_iterations", "1", static_cast<double>(s.clock.cg_iterations)},
       {"balance_momentum", "1", s.balance.momentum},
       {"balance_torque", "1", s.balance.torque}}};
  file_->append_series(sample);
}

void Recorder::add_event(const std::string& code, const std::string& message,
                         const std::vector<std::int64_t>& cells) {
  if (file_) file_->append_event({simulation_.time(), code, cells, message});
}

void Recorder::add_life(const coupling::LifeReport& report) {
  if (counts_births(scene_) && !report.events.empty()) simulation_.complete_points();
  const coupling::World& world = simulation_.world();
  runs::add_life(life_, report, coupling::count_cells(world.state), wall_s());
  observe_births(scene_, world, report, observed_);
  for (const coupling::LifeEvent& e : report.events) add_event(name_of(e.kind), e.message, e.cells);
}

io::CheckpointSource Recorder::make_checkpoint() {
  io::CheckpointSource source;
  put_state(ranks(), simulation_.world().state, source);
  if (!file_) return source;
  io::CheckpointData& data = source.whole;
  data.put("scene", scene_.resolved_json);
  totals_.wall_s = wall_s();
  totals_.cpu_s = cpu_before_ + cpu_seconds() - started_cpu_;
  put_totals(totals_, data);
  put_totals(life_, data);
  put_attempts(attempts(), data);
  put_observed_run(observed_, data);
  data.put_number("file/last_frame", last_frame_);
  data.put_number("file/excess", excess_.depth_um);
  if (fields_) data.put("file/field_times", fields_->times());
  const io::RunFileCounts counts = file_->counts();
  visit(counts, [&](const char* name, std::int64_t n) { data.put_count(name, n); });
  return source;
}

void Recorder::save() {
  const auto scope = simulation_.work().timings.scope("checkpoints");
  if (file_) file_->flush();
  const io::CheckpointSource source = make_checkpoint();
  if (file_)
    io::save_checkpoint(options_.out, source);
  else
    io::visit_parts(source);
}

void Recorder::close(RunOutcome status, const std::string& cause) {
  save();
  const std::uint64_t hash = coupling::hash_state(ranks(), simulation_.world().state);
  const double largest = largest_sphere(simulation_.world());
  if (!file_) return;
  file_->set_provenance("end", now_text());
  file_->set_provenance("status", name_of_choice(status));
  file_->close();
  const coupling::World& world = simulation_.world();
  const coupling::Workspace& work = simulation_.work();
  std::vector<std::string> skipped = list_skipped(world);
  for (const std::string& what : list_skipped_work(world, work)) skipped.push_back(what);
  write_summary(options_.out,
                {scene_, options_, world, totals_, life_, observed_.measures, attempts(),
                 work.timings, skipped, notes_, status, cause, hash, largest, options_.threads});
}

}  // namespace acinus::runs
