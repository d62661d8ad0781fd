#pragma once
/// Reader of run files, for reports, comparisons and tests. Works while the run is still going on.

#include <map>
#include <string>
#include <vector>

#include "io/frame.hpp"
#include "io/run_layout.hpp"

namespace acinus::io {

/// Finished content of a run file at the time of opening. Errors: Error(kFileError).
class RunReader {
 public:
  explicit RunReader(const std::string& path);

  const RunFileCounts& counts() const { return counts_; }
  int n_frame() const { return static_cast<int>(frame_.size()); }
  double time_s(int k) const;
  /// Frame k with its fields and tables sorted by name.
  Frame frame(int k) const;
  /// Rows of /cells of frame k alone.
  Table cells(int k) const;
  /// Series by name, [n_row] values each.
  std::map<std::string, std::vector<double>> series() const;
  /// Observables by name; empty where a file has none.
  std::map<std::string, std::vector<double>> observables() const;
  std::map<std::string, std::string> observable_unit() const;
  std::vector<Event> events() const;
  std::map<std::string, std::string> provenance() const;

 private:
  const FrameIndex& index(int k) const;

  std::string path_;
  RunFileCounts counts_;
  RunLayout layout_;
  std::vector<FrameIndex> frame_;
};

}  // namespace acinus::io
