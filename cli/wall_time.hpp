#pragma once
/// Wall times on the command line.

#include <CLI/CLI.hpp>
#include <string>

namespace acinus::cli {

/// Wall time such as "10min", "23h30m", "600 s" or "1d", s. Here m means minutes.
/// @throws Error naming the text
double parse_wall_time(const std::string& text);

/// Adds the flag --max-walltime.
void add_wall_time_limit(
    CLI::App& command, std::string& text,
    const char* help = "stop after this wall time, e.g. 23h30m, with a checkpoint to go on from");
/// Value of --max-walltime, s; infinite if it was not given.
/// @throws Error naming the flag
double read_wall_time_limit(const std::string& text);

}  // namespace acinus::cli
