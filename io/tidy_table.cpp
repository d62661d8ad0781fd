#include "io/tidy_table.hpp"

#include <algorithm>
#include <span>

#include "io/disk.hpp"
#include "io/hdf5.hpp"
#include "io/page_sums.hpp"

namespace acinus::io {
namespace {

constexpr std::int64_t kChunkRows = 16384;

struct Writer {
  h5::File& file;
  std::string dataset, unit;

  template <class T>
  void operator()(const std::vector<T>& value) const {
    file.create_rows<T>(dataset, {.chunk_rows = kChunkRows, .filtered = true}, unit);
    file.write_rows<T>(dataset, 0, std::span<const T>(value));
  }
  void operator()(const std::vector<std::string>& value) const {
    std::size_t width = 1;
    for (const std::string& v : value) width = std::max(width, v.size());
    file.create_text_rows(dataset, static_cast<int>(width), kChunkRows);
    file.write_text_rows(dataset, 0, value);
  }
};

}  // namespace

void write_tidy_table(const std::string& path, const std::vector<TidyColumn>& columns) {
  const std::string partial = path + ".tmp";
  // The sums of pages are for files that are written on; of this one they would only lie about.
  const RemoveUnlessMoved cleanup{partial}, sums{h5::sums_of(partial)};
  h5::File file = h5::File::create(partial, h5::Format::kEarliest);
  for (const TidyColumn& column : columns)
    std::visit(Writer{file, "/" + column.name, column.unit}, column.value);
  file.close();
  replace_file(partial, path);
}

}  // namespace acinus::io
