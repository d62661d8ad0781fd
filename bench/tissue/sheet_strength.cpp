#include "bench/tissue/sheet_strength.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "core/error.hpp"
#include "dcm/contact/contact_params.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "runs/scene/writer.hpp"
#include "runs/session/stage.hpp"

namespace acinus::bench {
namespace {

using dcm::ContactLaw;

constexpr std::array kAdhesions{0.003, 0.005, 0.01, 0.02, 0.05};  ///< nN/um
constexpr std::array kMeshes{162, 642};

/// Means over the blocks that were torn.
struct Strength {
  double force = 0;  ///< nN, largest
  double work = 0;   ///< fJ
  int torn = 0;      ///< number of blocks
};

struct TearCase {
  ContactLaw law = ContactLaw::kCohesive;
  int nodes = 162;
  double adhesion = 0.02;  ///< nN/um
};

/// True if the run ended, as it does when the block is in two parts, while the springs were drawn:
/// not before, when a block that did not adhere parts by itself, and not at its latest time.
bool was_torn(const runs::Scene& scene, const runs::RunSummary& summary) {
  return summary.simulated_s < scene.time.end &&
         scene.pulls.front().displacement.at(summary.simulated_s) > 0;
}

Strength measure(const runs::Scene& shipped, const TearCase& c, const BenchOptions& options) {
  const std::string root = options.folder.empty() ? "tear" : options.folder + "/tear";
  Strength mean;
  for (int seed = options.first; seed < options.first + options.seeds; ++seed) {
    runs::Scene scene = shipped;
    scene.seed = static_cast<std::uint64_t>(seed);
    scene.contact.law = c.law;
    for (auto& [name, type] : scene.cell_types) {
      type.adhesion = c.adhesion;
      type.dcm.nodes = c.nodes;
    }
    set_canonical(scene);
    const std::string folder =
        fmt::format("{}/{}_{}_nodes_W_{:g}_seed_{}", root,
                    c.law == ContactLaw::kCohesive ? "cohesive" : "maugis_dugdale", c.nodes,
                    1e-3 * c.adhesion, seed);
    const int code = runs::run_stage(
        scene, {folder, options.threads, true, false, "acinus bench contact-laws-strength"});
    check(code == static_cast<int>(Exit::kDone),
          fmt::format("bench contact-laws-strength: the run in {} ended with exit code {}", folder,
                      code),
          Exit::kCannotContinue);
    const runs::RunSummary summary = runs::read_summary(folder);
    if (!was_torn(scene, summary)) continue;
    mean.force += std::ranges::max(runs::series(summary, "tear_force_nN"));
    mean.work += std::ranges::max(runs::series(summary, "tear_work_fJ"));
    ++mean.torn;
  }
  check(mean.torn > 0, "bench contact-laws-strength: no block was torn", Exit::kCannotContinue);
  mean.force /= mean.torn;
  mean.work /= mean.torn;
  return mean;
}

}  // namespace

double adhesion_of(const StrengthCurve& curve, double strength) {
  const std::vector<double>&w = curve.adhesion, &s = curve.strength;
  ACINUS_ASSERT(w.size() == s.size() && w.size() > 1 && s[0] > 0 && w[0] > 0);
  const auto above = std::ranges::upper_bound(s, strength) - s.begin();
  const auto k = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above, 1, static_cast<std::ptrdiff_t>(s.size()) - 1));
  ACINUS_ASSERT(s[k] > s[k - 1] && w[k] > w[k - 1]);
  const double slope = std::log(w[k] / w[k - 1]) / std::log(s[k] / s[k - 1]);
  return w[k] * std::pow(strength / s[k], slope);
}

BenchTable bench_sheet_strength(const BenchOptions& options) {
  const runs::Scene shipped = runs::read_scene(runs::scene_folder() + "/tear.json");
  BenchTable table;
  for (const int nodes : kMeshes) {
    StrengthCurve force, work;
    std::vector<Strength> cohesive;
    for (const double w : kAdhesions) {
      cohesive.push_back(measure(shipped, {ContactLaw::kCohesive, nodes, w}, options));
      force.adhesion.push_back(w);
      force.strength.push_back(cohesive.back().force);
      work.strength.push_back(cohesive.back().work);
    }
    work.adhesion = force.adhesion;
    for (std::size_t k = 0; k < kAdhesions.size(); ++k) {
      const double w = kAdhesions[k];
      const Strength md = measure(shipped, {ContactLaw::kMaugisDugdale, nodes, w}, options);
      BenchRow row{fmt::format("tear, {} nodes, W {:g} J/m^2", nodes, 1e-3 * w), 8, {}};
      row.value = {{"cohesive_force_nN", cohesive[k].force},
                   {"maugis_force_nN", md.force},
                   {"cohesive_work_fJ", cohesive[k].work},
                   {"maugis_work_fJ", md.work},
                   {"cohesive_torn", cohesive[k].torn},
                   {"maugis_torn", md.torn},
                   {"W_eff_over_W_by_force", adhesion_of(force, md.force) / w},
                   {"W_eff_over_W_by_work", adhesion_of(work, md.work) / w}};
      print_row(row);
      table.push_back(row);
    }
  }
  return table;
}

}  // namespace acinus::bench
