#include "bench/output/result_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/disk.hpp"

namespace acinus::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHeader =
    "command,case,figure,value,unit,commit,machine,instruction set,threads,date";

/// Units as figures spell them and as result files do.
constexpr std::array<std::pair<std::string_view, std::string_view>, 17> kUnits{{{"s", "s"},
                                                                                {"ms", "ms"},
                                                                                {"us", "us"},
                                                                                {"h", "h"},
                                                                                {"nm", "nm"},
                                                                                {"um", "um"},
                                                                                {"um2", "um^2"},
                                                                                {"um3", "um^3"},
                                                                                {"Pa", "Pa"},
                                                                                {"kPa", "kPa"},
                                                                                {"nN", "nN"},
                                                                                {"KB", "KB"},
                                                                                {"kB", "kB"},
                                                                                {"MB", "MB"},
                                                                                {"GB", "GB"},
                                                                                {"bytes", "bytes"},
                                                                                {"percent", "%"}}};

std::vector<std::string_view> split(std::string_view text, char mark) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(mark);
    parts.push_back(text.substr(0, end));
    if (end == text.npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// Unit of a word, "" if it is none.
std::string_view unit_of_word(std::string_view word) {
  const auto* const found =
      std::ranges::find(kUnits, word, &std::pair<std::string_view, std::string_view>::first);
  return found == kUnits.end() ? "" : found->second;
}

/// CSV field: in quotes where it holds a comma, a quote or a line break.
std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == text.npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

/// File name for a machine: small letters and digits, all else as single underscores.
std::string name_for_file(std::string_view machine) {
  std::string out;
  for (const char c : machine) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0)
      out += static_cast<char>(std::tolower(byte));
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.empty() ? "unknown" : out;
}

/// Appends a text in one piece.
void append_text(const std::string& file, const std::string& text) {
  errno = 0;
  std::ofstream out(file, std::ios::app | std::ios::binary);
  out << text;
  out.close();
  if (!out.good()) io::fail_on_disk(file, "append to", errno);
}

std::string first_line(const std::string& text) {
  std::string line = text.substr(0, text.find('\n'));
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

}  // namespace

std::string describe_command(const std::string& name, const BenchOptions& options, int threads) {
  const BenchOptions usual;
  std::string out = fmt::format("acinus bench {} --threads {}", name, threads);
  if (options.seeds != usual.seeds) out += fmt::format(" --seeds {}", options.seeds);
  if (options.first != usual.first) out += fmt::format(" --first {}", options.first);
  if (options.life) out += " --life";
  if (!options.law.empty()) out += " --law " + options.law;
  if (options.radius != usual.radius) out += fmt::format(" --radius {:g}", options.radius);
  if (options.stiffness != usual.stiffness)
    out += fmt::format(" --stiffness {:g}", options.stiffness);
  return out;
}

std::string unit_of_figure(std::string_view figure) {
  if (figure.ends_with("_mN_m")) return "mN/m";
  const std::vector<std::string_view> word = split(figure, '_');
  if (std::ranges::find(word, "over") != word.end()) return "";  // a ratio
  const auto per = std::ranges::find(word, "per");
  if (word.end() - per != 2) {  // of a last word that is no denominator
    const std::string_view unit = unit_of_word(word.back());
    if (!unit.empty()) return std::string(unit);
  }
  return per == word.end() || per == word.begin() ? "" : std::string(unit_of_word(*(per - 1)));
}

std::string prepare_result_file(const std::string& path, const ResultOrigin& origin) {
  std::error_code ignored;  // opening the file reports it
  const std::string file =
      fs::is_directory(path, ignored)
          ? (fs::path(path) / fmt::format("{}_{}.csv", origin.date, name_for_file(origin.machine)))
                .string()
          : path;
  if (!fs::is_regular_file(file, ignored) || fs::file_size(file, ignored) == 0) {
    append_text(file, fmt::format("{}\n", kHeader));
    return file;
  }
  const std::string text = io::read_text_file(file);
  check(first_line(text) == kHeader,
        fmt::format("{}:1: \"{}\" is not the header of a result file, \"{}\". Choose another file.",
                    file, first_line(text).substr(0, 100), kHeader));
  append_text(file, text.back() == '\n' ? "" : "\n");  // ends a torn line
  return file;
}

void append_results(const std::string& file, const ResultOrigin& origin, const BenchTable& table) {
  const std::string end =
      fmt::format("{},{},{},{},{}\n", csv_field(origin.commit), csv_field(origin.machine),
                  csv_field(origin.instruction_set), origin.threads, origin.date);
  std::string text;
  for (const BenchRow& row : table) {
    const std::string start = csv_field(origin.command) + ',' + csv_field(row.name);
    if (row.cells > 0) text += fmt::format("{},cells,{},,{}", start, row.cells, end);
    for (const auto& [figure, value] : row.value)
      text += fmt::format("{},{},{:.10g},{},{}", start, csv_field(figure), value,
                          unit_of_figure(figure), end);
  }
  append_text(file, text);
}

}  // namespace acinus::bench
