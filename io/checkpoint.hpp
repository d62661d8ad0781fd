#pragma once
/// Checkpoints: the complete state of a run as named arrays, bit for bit.

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "io/array_source.hpp"

namespace acinus::io {

/// Named arrays of a checkpoint. Reading never invents a value: a missing array or one of another
/// type is an Error(kFileError).
class CheckpointData {
 public:
  using Value = std::variant<std::vector<double>, std::vector<std::int64_t>,
                             std::vector<std::uint64_t>, std::string>;

  /// Adds an array. @param name  letters, digits, '_', '-', '.', grouped by '/': "dcm/position".
  /// Setting a name twice is an Error(kInternal), and so is a name that is also a group of others.
  void put(const std::string& name, std::vector<double> value);
  void put(const std::string& name, std::vector<std::int64_t> value);
  void put(const std::string& name, std::vector<std::uint64_t> value);
  void put(const std::string& name, std::string value);
  void put(const std::string& name, const char* value) { put(name, std::string(value)); }
  void put_number(const std::string& name, double value) { put(name, std::vector<double>{value}); }
  void put_count(const std::string& name, std::int64_t value) {
    put(name, std::vector<std::int64_t>{value});
  }

  bool contains(const std::string& name) const { return value_.count(name) != 0; }
  /// Reason why no array can be added under this name; empty if one can.
  std::string fault_of_name(const std::string& name) const;
  const std::vector<double>& numbers(const std::string& name) const;
  const std::vector<std::int64_t>& integers(const std::string& name) const;
  const std::vector<std::uint64_t>& bits(const std::string& name) const;
  const std::string& text(const std::string& name) const;
  /// Value of an array of length one.
  double number(const std::string& name) const;
  std::int64_t count(const std::string& name) const;

  const std::map<std::string, Value>& all() const { return value_; }
  /// Origin of the data, for messages.
  const std::string& source() const { return source_; }
  void set_source(std::string source) { source_ = std::move(source); }

 private:
  void add(const std::string& name, Value value);
  template <class T>
  const T& get(const std::string& name) const;

  std::map<std::string, Value> value_;
  std::string source_ = "checkpoint";
};

/// Content of a checkpoint that is to be written: whole arrays, and arrays that are made part by
/// part while they are written.
class CheckpointSource {
 public:
  using Parts = std::variant<ArraySource<double>, ArraySource<std::int64_t>>;

  CheckpointData whole;

  explicit CheckpointSource(CheckpointData data = {}) : whole(std::move(data)) {}
  /// Adds an array. Names are those of CheckpointData.
  void put(const std::string& name, Parts parts);

  const std::map<std::string, Parts>& parts() const { return parts_; }

 private:
  std::map<std::string, Parts> parts_;
};

/// Makes all parts and drops them: for processes that take part in making what the root writes.
void visit_parts(const CheckpointSource& source);

/// Data with all arrays of a source.
CheckpointData collect(const CheckpointSource& source);

/// Writes folder/checkpoint.h5 and keeps the previous one as checkpoint.prev.h5. At every moment,
/// even if the program is killed or the disk is full, one of the two is complete. Errors:
/// Error(kFileError); the older files are untouched.
void save_checkpoint(const std::string& folder, const CheckpointSource& source);

struct LoadedCheckpoint {
  CheckpointData data;
  std::string file;     ///< path of the file that was read
  std::string warning;  ///< not empty if the newest was damaged and the previous one was read
};

/// Reads the newest checkpoint with correct hashes. Errors (kFileError): none is usable, or the
/// newest has a newer major version of the format (the older one is then not read silently).
LoadedCheckpoint load_checkpoint(const std::string& folder);

/// Writes one file of any name, which appears whole or not at all; no previous file is kept.
/// Errors: Error(kFileError).
void save_state_file(const std::string& path, const CheckpointSource& source);
CheckpointData load_state_file(const std::string& path);

/// True if the folder has a checkpoint, usable or not.
bool has_checkpoint(const std::string& folder);

}  // namespace acinus::io
