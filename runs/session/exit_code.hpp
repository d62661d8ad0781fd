#pragma once
/// Exceptions as messages and exit codes.

#include <functional>

namespace acinus::runs {

/// Runs a function and turns any exception into a message on stderr and an exit code.
/// @param work  returns an exit code
int exit_code_of(const std::function<int()>& work);

}  // namespace acinus::runs
