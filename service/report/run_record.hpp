#pragma once
/// What can be read of a run folder: also of one that is still written, was killed or is damaged.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/run_reader.hpp"

namespace acinus::runs {

struct RunRecord {
  std::string folder;
  std::string summary;                            ///< text of summary.json; "" = none
  std::optional<io::RunReader> reader;            ///< nothing if run.vtkhdf cannot be opened
  std::map<std::string, std::string> provenance;  ///< of the run file
  std::map<std::string, std::vector<double>> series, observables;
  std::map<std::string, std::string> observable_unit;
  std::vector<io::Event> events;
  bool going_on = false;            ///< a process writes in the folder
  std::vector<std::string> damage;  ///< what could not be read, and why
  int n_frame() const { return reader ? reader->n_frame() : 0; }
};

/// @throws Error(kFileError) if the folder has neither a run file nor a summary
RunRecord read_run_record(const std::string& folder);

/// A frame, or only its table of cells; nothing, and a line in `damage`, where it cannot be read.
std::optional<io::Frame> read_frame(RunRecord& run, int frame);
std::optional<io::Table> read_cell_table(RunRecord& run, int frame);

/// A column of a table as numbers, by its name; empty if it has none.
std::vector<double> table_column(const io::Table& table, const std::string& name);

}  // namespace acinus::runs
