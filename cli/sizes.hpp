#pragma once
/// Sizes on the command line.

#include <string>

namespace acinus::runs {

/// Bytes of "16GB", "500 MB".   @throws Error
double parse_size(const std::string& text);

}  // namespace acinus::runs
