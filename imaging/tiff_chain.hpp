#pragma once
/// The chain of pages of a TIFF file, walked over its bytes: libtiff ends a broken chain quietly,
/// and walks it from the start for every page.

#include <cstdint>
#include <string>
#include <vector>

namespace acinus::imaging {

struct TiffChain {
  std::vector<std::uint64_t> page;   ///< byte where the directory of each page begins
  double stored = 0;                 ///< bytes of the data of all pages
  std::int64_t planes_in_first = 1;  ///< MetaMorph's stacks have all slices in one page
};

/// @param pages_known  the file says elsewhere how many pages it has; otherwise what no page uses
/// is searched for lost ones
/// Throws Error where a directory or its data lie beyond the end of the file, where the chain runs
/// in a circle, and where a page is in no chain.
TiffChain read_tiff_chain(const std::string& path, bool pages_known);

}  // namespace acinus::imaging
