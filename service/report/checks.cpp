#include "service/report/checks.hpp"

#include <array>
#include <nlohmann/json.hpp>

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
    Check{"sum of internal forces, over the sum of their sizes", "/balance/momentum", "1", 1e-12},
    Check{"sum of their torques", "/balance/torque", "1", 1e-12},
    Check{"cells that cross themselves", "/self_intersecting_cells", "1", 0},
    Check{"deepest overlap of deformable cells with anything", "/max_penetration_um", "um", 1.5},
    Check{"worst triangle", "/min_triangle_quality", "1", 0.05, false},
};

}  // namespace

OrderedJson list_checks(const OrderedJson& summary) {
  OrderedJson list = OrderedJson::array();
  for (const Check& c : kChecks) {
    const OrderedJson::json_pointer path(c.path);
    if (!summary.contains(path) || !summary.at(path).is_number()) continue;
    const double value = summary.at(path).get<double>();
    list.push_back({{"name", c.name},
                    {"value", value},
                    {"unit", c.unit},
                    {"limit", c.limit},
                    {"at_most", c.at_most},
                    {"pass", c.at_most ? value <= c.limit : value >= c.limit}});
  }
  return list;
}

}  // namespace acinus::service
