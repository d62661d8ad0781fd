#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "core/error.hpp"
#include "io/inside.hpp"
#include "runs/scene/bounded_json.hpp"
#include "runs/session/shell_quote.hpp"
#include "service/report/other_parts.hpp"

namespace acinus::service {
namespace fs = std::filesystem;
namespace {

using OrderedJson = nlohmann::ordered_json;

/// Removes and returns the first field of a CSV line, with quotes as in RFC 4180.
std::string take_field(std::istringstream& line) {
  std::string field;
  if (line.peek() != '"') {
    std::getline(line, field, ',');
    return field;
  }
  line.get();
  for (int c = line.get(); c != EOF; c = line.get()) {
    if (c == '"' && line.peek() != '"') break;
    if (c == '"') line.get();
    field += static_cast<char>(c);
  }
  if (line.peek() == ',') line.get();
  return field;
}

/// Rows of a CSV file, the header first.
OrderedJson read_csv(const std::string& folder, const std::string& name) {
  OrderedJson rows = OrderedJson::array();
  std::istringstream text(io::read_text_inside(folder, name));
  for (std::string line; std::getline(text, line);) {
    std::istringstream in(line);
    OrderedJson row = OrderedJson::array();
    while (in && in.peek() != EOF) row.push_back(take_field(in));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Folder of a run as `acinus study` names it: "runs/slow/cycle=20_h/seed_1".
std::string folder_of_run(std::string name) {
  constexpr std::string_view kOther = "_-+.=/";
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 &&
        kOther.find(c) == std::string_view::npos)
      c = '_';
  return "runs/" + name;
}

/// Links to the runs of runs.csv, relative to the study: their report page, else their folder, null
/// for one that is not there.
OrderedJson list_links(const std::string& folder, const OrderedJson& runs) {
  OrderedJson links = OrderedJson::array();
  std::error_code code;
  for (std::size_t k = 1; k < runs.size(); ++k) {
    const std::string of_run =
        folder_of_run(runs[k].empty() ? std::string() : runs[k][0].get<std::string>());
    const bool inside = of_run.find("..") == std::string::npos;
    if (inside && io::is_file_inside(folder, of_run + "/report.html"))
      links.push_back(of_run + "/report.html");
    else if (inside && fs::is_directory(fs::path(folder) / of_run, code) &&
             io::is_folder_inside(folder, of_run))
      links.push_back(of_run + "/");
    else
      links.push_back(nullptr);
  }
  return links;
}

}  // namespace

OrderedJson describe_study(const std::string& folder) {
  const fs::path root = folder;
  std::error_code code;
  check(fs::exists(root / "runs.csv", code),
        fmt::format(
            "{}: is a study without results. `acinus study FILE --out {} --report` writes them.",
            folder, runs::quote_for_shell(folder)),
        Exit::kFileError);
  OrderedJson j{
      {"type", "study"}, {"name", root.lexically_normal().filename().string()}, {"folder", folder}};
  j["runs"] = read_csv(folder, "runs.csv");
  j["links"] = list_links(folder, j["runs"]);
  if (io::is_file_inside(folder, "report.md"))
    j["text"] = io::read_text_inside(folder, "report.md");
  j["verdicts"] = OrderedJson::array();
  if (fs::exists(root / "verdicts.json", code))
    j["verdicts"] =
        runs::parse_or_discard<OrderedJson>(io::read_text_inside(folder, "verdicts.json"));
  std::vector<fs::path> plots;
  if (io::is_folder_inside(folder, "plots"))
    for (const fs::directory_entry& entry : fs::directory_iterator(root / "plots", code))
      if (entry.path().extension() == ".svg") plots.push_back(entry.path());
  std::ranges::sort(plots);
  j["plots"] = OrderedJson::array();
  for (const fs::path& plot : plots)
    j["plots"].push_back(
        {{"name", plot.stem().string()},
         {"svg", io::read_text_inside(folder, "plots/" + plot.filename().string())}});
  return j;
}

}  // namespace acinus::service
