#pragma once
/// Writing of rows of a dataset as they come, in pieces of whole chunks.

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/hdf5.hpp"

namespace acinus::io {

/// Rows per chunk of the large arrays. Filtered frames start on a chunk: a chunk that two frames
/// share would be compressed anew in place, and a kill at that moment would damage the finished
/// frame.
inline constexpr std::int64_t kChunkRows = 16384;

/// Writer of consecutive rows. A compressed dataset gets whole chunks from the first row on, so
/// that none is compressed twice.
template <class T>
class RowWriter {
 public:
  RowWriter(h5::File& file, std::string name, std::int64_t first_row, int components = 1)
      : file_(&file),
        name_(std::move(name)),
        row_(first_row),
        piece_(static_cast<std::size_t>(kChunkRows * components)),
        components_(components) {}

  void put(std::span<const T> values) {
    while (!values.empty()) {
      const std::span<const T> part = values.first(std::min(values.size(), piece_ - held_.size()));
      held_.insert(held_.end(), part.begin(), part.end());
      values = values.subspan(part.size());
      if (held_.size() == piece_) finish();
    }
  }
  void put(const T& value) { put(std::span(&value, 1)); }

  /// Writes what is left. To be called after the last row.
  void finish() {
    if (held_.empty()) return;
    file_->write_rows<T>(name_, row_, held_);
    row_ += static_cast<std::int64_t>(held_.size()) / components_;
    held_.clear();
  }

 private:
  h5::File* file_;
  std::string name_;
  std::int64_t row_;
  std::size_t piece_;
  int components_;
  std::vector<T> held_;
};

}  // namespace acinus::io
