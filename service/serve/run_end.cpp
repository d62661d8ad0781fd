#include "service/serve/run_end.hpp"

#include "core/error.hpp"
#include "runs/study/active_run.hpp"

namespace acinus::service {

std::string output_file(const std::string& folder) { return folder + "/output.txt"; }

std::string printed_messages(const std::string& folder) {
  std::string cause = runs::printed_cause(output_file(folder));
  if (cause.starts_with("acinus: ")) cause.erase(0, 8);
  return cause;
}

std::optional<runs::RunSummary> find_summary(const std::string& folder, FileTime since) {
  namespace fs = std::filesystem;
  const std::string file = folder + "/summary.json";
  std::error_code code;
  if (!fs::exists(file, code) || fs::last_write_time(file, code) < since || code)
    return std::nullopt;
  try {
    return runs::read_summary(folder);
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::string find_stop_cause(const std::string& folder, FileTime since) {
  const std::optional<runs::RunSummary> summary = find_summary(folder, since);
  if (summary && !summary->cause.empty()) return summary->cause + ", by the limits of this service";
  return printed_messages(folder);
}

}  // namespace acinus::service
