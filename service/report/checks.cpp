#include "service/report/checks.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "runs/session/sphere_overlaps.hpp"

namespace acinus::service {
namespace {

using OrderedJson = nlohmann::ordered_json;

struct Check {
  const char* name;
  const char* path;
  const char* unit;
  double limit;  ///< in `unit`
  bool at_most = true;
};

/// Accuracy checks of a run. Internal forces sum to zero up to rounding. Contact searches 1.5 um
/// deep by default and resolves shallower overlaps (soundness.hpp). Triangle quality 1 is
/// equilateral.
constexpr std::array kChecks{
    Check{"net internal force over the sum of magnitudes", "/balance/momentum", "1", 1e-12},
    Check{"net internal torque over the sum of magnitudes", "/balance/torque", "1", 1e-12},
    Check{"self-intersecting cells", "/self_intersecting_cells", "1", 0},
    Check{"largest overlap of deformable cells", "/max_penetration_um", "um", 1.5},
    Check{"minimum mesh quality (1: equilateral)", "/min_triangle_quality", "1", 0.05, false},
};

/// Check of overlaps of spheres, with a limit in their radii.
struct SphereCheck {
  const char* name;
  const char* path;
  double limit;
};
constexpr std::array kSphereChecks{
    SphereCheck{"largest overlap of two spheres (half a radius, as deformable cells)",
                "/max_overlap_cbm_um", runs::kSphereOverlap},
    SphereCheck{"largest overlap of a sphere with a vessel (0.4 radii, as deformable cells)",
                "/overlap_of_spheres_um/cbm_vessel", runs::kVesselOverlap},
};

/// Number at a path of the summary; empty if there is none.
std::optional<double> number_at(const OrderedJson& summary, const char* path) {
  const OrderedJson::json_pointer at(path);
  if (!summary.contains(at) || !summary.at(at).is_number()) return {};
  return summary.at(at).get<double>();
}

void add_check(const Check& c, const OrderedJson& summary, OrderedJson& list) {
  const std::optional<double> value = number_at(summary, c.path);
  if (!value) return;
  list.push_back({{"name", c.name},
                  {"value", *value},
                  {"unit", c.unit},
                  {"limit", c.limit},
                  {"at_most", c.at_most},
                  {"pass", c.at_most ? *value <= c.limit : *value >= c.limit}});
}

}  // namespace

OrderedJson list_checks(const OrderedJson& summary) {
  OrderedJson list = OrderedJson::array();
  for (const Check& c : kChecks) add_check(c, summary, list);
  const double radius = number_at(summary, "/overlap_of_spheres_um/radius").value_or(0);
  if (radius == 0) return list;
  for (const SphereCheck& c : kSphereChecks) {
    // Sister cells overlap by more at birth.
    const bool of_sisters =
        &c == kSphereChecks.begin() && number_at(summary, "/cells/divisions").value_or(0) > 0;
    if (!of_sisters) add_check({c.name, c.path, "um", c.limit * radius}, summary, list);
  }
  return list;
}

}  // namespace acinus::service
