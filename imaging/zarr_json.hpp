#pragma once
/// Metadata of zarr: JSON files of other programs, each value with its place for messages.

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace acinus::imaging {

using Json = nlohmann::ordered_json;

/// View of a value in a JsonFile, which must outlive it. All failures throw Error with the file,
/// the place in it and the value found.
class JsonPart {
 public:
  JsonPart(const std::string& path, const Json& value, std::string pointer = "")
      : path_(&path), value_(&value), pointer_(std::move(pointer)) {}

  bool is_null() const;
  bool is_boolean() const;
  bool is_number() const;
  bool is_text() const;
  bool is_list() const;
  bool is_object() const;
  bool has(const std::string& name) const;
  /// Names of the members of an object.
  std::vector<std::string> names() const;
  JsonPart at(const std::string& name) const;
  std::vector<JsonPart> items() const;
  std::string text() const;
  double number() const;
  bool boolean() const;
  std::vector<double> numbers() const;
  /// Whole numbers of at least `least`, at most 1e15.
  std::vector<std::int64_t> counts(std::int64_t least) const;
  const std::string& path() const { return *path_; }
  /// File, place in it and value found.
  std::string where() const;
  /// Throws Error: where(), then `rule`: what is allowed, and advice.
  [[noreturn]] void fail(const std::string& rule) const;

 private:
  const std::string* path_;
  const Json* value_;
  std::string pointer_;
};

/// JSON file, held in memory.
struct JsonFile {
  std::string path;
  std::shared_ptr<const Json> value;
  /// Reads an object. Throws Error if the file cannot be read, is not JSON or holds no object.
  static JsonFile read(const std::string& path);
  JsonPart root() const { return {path, *value}; }
};

}  // namespace acinus::imaging
