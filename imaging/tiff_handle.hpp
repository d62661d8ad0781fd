#pragma once
/// Open TIFF file. Only for source files that read or write them.

#include <tiffio.h>

#include <memory>

namespace acinus::imaging {

struct CloseTiff {
  void operator()(TIFF* t) const { TIFFClose(t); }
};
using TiffFile = std::unique_ptr<TIFF, CloseTiff>;

}  // namespace acinus::imaging
