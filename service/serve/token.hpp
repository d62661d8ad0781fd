#pragma once
/// Access token of the service: generation, storage and comparison.

#include <string>

namespace acinus::service {

/// New token: 32 hexadecimal digits from the system's random generator.
/// @throws Error(kFileError)
std::string make_token();

/// Token in a file; creates the file, readable by its owner only, if it is missing.
/// @throws Error(kBadInput) for a file that others made or could have written; kFileError
std::string keep_token(const std::string& file);

/// True if two texts are equal, in a time independent of where they differ.
bool same_secret(const std::string& a, const std::string& b);

}  // namespace acinus::service
