#pragma once
/// Quoting of commands for the shell.

#include <string>

namespace acinus::runs {

/// Quotes a word for the shell if it needs quotes. Control characters and bytes that are not UTF-8
/// become escapes of $'...', so that the result is one line of text.
std::string quote_for_shell(const std::string& word);

}  // namespace acinus::runs
