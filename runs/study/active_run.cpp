#include "runs/study/active_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/inside.hpp"
#include "runs/scene/bounded_json.hpp"
#include "runs/scene/writer.hpp"
#include "runs/study/run_status.hpp"

namespace acinus::runs {
namespace {

namespace fs = std::filesystem;

constexpr double kMostCells = 1e9;

}  // namespace

void clear_run(const std::string& folder) {
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, code))
    if (entry.path().filename() != "claim.lock" && entry.path().filename() != "run.lock")
      fs::remove_all(entry.path(), code);
}

ActiveRun start_run(const StudyPlan& plan, std::size_t index, const std::string& root,
                    io::FileLock claim, bool resume, const ChildRunOptions& options) {
  const StudyRun& run = plan.runs[index];
  const std::string folder = root + "/" + run.folder;
  check(io::is_folder_inside(root, run.folder),
        folder + ": is reached over a link, and what is there is not replaced. Remove the link.",
        Exit::kFileError);
  if (!resume) clear_run(folder);
  write_record(root, plan, run);
  Scene scene = run.scene;
  if (run.source >= 0) scene.start_up.from = root + "/" + plan.runs[run.source].folder;
  io::write_text_file(folder + "/scene.json", write_resolved(scene));
  const std::vector<std::string> words{
      "run", folder + "/scene.json", "--out", folder, "--threads", std::to_string(options.threads),
      "--progress", "json", "--checkpoint-every", fmt::format("{} s", options.checkpoint_every_s),
      // nothing of an earlier run is left, but a killed process may have got as far as its log
      resume ? "--resume" : "--overwrite"};
  std::error_code ignored;
  fs::remove(folder + "/progress.txt", ignored);
  fs::remove(folder + "/output.txt", ignored);
  const ChildOptions child{.output = folder + "/output.txt",
                           .progress = folder + "/progress.txt",
                           .follows_parent = true};
  return {index, std::move(claim), Child(words, child), folder};
}

RunProgress parse_progress(const std::string& line) {
  RunProgress progress;
  const auto j = parse_or_discard<nlohmann::json>(line);
  const auto number = [&](const char* key) -> std::optional<double> {
    if (!j.is_object() || !j.contains(key) || !j[key].is_number()) return std::nullopt;
    return j[key].get<double>();
  };
  progress.wall_s = number("wall_s").value_or(0);
  progress.printed = number("wall_s").value_or(-1) >= 0;
  progress.time_s = number("time_s").value_or(0);
  progress.end_s = number("end_s").value_or(0);
  progress.left_s = number("eta_s");
  progress.phase = text_at(j, "phase");
  progress.dcm = static_cast<int>(std::clamp(number("dcm").value_or(0), 0.0, kMostCells));
  progress.cbm = static_cast<int>(std::clamp(number("cbm").value_or(0), 0.0, kMostCells));
  progress.starting = progress.phase != "running";
  return progress;
}

std::string take_progress_line(const std::string& file) {
  constexpr std::uintmax_t kMostProgressBytes = 1 << 16;  // bytes
  std::string line = last_line(file);
  std::error_code code;
  const std::uintmax_t size = fs::file_size(file, code);
  if (!code && size > kMostProgressBytes) fs::resize_file(file, 0, code);  // the run appends
  return line;
}

RunProgress read_progress(const ActiveRun& run) {
  return parse_progress(take_progress_line(run.folder + "/progress.txt"));
}

std::string last_line(const std::string& file) {
  std::error_code code;
  if (!fs::is_regular_file(file, code)) return {};
  std::string text = io::read_text_file(file);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t before = text.find_last_of('\n');
  return before == std::string::npos ? text : text.substr(before + 1);
}

std::string printed_cause(const std::string& file) {
  constexpr std::size_t kMostCauseBytes = 4000;  // bytes; what comes first is nearest to the cause
  std::error_code code;
  if (!fs::is_regular_file(file, code)) return {};
  std::istringstream text(io::read_text_file(file));
  std::string cause;
  for (std::string line; std::getline(text, line);)
    if (!line.starts_with("acinus: warning: "))
      cause += (cause.empty() || line.empty() ? "" : "\n") + line;
  if (cause.size() > kMostCauseBytes)
    cause = cause.substr(0, kMostCauseBytes) + " ... (all of it: " + file + ")";
  return cause;
}

}  // namespace acinus::runs
