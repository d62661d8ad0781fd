#pragma once
/// Very many changed files, read by a process that may die of them.

#include <cstdint>
#include <string>

#include "tests/fuzz/targets.hpp"

namespace acinus::fuzz {

/// Ends this process by a signal when what follows takes too long: ten seconds of processor time,
/// or a minute in all. Counted anew by each call.
void watch_for_hangs();

/// Reads N changed files of a target and prints how many were accepted, refused or ended the
/// process that read them, the longest time of a processor and the most memory. Inputs that did
/// harm are kept in `fuzz_found`, each with what was printed.
/// @return exit code, 1 if any did: a reader's crash, one of its library where the program does not
///         read in a process of its own, ten seconds, more than 1 GB, an accepted file that means
///         nothing
int run_campaign(const Target& target, std::uint64_t n, std::uint64_t seed);

}  // namespace acinus::fuzz
