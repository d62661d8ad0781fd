#include "runs/assemble/build_correction.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "calibration/law_file.hpp"
#include "core/error.hpp"
#include "runs/assemble/law_parameters.hpp"
#include "runs/assemble/shipped_laws.hpp"

namespace acinus::runs {
namespace {

std::string describe(const calibration::Law& law) {
  if (law.table.empty())
    return fmt::format("E = {:.4g} kPa + {:.4g} kPa d^{:g}, fitted for d from {:.2g} to {:.2g}",
                       law.a0, law.a1, law.power, law.overlap_range[0], law.overlap_range[1]);
  return fmt::format("E from {:.3g} kPa at d = {:.2g} to {:.3g} kPa at d = {:.2g} by a table",
                     law.table.front().modulus, law.table.front().overlap, law.table.back().modulus,
                     law.table.back().overlap);
}

}  // namespace

void build_corrections(const Scene& scene, std::vector<cbm::Params>& params, Notes& notes) {
  std::size_t k = 0;
  for (const auto& [name, type] : scene.cell_types) {
    cbm::Params& p = params[k++];
    std::string file = type.cbm.stiffness_correction;
    if (file == "none") continue;
    if (file == "paper") {
      p.correction = cbm::paper_law();
      notes.info.push_back(name + ": E = E + 4e6 Pa d^4, d the mean overlap of the contacts");
      continue;
    }
    if (file == "auto" && !may_have_spheres(scene)) continue;
    if (file == "auto") file = find_shipped_law(scene, type);
    check(!file.empty(),
          fmt::format("/cell_types/{}/cbm/stiffness_correction: no shipped law fits these cells, "
                      "and only `acinus run` calibrates by itself. Calibrate first and name the "
                      "law file.",
                      name));
    const calibration::Law law = calibration::read_law(file);
    notes.info.push_back(fmt::format("{}: {} ({})", name, describe(law), file));
    for (const std::string& warning : law.warnings)
      notes.warnings.push_back(fmt::format("{}: {}", file, warning));
    const LawParameters here = law_parameters(scene, type);
    const std::vector<std::string> differences =
        calibration::list_differences(law, here.dcm, here.cbm);
    if (!differences.empty())
      notes.warnings.push_back(
          fmt::format("{} is the law of other cells than {}: {}. Calibrate for "
                      "these cells, or set stiffness_correction to \"auto\"",
                      file, name, fmt::join(differences, "; ")));
    p.young = law.a0;
    if (!scene.friction.cbm_cbm && law.friction_share > 0) {
      p.cell_friction = law.friction_share * scene.contact.cell_friction;
      notes.info.push_back(
          fmt::format("{}: friction between spheres {:.3g} N s/m^3, {:.3g} of that "
                      "between deformable cells",
                      name, 1e9 * p.cell_friction, law.friction_share));
    }
    p.correction = calibration::stiffness_law(law);
    p.correction.single_overlaps = type.cbm.single_overlaps;
  }
}

}  // namespace acinus::runs
