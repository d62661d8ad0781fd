#pragma once
/// Files as disks, editors and transfers damage them, or as somebody who means harm writes them.

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace acinus::fuzz {

/// Bytes of all files of a folder, sorted by name; nothing if there is no such folder.
std::vector<std::string> read_folder(const std::string& folder);

/// Valid files of a target, and what once went wrong with its reader.
/// @param folder  for the valid ones
std::vector<std::string> make_corpus(const std::string& target, const std::string& folder);

/// One file of the corpus with one to four changes: bits flipped and binary numbers overwritten in
/// place, or bytes cut out, doubled, taken from another file and numbers in the text replaced by
/// invalid or extreme ones.
std::string mutate(const std::vector<std::string>& corpus, std::mt19937_64& random);

}  // namespace acinus::fuzz
