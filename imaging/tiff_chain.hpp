#pragma once
/// Chain of pages of a TIFF file, read from its bytes: libtiff ends a broken chain silently, and
/// follows it from the start for every page.

#include <cstdint>
#include <string>
#include <vector>

namespace acinus::imaging {

struct TiffChain {
  std::vector<std::uint64_t> page;   ///< byte where the directory of each page begins
  double stored = 0;                 ///< bytes of the data of all pages
  std::int64_t planes_in_first = 1;  ///< MetaMorph's stacks have all slices in one page
};

/// Reads the chain of pages.
/// @param pages_known  the file states elsewhere how many pages it has; otherwise unused bytes are
///                     searched for lost pages
/// Throws Error where a directory or its data lie beyond the end of the file, where the chain is
/// circular, and where a page is in no chain.
TiffChain read_tiff_chain(const std::string& path, bool pages_known);

}  // namespace acinus::imaging
