#pragma once
/// Command line of the program acinus.

#include <string>

namespace acinus::cli {

/// Parses the command line and runs its command.
/// @return exit code; 2 for an invalid command line
/// @throws Error for other faults of the user and the disk
int run_cli(int argc, const char* const* argv);

/// Version, git hash and compiler of this program.
std::string version_text();

}  // namespace acinus::cli
