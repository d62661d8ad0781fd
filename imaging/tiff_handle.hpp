#pragma once
/// An open TIFF file. Only for files that read or write them.

#include <tiffio.h>

#include <memory>

namespace acinus::imaging {

struct CloseTiff {
  void operator()(TIFF* t) const { TIFFClose(t); }
};
using TiffFile = std::unique_ptr<TIFF, CloseTiff>;

}  // namespace acinus::imaging
