#include "runs/session/read_summary.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "io/checkpoint.hpp"
#include "io/disk.hpp"
#include "runs/scene/bounded_json.hpp"
#include "runs/scene/json_text.hpp"
#include "runs/session/run_folder.hpp"
#include "runs/session/shell_quote.hpp"

namespace acinus::runs {

namespace {

/// Error for a folder without summary.json, which is written when a run ends.
Error missing_summary(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code code;
  if (!fs::is_directory(folder, code))
    return Error(
        fmt::format("{}: no such folder. Name a run folder that `acinus run` wrote.", folder),
        Exit::kFileError);
  if (is_being_written(folder))
    return Error(fmt::format("{}: the run goes on and has no summary.json yet. Wait until it ends.",
                             folder));
  if (io::has_checkpoint(folder))
    return Error(fmt::format(
        "{0}: the run did not end, it was killed: it has a checkpoint but no summary.json. Go on "
        "with it: acinus run SCENE --resume --out {1}",
        folder, quote_for_shell(folder)));
  if (fs::exists(folder + "/run.log", code))
    return Error(
        fmt::format("{}: the run did not end, it was killed before its first checkpoint: "
                    "there is no summary.json. Run it again with --overwrite.",
                    folder));
  return Error(fmt::format("{}: holds no run: there is no summary.json. Name a run folder that "
                           "`acinus run` wrote.",
                           folder),
               Exit::kFileError);
}

RunOutcome outcome_of(const std::string& status, const std::string& file) {
  const int index = choice_index(kChoices<RunOutcome>, status);
  check(index >= 0,
        fmt::format("{}: status is \"{}\"; completed, stopped and failed are possible. Name a run "
                    "folder that `acinus run` wrote.",
                    file, as_utf8(status.substr(0, 80))));
  return static_cast<RunOutcome>(index);
}

}  // namespace

RunSummary read_summary(const std::string& folder) {
  const std::string file = folder + "/summary.json";
  if (std::error_code code; !std::filesystem::exists(file, code)) throw missing_summary(folder);
  const std::string text = io::read_text_file(file);
  RunSummary s;
  s.folder = folder;
  try {
    const auto j = parse_bounded<nlohmann::json>(text, file);
    s.scene = j.at("scene");
    s.hash = j.at("scene_hash");
    s.version = j.at("version");
    s.git = j.at("git");
    s.status = outcome_of(j.at("status"), file);
    s.cause = j.value("cause", "");
    s.state_hash = j.value("state_hash", "");
    if (j.contains("start")) s.start_hash = j.at("start").at("state_hash");
    s.simulated_s = seconds_at(j, "simulated_s", file);
    s.wall_s = seconds_at(j, "wall_s", file);
    s.cpu_s = seconds_at(j, "cpu_s", file);
    s.dcm = count_at(j.at("cells"), "dcm", file);
    s.cbm = count_at(j.at("cells"), "cbm", file);
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
