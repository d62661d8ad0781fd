#pragma once
/// Thin layer over the serial HDF5 C library: typed rows, and errors that name the file, the
/// operation, the system's reason and a remedy. HDF5 prints nothing by itself. Only io includes
/// this header; the rest of the program never uses an HDF5 type.

#include <hdf5.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/hdf5_handle.hpp"
#include "io/staged_driver.hpp"

namespace acinus::io::h5 {

/// Throws Error(kFileError): "<file>: cannot <attempted>: <system text>. <advice>".
/// @param error  errno value; 0 = take it from HDF5's own error stack or, failing that, from HDF5's
///               message
[[noreturn]] void fail(const std::string& file, const std::string& attempted, int error = 0);

/// Fixed-length text padded with zeros; width 0 becomes 1, HDF5 has no empty text.
Handle text_type(std::size_t width, H5T_cset_t set);

enum class Access { kRead, kAppend };
enum class Format {
  /// Readable by every version; survives a kill (no "open for write" mark). Checksums of its pages
  /// are kept beside it.
  kEarliest,
  kChecked  ///< HDF5 1.10 format with checksums over its own indices
};

/// Storage of a new dataset. Rows are the first, unlimited dimension.
struct Storage {
  int components = 0;  ///< 0 = one-dimensional [n]; otherwise [n][components]
  std::int64_t chunk_rows = 1024;
  bool filtered = false;  ///< shuffle + deflate(1) + fletcher32
};

/// Open file. Every method throws Error(kFileError). Writing sessions are all or nothing: only
/// close() keeps them; destruction without it (an exception on the way) restores the file.
class File {
 public:
  /// Creates a file, or truncates an existing one.
  static File create(const std::string& path, Format format);
  static File open(const std::string& path, Access access);
  File(File&&) noexcept = default;
  File& operator=(File&&) = delete;
  ~File();

  const std::string& path() const { return path_; }
  hid_t id() const { return handle_.id(); }
  /// Commits everything written so far; a second session follows.
  void flush();
  void close();

  bool exists(const std::string& name) const;
  void create_group(const std::string& name);
  /// Names of the members of a group, sorted.
  std::vector<std::string> members(const std::string& group) const;
  std::int64_t n_row(const std::string& dataset) const;
  /// Components of a dataset's rows; 0 for one-dimensional datasets.
  int components(const std::string& dataset) const;

  /// Creates an empty dataset with its `unit` attribute. T: float, double, int64, uint64, uint8.
  template <class T>
  void create_rows(const std::string& name, const Storage& storage, std::string_view unit);
  /// Creates an empty dataset of fixed-length UTF-8 text of `width` bytes, padded with zeros.
  void create_text_rows(const std::string& name, int width, std::int64_t chunk_rows);

  /// Writes rows from `first_row` on, growing the dataset if needed (never shrinking it).
  template <class T>
  void write_rows(const std::string& name, std::int64_t first_row, std::span<const T> value);
  template <class T>
  void write_row(const std::string& name, std::int64_t row, const T& value) {
    write_rows<T>(name, row, std::span<const T>(&value, 1));
  }
  /// Writes rows of text. Text longer than the dataset's width ends in "...".
  void write_text_rows(const std::string& name, std::int64_t first_row,
                       std::span<const std::string> value);

  /// Reads rows; the stored type must be T exactly.
  template <class T>
  std::vector<T> read_rows(const std::string& name, std::int64_t first_row, std::int64_t n) const;
  template <class T>
  std::vector<T> read_all(const std::string& name) const {
    return read_rows<T>(name, 0, n_row(name));
  }
  std::vector<std::string> read_text_rows(const std::string& name, std::int64_t first_row,
                                          std::int64_t n) const;

  /// Writes one text of fixed length with unit "text"; replaces an existing one.
  void write_text(const std::string& name, std::string_view text);
  std::string read_text(const std::string& name) const;

  /// Creates a contiguous one-dimensional dataset of n values (checkpoints), and the groups above.
  template <class T>
  void create_array(const std::string& name, std::size_t n);
  /// Creates such a dataset and writes all of it.
  template <class T>
  void write_array(const std::string& name, std::span<const T> value) {
    create_array<T>(name, value.size());
    write_rows(name, 0, value);
  }

  /// Writes an attribute: 64-bit numbers, or fixed-length ASCII text; an existing one is replaced.
  void write_attribute(const std::string& object, const std::string& name,
                       std::span<const std::int64_t> value);
  void write_attribute(const std::string& object, const std::string& name, std::string_view text);
  /// Writes an attribute of double precision once.
  void write_numbers(const std::string& object, const std::string& name,
                     std::span<const double> value);
  /// Writes a three-dimensional dataset once, slowest axis first, with checksums.
  void write_volume(const std::string& name, const std::array<std::int64_t, 3>& extent,
                    std::span<const float> value, bool filtered);
  /// Reads an attribute of double precision.
  std::vector<double> read_numbers(const std::string& object, const std::string& name) const;
  /// Reads such a dataset.
  /// @param extent  that it has to have
  std::vector<float> read_volume(const std::string& name,
                                 const std::array<std::int64_t, 3>& extent) const;
  void write_hash(const std::string& object, const std::string& name, std::uint64_t value);
  std::vector<std::int64_t> read_attribute(const std::string& object,
                                           const std::string& name) const;
  /// Reads one number that is not negative.
  std::int64_t read_count(const std::string& object, const std::string& name) const;
  std::string read_text_attribute(const std::string& object, const std::string& name) const;
  std::uint64_t read_hash(const std::string& object, const std::string& name) const;
  bool has_attribute(const std::string& object, const std::string& name) const;

  /// True if a dataset has exactly the type T.
  template <class T>
  bool holds(const std::string& dataset) const;

  /// Copies the first `n` rows of a chunked dataset, with type, storage and unit, as raw chunks.
  void copy_rows_from(const File& source, const std::string& name, std::int64_t n);
  /// Copies an object with all its members.
  void copy_object_from(const File& source, const std::string& name);

 private:
  File(std::string path, std::unique_ptr<StagedState> state, Handle handle, bool writing);
  [[noreturn]] void fail_here(const std::string& attempted) const;
  /// Throws Error(kFileError) for content that no file of this program has.
  [[noreturn]] void refuse(const std::string& found) const;
  Handle open_dataset(const std::string& name) const;
  Handle create_dataset(const std::string& name, hid_t type, const Storage& storage,
                        std::string_view unit);
  void write_raw(const std::string& name, hid_t type, std::int64_t first_row, std::int64_t n_value,
                 const void* value);
  /// Throws Error(kFileError) for more bytes than are stored: a damaged file may claim any size.
  void check_storage(const Handle& dataset, const std::string& name, double bytes) const;
  /// Throws Error(kFileError) for rows that are not there.
  void check_rows(const std::string& name, hsize_t n_row, std::int64_t first, std::int64_t n) const;
  /// Reads rows. @pre check_rows, check_storage
  void read_raw(const Handle& dataset, const std::string& name, hid_t type, std::int64_t first_row,
                std::int64_t n, void* value) const;
  std::vector<hsize_t> shape(const std::string& dataset) const;
  Handle open_attribute(const std::string& object, const std::string& name) const;

  std::string path_;
  std::unique_ptr<StagedState> state_;  // outlives handle_: members are destroyed in reverse order
  Handle handle_;
  bool writing_;
  mutable double handed_out_ = 0;  ///< bytes read so far: many names may share one storage
};

}  // namespace acinus::io::h5
