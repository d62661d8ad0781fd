#pragma once
/// The secret by which the service knows its user: made, kept in a file, compared.

#include <string>

namespace acinus::runs {

/// 32 hexadecimal digits from the system's generator.   @throws Error(kFileError)
std::string make_token();

/// The token that stands in a file; a new one, readable by its owner only, where there is none.
/// @throws Error(kBadInput) for a file that others made, or could have written; kFileError
std::string keep_token(const std::string& file);

/// Whether two texts are the same, in a time that does not tell where they differ.
bool same_secret(const std::string& a, const std::string& b);

}  // namespace acinus::runs
