#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "runs/compare/compare.hpp"
#include "service/report/other_parts.hpp"
#include "service/report/run_part.hpp"

namespace acinus::service {

nlohmann::ordered_json describe_comparison(const std::vector<std::string>& folders) {
  using OrderedJson = nlohmann::ordered_json;
  try {
    const runs::Comparison c = runs::compare_runs(folders, {});
    OrderedJson j{{"from", c.from}, {"to", c.to}, {"frames", c.frames}, {"notes", c.notes}};
    for (const std::vector<runs::Difference>& run : c.difference) {
      OrderedJson rows = OrderedJson::array();
      for (const runs::Difference& d : run)
        rows.push_back(
            {{"name", d.name},
             {"unit", d.unit},
             {"reference", d.absolute ? OrderedJson(nullptr) : short_number(d.reference)},
             {"value", short_number(d.value)},
             {"change", short_number(d.change())},
             {"rms", short_number(d.rms())},
             {"absolute", d.absolute}});
      j["runs"].push_back(rows);
    }
    return j;
  } catch (const Error& error) {
    return {{"fault", error.what()}};
  }
}

}  // namespace acinus::service
