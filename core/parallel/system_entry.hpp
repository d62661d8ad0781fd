#pragma once
/// Entries of the text files in which the system describes itself.

#include <string>
#include <string_view>

namespace acinus {

/// First value of "key : value" in a text file of the system; empty if there is none.
std::string read_system_entry(const char* path, std::string_view key);

}  // namespace acinus
