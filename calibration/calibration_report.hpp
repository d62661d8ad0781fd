#pragma once
/// Results of a calibration as a table, curves and plots.

#include <string>

#include "calibration/calibrate.hpp"

namespace acinus::calibration {

/// Table that `acinus calibrate` prints.
std::string calibration_table(const Calibration& found);

/// Writes curves.json, force.svg and relaxation.svg into the folder.   @throws Error(kFileError)
void write_curves(const Calibration& found, const std::string& folder);

}  // namespace acinus::calibration
