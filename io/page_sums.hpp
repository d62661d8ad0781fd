#pragma once
/// Checksums of a file's pages, kept beside it in `<path>.sums`: whoever reads bytes that are not
/// the ones written is told, whatever changed them. HDF5 itself checks compressed arrays only; its
/// own indices, texts and small tables it takes as they are, and follows where they point.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/journal.hpp"

namespace acinus::io::h5 {

/// `<path>.sums`
std::string sums_of(const std::string& path);

/// Whether a file has bytes that are not those that were written. Reads all of it.
bool is_damaged(const std::string& path);

class PageSums {
 public:
  /// Of a file that exists; without a file of sums nothing is known and every page passes.
  static PageSums read(const std::string& path);
  /// Removes what is kept for a file that is replaced.
  static void remove(const std::string& path);

  /// Bytes of the file that the sums cover; what stands behind them was never made part of it.
  std::uint64_t end() const { return end_; }
  /// How many bytes of a page are covered.
  std::uint64_t size_of(std::uint64_t page) const;
  /// Whether an open file holds the bytes of a page that were written. False, with errno set, too
  /// where it cannot be read or ends before.
  bool is_as_written(int descriptor, std::uint64_t page) const;
  /// Pages from here on are not covered. The last one of a session that was killed while it
  /// replaced pages may be new or old.
  std::uint64_t covered_end(const Journal& pending) const;

  void set_end(std::uint64_t end);
  void set(std::uint64_t page, std::span<const std::byte> content);
  /// Writes what was set since. Returns false with errno set when the disk refuses.
  bool write(const std::string& path);

 private:
  bool matches(std::uint64_t page, std::span<const std::byte> content) const;

  std::uint64_t end_ = 0;
  /// Of whole pages. Each holds its sum twice, once inverted: a damaged entry is known to be one.
  std::vector<std::uint64_t> entry_;
  std::uint64_t tail_ = 0;  ///< of the page in which the file ends; changes together with end_
  std::uint64_t first_changed_ = 0, last_changed_ = 0;  ///< entries [first, last)
};

}  // namespace acinus::io::h5
