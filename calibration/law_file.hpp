#pragma once
/// Law files: JSON that a scene names in `stiffness_correction`.

#include <string>

#include "calibration/law.hpp"

namespace acinus::calibration {

inline constexpr int kLawSchema = 4;

/// Number of the way in which laws are found. Laws kept from another way are found anew.
inline constexpr int kLawMethod = 3;

/// Law as JSON text. Throws Error when a number is not finite: no NaN ever reaches a file.
std::string law_text(const Law& law);

/// Writes a law file, all or nothing. Throws Error(kFileError).
void write_law(const Law& law, const std::string& path);

/// Reads a law file. Throws Error naming the file, the key, the value found and the values allowed:
/// a file that cannot be read or is no JSON, another schema version, keys that are missing or of
/// the wrong kind, numbers out of their range, or a hash that shows that the numbers were edited.
Law read_law(const std::string& path);

}  // namespace acinus::calibration
