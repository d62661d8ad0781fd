/// Experiment "tear": a block of adhering cells is pulled in two by pulls along one line. Those
/// along the direction of the first pull draw one half, those against it the other.

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "coupling/apparatus/pull/pull.hpp"
#include "coupling/world/cell.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/experiments/figures.hpp"
#include "runs/experiments/single_cell.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

/// Share of the largest force below which the block counts as torn.
constexpr double kTorn = 0.02;

/// Rules: pulls along one line, some of them in either direction.
void check_tear(const Scene& scene, Report& report) {
  bool aligned = true, against = false;
  for (const auto& pull : scene.pulls) {
    const Vec3 first = scene.pulls[0].direction.normalized(), own = pull.direction.normalized();
    aligned = aligned && first.cross(own).norm() < 1e-6;
    against = against || first.dot(own) < 0;
  }
  if (!aligned || !against)
    report.add_relation({"/experiment", "/pulls"}, "\"tear\"",
                        "needs pulls along one line, at least one in either direction (acinus "
                        "explain pull)");
}

std::vector<Observable> tear_columns() {
  return {{"tear_force_nN", "nN", "force that pulls the halves apart, mean of the two"},
          {"separation_um", "um",
           "distance between the mean positions of the pulled cells of the two halves"},
          {"tear_work_fJ", "fJ", "work of the force since it last began to pull"}};
}

/// Force on a half, nN, and mean place of its pulled cells along the line, um.
struct Half {
  double force = 0, place = 0;
  int cells = 0;
};

void sample_tear(const std::vector<coupling::Pull>& pulls, const ObservedFrame& f, Measures& m) {
  const coupling::State& s = f.world.state;
  const Vec3 line = pulls.empty() ? Vec3(Vec3::UnitX()) : pulls[0].direction;
  Half half[2];
  for (const coupling::Pull& p : pulls) {
    const std::optional<coupling::Cell> cell = coupling::find_cell(s, p.cell);
    if (!cell) continue;
    const Vec3 center = coupling::center_of(s, *cell);
    Half& own = half[p.direction.dot(line) > 0 ? 0 : 1];
    own.force += coupling::pull_force(p, f.snapshot.time, center);
    own.place += center.dot(line);
    ++own.cells;
  }
  std::vector<double>&force = m["tear_force_nN"], &separation = m["separation_um"],
  &work = m["tear_work_fJ"];
  const bool whole = half[0].cells > 0 && half[1].cells > 0;
  const double now = whole ? 0.5 * (half[0].force + half[1].force) : kNotMeasured;
  const double apart =
      whole ? half[0].place / half[0].cells - half[1].place / half[1].cells : kNotMeasured;
  double done = 0;
  if (!work.empty() && now > 0)
    done = work.back() + 0.5 * (std::max(force.back(), 0.0) + now) * (apart - separation.back());
  force.push_back(now);
  separation.push_back(apart);
  work.push_back(done);
}

Sampler make_tear_sampler(const coupling::World& world) {
  const auto& pulls = world.params.apparatus.get<coupling::Pulls>().pull;
  return [&pulls](const ObservedFrame& f, ObservedRun& observed) {
    sample_tear(pulls, f, observed.measures);
  };
}

/// Largest force so far and the frame at which it acted.
std::optional<std::size_t> peak_of(const Measures& m) {
  const auto force = m.find("tear_force_nN");
  if (force == m.end() || force->second.empty()) return {};
  const auto peak = std::ranges::max_element(force->second);
  if (!(*peak > 0)) return {};
  return static_cast<std::size_t>(peak - force->second.begin());
}

bool is_torn(const Measures& m) {
  const std::optional<std::size_t> peak = peak_of(m);
  if (!peak) return false;
  const std::vector<double>& force = m.at("tear_force_nN");
  return *peak + 1 < force.size() && force.back() < kTorn * force[*peak];
}

std::string why_torn(const Measures& m) { return is_torn(m) ? "the block is torn in two" : ""; }

/// Largest force and all the work, if the block was torn.
void add_tear_figures(const Scene&, const Measures& m, nlohmann::ordered_json& figures) {
  const std::optional<std::size_t> peak = peak_of(m);
  const bool torn = is_torn(m);
  const auto of_peak = [&](const char* series) {
    return torn ? m.at(series)[*peak] : kNotMeasured;
  };
  figures["tear_peak_nN"] = finite_number(of_peak("tear_force_nN"));
  figures["tear_peak_separation_um"] = finite_number(of_peak("separation_um"));
  double work = 0;
  if (torn) work = std::ranges::max(m.at("tear_work_fJ"));
  figures["tear_total_work_fJ"] = finite_number(torn ? work : kNotMeasured);
}

}  // namespace

const ExperimentRow tear_experiment{.meaning = "force and work that tear a block of cells in two",
                                    .check = check_tear,
                                    .columns = tear_columns,
                                    .make_sampler = make_tear_sampler,
                                    .why_over = why_torn,
                                    .add_figures = add_tear_figures};

}  // namespace acinus::runs
