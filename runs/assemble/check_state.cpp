#include "runs/assemble/check_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/error.hpp"

namespace acinus::runs {
namespace {

/// Bounds of coordinates (um) and times (s) in a valid checkpoint; sums of larger ones could
/// overflow.
constexpr double kLargestCoordinate = 1e9, kLargestTime = 1e12;

class Checks {
 public:
  Checks(const coupling::State& state, const StateTypes& types, const std::string& source)
      : s_(state), types_(types), source_(source) {}

  void check_all() const {
    check_shells();
    check_spheres();
    check_life();
    check_clock();
    check_lineages();
  }

 private:
  void need(bool fine, const char* what) const {
    check(fine,
          fmt::format("{}: {} cannot be. The file is damaged or belongs to another scene; resume "
                      "from the previous checkpoint or start anew.",
                      source_, what),
          Exit::kFileError);
  }
  static bool is_number(double x) { return !std::isnan(x); }
  static bool is_near(double x) { return std::abs(x) <= kLargestCoordinate; }
  static bool is_vector(const Vec3& x) { return x.allFinite(); }
  static bool is_ramp(const Ramp& r) {
    return std::isfinite(r.from) && std::isfinite(r.to) && is_number(r.start) && is_number(r.end);
  }

  void check_shells() const {
    const dcm::State& d = s_.dcm;
    for (const dcm::Group& g : d.group) {
      need(g.type >= 0 && std::cmp_less(g.type, types_.dcm),
           "the type of a group of deformable cells");
      need(std::isfinite(g.nucleus.size), "the size of a nucleus");
    }
    need(std::ranges::all_of(d.position, is_near), "a position of deformable cells");
    need(std::ranges::all_of(d.volume, is_ramp), "a volume of deformable cells");
    need(std::ranges::all_of(d.pull, is_vector), "a pull on deformable cells");
    for (const dcm::BirthShape& b : d.birth)
      need(is_ramp(b.weight) && std::isfinite(b.area) && std::ranges::all_of(b.edge, is_number) &&
               std::ranges::all_of(b.triangle, is_number) && std::ranges::all_of(b.link, is_number),
           "the shape of a cell at birth");
    for (const dcm::EdgeTension& t : d.tension)
      need(std::ranges::all_of(t.force, is_number) && std::ranges::all_of(t.length, is_number),
           "the tension of a cell");
  }

  void check_spheres() const {
    const cbm::State& c = s_.cbm;
    const auto n = static_cast<int>(c.n_cell());
    need(std::ranges::all_of(c.type, [&](int t) { return t >= 0 && std::cmp_less(t, types_.cbm); }),
         "the type of a sphere");
    need(std::ranges::all_of(c.position, is_near), "a position of spheres");
    need(std::ranges::all_of(c.volume, is_ramp), "a volume of spheres");
    need(std::ranges::all_of(c.strength, is_ramp), "a strength of spheres");
    need(std::ranges::all_of(c.young, [](double e) { return std::isfinite(e) && e >= 0; }),
         "a stiffness of spheres");
    need(std::ranges::all_of(c.pull, is_vector), "a pull on spheres");
    need(std::ranges::is_sorted(c.touching) &&
             std::ranges::all_of(
                 c.touching,
                 [&](const auto& t) { return t.first >= 0 && t.first < n && t.second < n; }),
         "the list of spheres that touch");
  }

  void check_life() const {
    const std::size_t n = s_.dcm.n_lane() + s_.cbm.n_cell();
    const auto none_or_all = [&](std::size_t found) { return found == 0 || found == n; };
    need(none_or_all(s_.leader.size()), "the list of leaders");
    need(s_.last_move.empty() || std::ranges::all_of(s_.last_move, is_near), "the last move");
    need(std::ranges::all_of(s_.model_since, is_number), "the time since a change of model");
    need(std::ranges::all_of(s_.settle_pressure, is_number), "a pressure at rest");
    for (const coupling::Cycle& c : s_.cycle)
      need(c.fate >= coupling::Fate::kIdle && c.fate <= coupling::Fate::kQuiescent &&
               is_number(c.birth) && is_number(c.birth_volume) && is_number(c.duration) &&
               is_number(c.wait_until),
           "the life of a cell");
    for (const coupling::FadingForce& f : s_.fading)
      need(is_vector(f.force) && is_vector(f.apart) && std::isfinite(f.virial) &&
               std::isfinite(f.reach) && is_ramp(f.share),
           "a force that fades");
    for (const Vec3& x : s_.tree.node) need(x.allFinite(), "a node of the vessels");
    for (const Eigen::Quaterniond& q : s_.tree.rotation)
      need(q.coeffs().allFinite(), "a rotation of the vessels");
    need(s_.next_lineage >= 0 && s_.divisions >= 0 && s_.deaths >= 0 && s_.life_interval >= -1 &&
             s_.sleep_interval >= -1 && s_.leader_interval >= -1,
         "a count of cells or intervals");
  }

  void check_clock() const {
    const coupling::Clock& c = s_.clock;
    need(c.phase >= coupling::Phase::kGrow && c.phase <= coupling::Phase::kRun,
         "the phase of the run");
    need(c.due <= coupling::EventsDue::kZoom, "the events that are due");
    for (const double t : {c.time, c.origin, c.phase_start, s_.settle_time})
      need(std::abs(t) <= kLargestTime, "a time of the clock");
    for (const double t : {c.step, c.last_step})
      need(t >= 0 && t <= kLargestTime, "the length of a step");
    need(c.accepted >= 0 && c.rejected >= 0 && c.shortened >= 0 && c.cg_iterations >= 0 &&
             c.solves >= 0,
         "a count of steps");
  }

  /// Checks that lineages are unique and not negative; cells are looked up by them.
  void check_lineages() const {
    std::set<std::int64_t> seen;
    for (const std::int64_t id : s_.dcm.lineage)
      need(id == dcm::kEmptyLane || (id >= 0 && seen.insert(id).second), "the lineage of a cell");
    for (const std::int64_t id : s_.cbm.lineage)
      need(id >= 0 && seen.insert(id).second, "the lineage of a cell");
  }

  const coupling::State& s_;
  const StateTypes& types_;
  const std::string& source_;
};

}  // namespace

void check_state(const coupling::State& state, const StateTypes& types, const std::string& source) {
  Checks(state, types, source).check_all();
}

}  // namespace acinus::runs
