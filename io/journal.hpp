#pragma once
/// Write-ahead journal: the new content of older pages of a file, stored beside it before they are
/// overwritten. After a kill in the middle of the overwriting, a writer copies them into the file,
/// and a reader reads them instead of the file's.

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace acinus::io::h5 {

inline constexpr std::uint64_t kPage = 4096;
using Page = std::array<std::byte, kPage>;
using Pages = std::map<std::uint64_t, Page>;  ///< page index -> content

struct Journal {
  std::uint64_t end = 0;  ///< bytes of a page from here on are unused
  Pages page;
};

/// Path of the journal: `<path>.journal`.
std::string journal_of(const std::string& path);

/// Writes a journal. Returns false, with errno set and no file left, when the disk refuses.
bool write_journal(const std::string& path, const Journal& journal);

/// Reads a journal. No pages when there is none or it is not complete: the file itself is then
/// untouched.
Journal read_journal(const std::string& path);

/// Checks the pages of a journal against the size of the file: none may lie far beyond its end.
bool is_possible(const Journal& journal, std::uint64_t file_size);

/// Removes the journal if there is one.
void remove_journal(const std::string& path);

}  // namespace acinus::io::h5
