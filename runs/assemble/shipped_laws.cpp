#include "runs/assemble/shipped_laws.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "calibration/law_file.hpp"
#include "core/error.hpp"
#include "runs/assemble/law_parameters.hpp"
#include "runs/scene/accuracy.hpp"
#include "runs/scene/shipped_scenes.hpp"

namespace acinus::runs {

std::vector<std::string> shipped_laws() { return shipped_files("laws"); }

std::string law_file(const std::string& given) {
  if (std::filesystem::exists(given)) return given;
  std::string shipped = find_shipped_file("laws", given);
  check(!shipped.empty(),
        fmt::format("{}: no such file, and no shipped law has this name; there are {}", given,
                    fmt::join(shipped_names("laws"), ", ")),
        Exit::kFileError);
  return shipped;
}

std::string describe_law(const std::string& file) {
  try {
    const calibration::Parameters cell = calibration::read_law(file).dcm;
    const auto value = [&cell](const char* name) {
      const auto found = cell.find(name);
      return found == cell.end() ? 0.0 : found->second;
    };
    return fmt::format("cells of {:g} um, {:g} nodes, K_V = {:g} Pa, W = {:g} J/m^2",
                       value("radius_um"), value("nodes"), 1e3 * value("bulk_modulus_kPa"),
                       1e-3 * value("adhesion_nN_per_um"));
  } catch (const Error& error) {
    return std::string("cannot be read: ") + error.what();
  }
}

std::string find_shipped_law(const Scene& scene, const CellType& type) {
  // Shipped laws were calibrated with the default settings of contact. Contact points, and the
  // range that an accuracy sets with them, change the modulus less than a law errs in other tissue
  // (decision 66).
  const ContactBlock defaults;
  ContactBlock contact = scene.contact;
  contact.quadrature = defaults.quadrature;
  if (scene.accuracy != Accuracy::kByKey &&
      contact.range_factor == settings_of(scene.accuracy).range)
    contact.range_factor = defaults.range_factor;
  if (law_settings(contact) != law_settings(defaults)) return "";
  const LawParameters here = law_parameters(scene, type);
  for (const std::string& file : shipped_laws()) {
    const calibration::Law law = calibration::read_law(file);
    if (calibration::list_differences(law, here.dcm, here.cbm).empty()) return file;
  }
  return "";
}

void use_shipped_laws(Scene& scene) {
  for (auto& [name, type] : scene.cell_types) {
    if (type.cbm.stiffness_correction != "auto") continue;
    const std::string file = find_shipped_law(scene, type);
    if (!file.empty()) type.cbm.stiffness_correction = file;
  }
}

std::vector<std::string> leave_out_calibrations(Scene& scene) {
  std::vector<std::string> left_out;
  if (!may_have_spheres(scene)) return left_out;
  for (auto& [name, type] : scene.cell_types) {
    if (type.cbm.stiffness_correction != "auto") continue;
    type.cbm.stiffness_correction = "none";
    left_out.push_back(name);
  }
  return left_out;
}

}  // namespace acinus::runs
