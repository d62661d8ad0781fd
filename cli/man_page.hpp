#pragma once
/// Manual page of the program, from its commands.

#include <CLI/CLI.hpp>
#include <string>

namespace acinus::cli {

/// Manual page in section 1 as roff source, for `man`: every command with its arguments, options
/// and example.
/// @param version  for the foot of the page
std::string man_page(const CLI::App& app, const std::string& version);

}  // namespace acinus::cli
