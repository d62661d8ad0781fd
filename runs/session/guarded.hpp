#pragma once
/// Work on files of strangers in a process of its own: libraries that read them may crash on what
/// no program wrote.

#include <functional>
#include <string>

namespace acinus::runs {

/// Does the work in a child of this process, to which signals are passed on.
/// @param files  what is read, for the message
/// @param work   returns an exit code; an Error that it throws is printed and gives its code
/// @return its exit code
/// @throws Error(kFileError) if a fault of the process ended it
int run_guarded(const std::string& files, const std::function<int()>& work);

}  // namespace acinus::runs
