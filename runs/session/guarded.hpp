#pragma once
/// Isolation of work on untrusted files in a child process: parsing libraries may crash on
/// malformed ones.

#include <functional>
#include <string>

namespace acinus::runs {

/// Does the work in a child process, to which signals are forwarded.
/// @param files  files to be read, for messages
/// @param work   returns an exit code; an Error it throws is printed and gives its code
/// @return exit code of the work
/// @throws Error(kFileError) if the child crashed
int run_guarded(const std::string& files, const std::function<int()>& work);

}  // namespace acinus::runs
