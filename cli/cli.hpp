#pragma once
/// The command line.

#include <string>

namespace acinus::runs {

/// Parses the command line and does what it says.
/// @return the process exit code; 2 for a command line that makes no sense
/// @throws Error for everything else that is the user's or the disk's fault
int run_cli(int argc, const char* const* argv);

/// Version, git hash, compiler.
std::string version_text();

}  // namespace acinus::runs
