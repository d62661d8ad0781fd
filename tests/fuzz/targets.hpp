#pragma once
/// Readers of files that others wrote, changed or damaged. With any content each reader ends with a
/// result or with an Error that has a message; all else is a fault.

#include <span>
#include <string>
#include <vector>

namespace acinus::fuzz {

struct Target {
  std::string name;
  std::vector<std::string> endings;  ///< of the file; a reader may choose its format by them
  /// Reads the file and checks that the result means something. @throws Error on bad content;
  /// anything else is a fault
  void (*read)(const std::string& path);
  /// Valid files to begin with, written into a folder.
  void (*write_seeds)(const std::string& folder);
  /// True if the program reads it in a process of its own, since its library crashes on some bytes.
  bool guarded = false;
};

std::span<const Target> targets();

/// Throws std::invalid_argument naming those that are known.
const Target& find_target(const std::string& name);

/// Writes bytes as a file of each ending into the folder and reads it.
/// @return whether it was accepted, with one ending at least
bool try_bytes(const Target& target, const std::string& folder, std::span<const char> bytes);

}  // namespace acinus::fuzz
