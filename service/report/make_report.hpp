#pragma once
/// `acinus report`: one page that shows runs, laws and studies without a network.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace acinus::runs {

struct ReportOptions {
  std::vector<std::string> what;          ///< run folders, law files, study folders
  std::string out = "";                   ///< HTML file; "" = named after the first
  std::string png = "";                   ///< picture of the page; "" = none
  std::string title = "";                 ///< of the first; "" = its file name
  std::optional<int> most_frames = {};    ///< of a run; empty = 50
  std::optional<std::size_t> bytes = {};  ///< of the page; empty = 8 MB
};

/// @return the HTML file
/// @throws Error: what is no run, law or study; kFileError where files cannot be read or written,
/// or no browser is found for the picture
std::string write_report(const ReportOptions& options);

}  // namespace acinus::runs
