#pragma once
/// Commands that users can copy into their shell.

#include <string>

namespace acinus::runs {

/// The word as a shell takes it: in quotes where it has anything that shells read otherwise.
/// Control characters and bytes that are not UTF-8 become escapes of $'...', so that the result is
/// one line of text.
std::string quote_for_shell(const std::string& word);

}  // namespace acinus::runs
