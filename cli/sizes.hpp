#pragma once
/// Memory and file sizes on the command line.

#include <string>

namespace acinus::cli {

/// Bytes of a size such as "16GB" or "500 MB".
/// @throws Error
double parse_size(const std::string& text);

}  // namespace acinus::cli
