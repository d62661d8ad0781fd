#pragma once
/// Self-contained page about runs, laws and studies (`acinus report`).

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace acinus::service {

/// Options of `acinus report`.
struct ReportOptions {
  std::vector<std::string> what;          ///< run folders, law files, study folders
  std::string out = "";                   ///< HTML file; "" = named after the first
  std::string png = "";                   ///< screenshot of the page; "" = none
  std::vector<std::string> titles = {};   ///< of the first ones; without: their file names
  std::optional<int> most_frames = {};    ///< most frames per run; empty = 50
  std::optional<std::size_t> bytes = {};  ///< most bytes of the page; empty = 8 MB
};

/// Writes the report.
/// @return path of the HTML file
/// @throws Error for an input that is no run, law or study; kFileError for unreadable or unwritable
/// files, or if no browser is found for the screenshot
std::string write_report(const ReportOptions& options);

}  // namespace acinus::service
