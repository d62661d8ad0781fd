#include "service/report/make_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "acinus_version.hpp"
#include "core/error.hpp"
#include "io/disk.hpp"
#include "runs/scene/json_text.hpp"
#include "service/report/other_parts.hpp"
#include "service/report/page.hpp"
#include "service/report/picture.hpp"
#include "service/report/run_part.hpp"

namespace acinus::service {
namespace fs = std::filesystem;
namespace {

using OrderedJson = nlohmann::ordered_json;

enum class ItemKind { kRun, kLaw, kStudy };

ItemKind kind_of(const std::string& path) {
  std::error_code code;
  check(fs::exists(path, code), fmt::format("{}: there is no such file or folder", path),
        Exit::kFileError);
  const auto has = [&](const char* name) { return fs::exists(fs::path(path) / name, code); };
  if (!fs::is_directory(path, code)) return ItemKind::kLaw;
  if (has("run.vtkhdf") || has("summary.json")) return ItemKind::kRun;
  if (has("study.json")) return ItemKind::kStudy;
  if (has("law.json")) return ItemKind::kLaw;
  throw Error(
      fmt::format("{}: is no run (it has no run.vtkhdf), no study (no study.json) and no "
                  "calibration (no law.json). Name a folder that `acinus run`, `acinus "
                  "study` or `acinus calibrate` wrote, or a law file.",
                  path));
}

/// Default name of the report, in the working directory: "lobule.html" for "lobule.run".
std::string file_named_after(const std::string& first) {
  fs::path name = fs::path(first).lexically_normal();
  if (!name.has_filename()) name = name.parent_path();
  name = name.filename();
  for (const char* ending : {".run", ".study", ".calibration", ".json"})
    if (name.extension() == ending) name = name.stem();
  return name.string() + ".html";
}

/// Path of a folder relative to that of the page, for links.
std::string path_from_page(const std::string& folder, const std::string& page) {
  const fs::path from = fs::absolute(page).lexically_normal().parent_path();
  fs::path to = fs::absolute(folder).lexically_normal();
  return to.lexically_relative(from).generic_string();
}

/// Names items of equal name by their whole path.
void distinguish_names(OrderedJson& items) {
  std::map<std::string, int> count;
  for (const OrderedJson& item : items) ++count[item["name"].get<std::string>()];
  for (OrderedJson& item : items)
    if (count[item["name"].get<std::string>()] > 1) item["name"] = item["folder"];
}

}  // namespace

std::string write_report(const ReportOptions& options) {
  std::vector<std::string> folders;
  for (const std::string& path : options.what)
    if (kind_of(path) == ItemKind::kRun) folders.push_back(path);
  check(!folders.empty() || (!options.most_frames && !options.bytes),
        "--frames and --limit are for runs, and none is named. Leave them out.");
  const std::string out = options.out.empty() ? file_named_after(options.what[0]) : options.out;
  const std::size_t page = empty_page_size(), bytes = options.bytes.value_or(8'000'000);
  check(bytes > page + 100'000,
        fmt::format("--limit: the page without data takes {:.1f} MB. Allow more.", 1e-6 * page));
  FrameLimits limits{.most_frames = options.most_frames.value_or(50)};
  // Curves, tables and texts take about a tenth.
  limits.bytes = (bytes - page) * 9 / 10 / std::max<std::size_t>(1, folders.size());
  OrderedJson data{{"version", ACINUS_VERSION}, {"limit", bytes}, {"items", OrderedJson::array()}};
  for (const std::string& path : options.what) {
    switch (kind_of(path)) {
      case ItemKind::kRun: {
        RunRecord run = read_run_record(path);
        data["items"].push_back(describe_run(run, limits));
        break;
      }
      case ItemKind::kLaw:
        data["items"].push_back(describe_law(path));
        break;
      case ItemKind::kStudy:
        data["items"].push_back(describe_study(path));
        data["items"].back()["path"] = path_from_page(path, out);
    }
  }
  if (folders.size() > 1) data["comparison"] = describe_comparison(folders);
  distinguish_names(data["items"]);
  check(options.titles.size() <= options.what.size(),
        fmt::format("--title: {} headlines for {} of what is shown. Leave some out.",
                    options.titles.size(), options.what.size()));
  for (std::size_t k = 0; k < options.titles.size(); ++k)
    data["items"][k]["name"] = options.titles[k];
  std::string title = data["items"][0]["name"].get<std::string>();
  if (options.what.size() > 1) title += fmt::format(" and {} more", options.what.size() - 1);
  io::write_text_file(out,
                      write_page(runs::as_utf8(title),
                                 data.dump(-1, ' ', false, OrderedJson::error_handler_t::replace)));
  if (!options.png.empty()) take_picture(out, options.png);
  return out;
}

}  // namespace acinus::service
