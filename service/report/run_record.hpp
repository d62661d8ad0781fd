#pragma once
/// Readable content of a run folder, also of a run in progress, killed or damaged.

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/field_file.hpp"
#include "io/run_reader.hpp"

namespace acinus::service {

/// Content of a run folder and the faults met while reading it.
struct RunRecord {
  std::string folder;
  std::string summary;                            ///< text of summary.json; "" = none
  std::optional<io::RunReader> reader;            ///< empty if run.vtkhdf cannot be opened
  std::map<std::string, std::string> provenance;  ///< of the run file
  std::map<std::string, std::vector<double>> series, observables;
  std::map<std::string, std::string> observable_unit;
  std::vector<io::Event> events;
  bool going_on = false;            ///< a process writes in the folder
  std::vector<std::string> damage;  ///< read faults, with causes
  int n_frame() const { return reader ? reader->n_frame() : 0; }
};

/// Reads a run folder as far as possible.
/// @throws Error(kFileError) if it has neither a run file nor a summary
RunRecord read_run_record(const std::string& folder);

/// Reads a frame, or only its cell table; empty, with a line in `damage`, if it is unreadable.
std::optional<io::Frame> read_frame(RunRecord& run, int frame);
std::optional<io::Table> read_cell_table(RunRecord& run, int frame);

/// Reads the fields of substances of a frame; empty if it has none, and with a line in `damage` if
/// they are unreadable or of another time.
std::optional<io::FieldFrame> read_fields(RunRecord& run, int frame, double time_s);

/// Runs a read operation and records its failure in `damage`, once.
/// @return true if it succeeded
bool attempt(RunRecord& run, const std::string& what, const std::function<void()>& read);

/// Column of a table by name; empty if there is none.
std::vector<double> table_column(const io::Table& table, const std::string& name);

}  // namespace acinus::service
