#include "runs/session/read_summary.hpp"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/io/disk.hpp"
#include "runs/scene/bounded_json.hpp"

namespace acinus::runs {

RunSummary read_summary(const std::string& folder) {
  const std::string file = folder + "/summary.json";
  const std::string text = io::read_text_file(file);
  RunSummary s;
  s.folder = folder;
  try {
    const auto j = parse_bounded<nlohmann::json>(text, file);
    s.scene = j.at("scene");
    s.hash = j.at("scene_hash");
    s.version = j.at("version");
    s.git = j.at("git");
    s.status = j.at("status");
    s.cause = j.value("cause", "");
    s.state_hash = j.value("state_hash", "");
    if (j.contains("start")) s.start_hash = j.at("start").at("state_hash");
    s.simulated_s = j.at("simulated_s");
    s.wall_s = j.at("wall_s");
    s.cpu_s = j.at("cpu_s");
    s.dcm = j.at("cells").at("dcm");
    s.cbm = j.at("cells").at("cbm");
    for (const auto& [name, values] : j.at("measures").items()) {
      if (!values.is_array()) continue;  // wall_s_at_cells is a table
      for (const nlohmann::json& v : values)
        s.measures[name].push_back(v.is_number() ? v.get<double>()
                                                 : std::numeric_limits<double>::quiet_NaN());
    }
  } catch (const nlohmann::json::exception& e) {
    throw Error(
        fmt::format("{}: not the summary of a run of this program ({}). Name a run folder "
                    "that `acinus run` wrote.",
                    file, e.what()));
  }
  return s;
}

const std::vector<double>& series(const RunSummary& run, const std::string& name) {
  const auto found = run.measures.find(name);
  check(found != run.measures.end(),
        fmt::format("{}: the run of scene \"{}\" did not measure {}", run.folder, run.scene, name));
  return found->second;
}

}  // namespace acinus::runs
