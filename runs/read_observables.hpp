#pragma once
/// What a run measured over time, also while it still goes on.

#include <map>
#include <string>

#include "core/io/observable_rows.hpp"

namespace acinus::runs {

/// The group /observables of run.vtkhdf. Runs without it: the measures of summary.json (of the
/// checkpoint while there is none), with the unit at the end of their name taken off, and the
/// columns of /series at the times of the frames. There a value that does not exist is NaN.
/// @return empty if nothing was written yet
/// @throws Error(kFileError) for files that cannot be read
io::ObservableRows read_observables(const std::string& run_folder);

/// "lesion_radius_um" -> "lesion_radius", "um"; unit "1" if the name has none at its end.
std::pair<std::string, std::string> split_unit(const std::string& measure);

}  // namespace acinus::runs
