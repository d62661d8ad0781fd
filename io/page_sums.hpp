#pragma once
/// Checksums of a file's pages, kept beside it in `<path>.sums`: they reveal any bytes other than
/// those written. HDF5 itself checks compressed arrays only; its own indices, texts and small
/// tables it trusts, and follows their addresses.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/journal.hpp"

namespace acinus::io::h5 {

/// Path of the sums: `<path>.sums`.
std::string sums_of(const std::string& path);

/// True if a file has bytes other than those that were written. Reads all of it.
bool is_damaged(const std::string& path);

class PageSums {
 public:
  /// Reads the sums of a file that exists; without a file of sums every page passes.
  static PageSums read(const std::string& path);
  /// Removes the sums of a file that is replaced.
  static void remove(const std::string& path);

  /// Bytes of the file that the sums cover; later bytes were never committed.
  std::uint64_t end() const { return end_; }
  /// Number of covered bytes of a page.
  std::uint64_t size_of(std::uint64_t page) const;
  /// True if an open file has the bytes of a page that were written. False, with errno set, also if
  /// it cannot be read or ends before.
  bool is_as_written(int descriptor, std::uint64_t page) const;
  /// End of the reliable pages. The last page of a session that was killed while it replaced pages
  /// may be new or old.
  std::uint64_t covered_end(const Journal& pending) const;

  void set_end(std::uint64_t end);
  void set(std::uint64_t page, std::span<const std::byte> content);
  /// Writes the changed sums. Returns false with errno set when the disk refuses.
  bool write(const std::string& path);

 private:
  bool matches(std::uint64_t page, std::span<const std::byte> content) const;

  std::uint64_t end_ = 0;
  /// [page] sums of whole pages. Each entry holds its sum twice, once inverted, so that a damaged
  /// entry is recognised.
  std::vector<std::uint64_t> entry_;
  std::uint64_t tail_ = 0;  ///< sum of the page in which the file ends; changes together with end_
  std::uint64_t first_changed_ = 0, last_changed_ = 0;  ///< entries [first, last)
};

}  // namespace acinus::io::h5
