#pragma once
/// `acinus report`: one page that shows runs, laws and studies without a network.

#include <cstddef>
#include <string>
#include <vector>

namespace acinus::runs {

struct ReportOptions {
  std::vector<std::string> what;  ///< run folders, law files, study folders
  std::string out = "";           ///< HTML file; "" = named after the first
  std::string png = "";           ///< picture of the page; "" = none
  std::string title = "";         ///< of the first; "" = its file name
  int most_frames = 50;
  std::size_t bytes = 8'000'000;  ///< of the page
};

/// @return the HTML file
/// @throws Error: what is no run, law or study; kFileError where files cannot be read or written,
/// or no browser is found for the picture
std::string write_report(const ReportOptions& options);

}  // namespace acinus::runs
