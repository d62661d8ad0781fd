#pragma once
/// The pages a session is about to overwrite in an older part of a file, written down beside it
/// first. Whoever opens the file after a kill in the middle of the overwriting finds them there:
/// a writer puts them in place, a reader reads them instead of the file's.

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
  std::uint64_t end = 0;  ///< the bytes of a page from here on are not meant
  Pages page;
};

/// `<path>.journal`
std::string journal_of(const std::string& path);

/// Returns false, with errno set and nothing left behind, when the disk refuses.
bool write_journal(const std::string& path, const Journal& journal);

/// No pages when there is no journal or it is not complete: the file itself is then untouched.
Journal read_journal(const std::string& path);

/// Checks the pages of a journal against the size of the file: none may lie far beyond its end.
bool is_possible(const Journal& journal, std::uint64_t file_size);

/// Does nothing when there is none.
void remove_journal(const std::string& path);

}  // namespace acinus::io::h5
