#include "io/checkpoint.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <memory>
#include <span>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/hdf5.hpp"

namespace acinus::io {
namespace {

using h5::File;

constexpr std::int64_t kCheckpointSchema[2] = {2, 0};
constexpr char kNewest[] = "/checkpoint.h5";
constexpr char kPrevious[] = "/checkpoint.prev.h5";
constexpr char kRoot[] = "/state";

/// Error for a newest file that is sound but of a newer format: the older file must not be used
/// instead.
struct TooNew : Error {
  using Error::Error;
};

std::uint64_t hash_of(const CheckpointData::Value& value) {
  return std::visit(
      [&](const auto& array) {
        return XXH3_64bits_withSeed(array.data(), array.size() * sizeof(array[0]), value.index());
      },
      value);
}

/// Digest over all names and hashes, so that a lost or renamed array shows too.
std::uint64_t digest_of(const std::map<std::string, std::uint64_t>& hash) {
  std::uint64_t digest = 0;
  for (const auto& [name, value] : hash) {
    digest = XXH3_64bits_withSeed(name.data(), name.size(), digest);
    digest = XXH3_64bits_withSeed(&value, sizeof value, digest);
  }
  return digest;
}

const char* type_name(std::size_t index) {
  constexpr const char* kName[] = {"64-bit floats", "signed 64-bit integers",
                                   "unsigned 64-bit integers", "text"};
  return kName[index];
}

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

void write_value(File& file, const std::string& name, const CheckpointData::Value& value) {
  std::visit(
      [&](const auto& array) {
        if constexpr (std::is_same_v<std::decay_t<decltype(array)>, std::string>) {
          file.write_array<std::uint8_t>(name, bytes_of(array));
        } else {
          file.write_array(name, std::span(array));
        }
      },
      value);
}

/// Writes an array part by part.
/// @param index  of its type among those of CheckpointData::Value
/// @return       hash_of() of the whole
template <class T>
std::uint64_t write_parts(File& file, const std::string& name, const ArraySource<T>& source,
                          std::size_t index) {
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash(XXH3_createState(),
                                                                      XXH3_freeState);
  XXH3_64bits_reset_withSeed(hash.get(), index);
  file.create_array<T>(name, source.size);
  std::size_t done = 0;
  source.visit([&](std::span<const T> part) {
    check(part.size() <= source.size - done,
          "internal error: " + name + " has more values than told", Exit::kInternal);
    file.write_rows(name, static_cast<std::int64_t>(done), part);
    XXH3_64bits_update(hash.get(), part.data(), part.size_bytes());
    done += part.size();
  });
  check(done == source.size, "internal error: " + name + " has fewer values than told",
        Exit::kInternal);
  return XXH3_64bits_digest(hash.get());
}

CheckpointData::Value read_value(const File& file, const std::string& name) {
  if (file.holds<double>(name)) return file.read_all<double>(name);
  if (file.holds<std::int64_t>(name)) return file.read_all<std::int64_t>(name);
  if (file.holds<std::uint64_t>(name)) return file.read_all<std::uint64_t>(name);
  const auto byte = file.read_all<std::uint8_t>(name);
  return std::string(byte.begin(), byte.end());
}

/// Writes all arrays, with a list of their names in one dataset: reading then need not walk through
/// groups.
void write_file(const std::string& path, const CheckpointSource& source) {
  File file = File::create(path, h5::Format::kChecked);
  const std::int64_t complete = 1;
  std::map<std::string, std::uint64_t> hash;
  std::string names;
  file.write_attribute("/", "schema", "acinus/checkpoint");
  file.write_attribute("/", "schema_version", kCheckpointSchema);
  file.create_group(kRoot);
  const auto dataset_of = [](const std::string& name) { return kRoot + ("/" + name); };
  for (const auto& [name, value] : source.whole.all()) {
    write_value(file, dataset_of(name), value);
    hash[name] = hash_of(value);
  }
  for (const auto& [name, parts] : source.parts())
    hash[name] = std::visit(
        [&](const auto& array) {
          return write_parts(file, dataset_of(name), array, parts.index());
        },
        parts);
  for (const auto& [name, value] : hash) {
    file.write_hash(dataset_of(name), "xxh3", value);
    file.write_attribute(dataset_of(name), "unit", "base units um s nN");
    names += name + "\n";
  }
  file.write_array<std::uint8_t>("/names", bytes_of(names));
  file.write_attribute("/names", "unit", "text");
  file.write_hash("/", "digest", digest_of(hash));
  file.write_attribute("/", "complete", std::span(&complete, 1));
  file.close();
}

void check_schema(const File& file) {
  check(file.has_attribute("/", "schema") &&
            file.read_text_attribute("/", "schema") == "acinus/checkpoint",
        file.path() + ": is not a checkpoint of acinus", Exit::kFileError);
  const auto version = file.read_attribute("/", "schema_version");
  check(version.size() == 2, file.path() + ": has no schema version", Exit::kFileError);
  if (version[0] > kCheckpointSchema[0]) {
    throw TooNew(
        fmt::format("{}: checkpoint format {}.{} is newer than this program reads ({}.{}). Update "
                    "acinus, or start "
                    "again with --overwrite.",
                    file.path(), version[0], version[1], kCheckpointSchema[0],
                    kCheckpointSchema[1]),
        Exit::kFileError);
  }
  check(version[0] == kCheckpointSchema[0],
        fmt::format("{}: checkpoint format {}.{} is unknown", file.path(), version[0], version[1]),
        Exit::kFileError);
  check(file.has_attribute("/", "complete") &&
            file.read_attribute("/", "complete") == std::vector<std::int64_t>{1},
        file.path() + ": the checkpoint was not finished", Exit::kFileError);
}

CheckpointData read_file(const std::string& path) {
  const File file = File::open(path, h5::Access::kRead);
  check_schema(file);
  CheckpointData data;
  data.set_source(path);
  std::map<std::string, std::uint64_t> hash;
  const auto bytes = file.read_all<std::uint8_t>("/names");
  const std::string names(bytes.begin(), bytes.end());
  for (std::size_t begin = 0; begin < names.size();) {
    const std::size_t end = std::min(names.find('\n', begin), names.size());
    const std::string name = names.substr(begin, end - begin);
    begin = end + 1;
    check(data.fault_of_name(name).empty(), path + ": is damaged (its list of arrays)",
          Exit::kFileError);
    const std::string dataset = kRoot + ("/" + name);
    auto value = read_value(file, dataset);
    hash[name] = hash_of(value);
    check(hash[name] == file.read_hash(dataset, "xxh3"),
          fmt::format("{}: {} is damaged (its hash does not fit)", path, name), Exit::kFileError);
    std::visit([&](auto& array) { data.put(name, std::move(array)); }, value);
  }
  check(digest_of(hash) == file.read_hash("/", "digest"),
        path + ": is damaged (arrays are missing)", Exit::kFileError);
  return data;
}

/// Gives the file at `from` the second name `to`, replacing the file of that name.
void link_as(const std::string& from, const std::string& to) {
  const std::string partial = to + ".tmp";
  const RemoveUnlessMoved cleanup{partial};
  unlink(partial.c_str());
  if (link(from.c_str(), partial.c_str()) == 0) {
    replace_file(partial, to);
  } else if (errno == EPERM || errno == EOPNOTSUPP || errno == EMLINK) {
    replace_file(
        from,
        to);  // no hard links here: for a moment only the previous name exists, still complete
  } else {
    fail_on_disk(to, "keep the previous checkpoint", errno);
  }
}

}  // namespace

std::string CheckpointData::fault_of_name(const std::string& name) const {
  const bool plain = !name.empty() && name.front() != '/' && name.back() != '/' &&
                     name.find("//") == std::string::npos &&
                     std::all_of(name.begin(), name.end(), [](unsigned char c) {
                       return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == '/';
                     });
  if (!plain) return "\"" + name + "\" cannot name an array of a checkpoint";
  const auto clash = [&](const std::string& other) {
    return "checkpoint arrays \"" + name + "\" and \"" + other + "\" clash";
  };
  for (std::size_t end = name.find('/'); end != std::string::npos; end = name.find('/', end + 1))
    if (contains(name.substr(0, end))) return clash(name.substr(0, end));
  const auto below = value_.lower_bound(name + "/");
  if (below != value_.end() && below->first.starts_with(name + "/")) return clash(below->first);
  return contains(name) ? clash(name) : std::string();
}

void CheckpointData::add(const std::string& name, Value value) {
  const std::string fault = fault_of_name(name);
  check(fault.empty(), "internal error: " + fault, Exit::kInternal);
  value_.emplace(name, std::move(value));
}

void CheckpointData::put(const std::string& name, std::vector<double> value) {
  add(name, std::move(value));
}
void CheckpointData::put(const std::string& name, std::vector<std::int64_t> value) {
  add(name, std::move(value));
}
void CheckpointData::put(const std::string& name, std::vector<std::uint64_t> value) {
  add(name, std::move(value));
}
void CheckpointData::put(const std::string& name, std::string value) {
  add(name, std::move(value));
}

template <class T>
const T& CheckpointData::get(const std::string& name) const {
  const auto found = value_.find(name);
  check(found != value_.end(),
        fmt::format("{}: has no \"{}\". It was written by another version or for another kind of "
                    "scene; start again with "
                    "--overwrite.",
                    source_, name),
        Exit::kFileError);
  const T* value = std::get_if<T>(&found->second);
  if (value == nullptr) {
    throw Error(fmt::format("{}: \"{}\" holds {}, but {} are needed", source_, name,
                            type_name(found->second.index()), type_name(Value(T{}).index())),
                Exit::kFileError);
  }
  return *value;
}

const std::vector<double>& CheckpointData::numbers(const std::string& name) const {
  return get<std::vector<double>>(name);
}
const std::vector<std::int64_t>& CheckpointData::integers(const std::string& name) const {
  return get<std::vector<std::int64_t>>(name);
}
const std::vector<std::uint64_t>& CheckpointData::bits(const std::string& name) const {
  return get<std::vector<std::uint64_t>>(name);
}
const std::string& CheckpointData::text(const std::string& name) const {
  return get<std::string>(name);
}

double CheckpointData::number(const std::string& name) const {
  const auto& value = numbers(name);
  check(value.size() == 1,
        fmt::format("{}: \"{}\" has {} values, 1 is needed", source_, name, value.size()),
        Exit::kFileError);
  check(!std::isnan(value[0]), fmt::format("{}: \"{}\" is no number", source_, name),
        Exit::kFileError);
  return value[0];
}

std::int64_t CheckpointData::count(const std::string& name) const {
  const auto& value = integers(name);
  check(value.size() == 1,
        fmt::format("{}: \"{}\" has {} values, 1 is needed", source_, name, value.size()),
        Exit::kFileError);
  return value[0];
}

void CheckpointSource::put(const std::string& name, Parts parts) {
  const std::string fault = whole.fault_of_name(name);
  check(fault.empty() && !parts_.contains(name),
        "internal error: " + (fault.empty() ? name + " is there twice" : fault), Exit::kInternal);
  parts_.emplace(name, std::move(parts));
}

void visit_parts(const CheckpointSource& source) {
  for (const auto& [name, parts] : source.parts())
    std::visit([](const auto& array) { array.visit([](const auto&) {}); }, parts);
}

CheckpointData collect(const CheckpointSource& source) {
  CheckpointData data = source.whole;
  for (const auto& [name, parts] : source.parts())
    std::visit(
        [&]<class T>(const ArraySource<T>& array) {
          std::vector<T> values;
          values.reserve(array.size);
          array.visit([&](std::span<const T> part) {
            values.insert(values.end(), part.begin(), part.end());
          });
          data.put(name, std::move(values));
        },
        parts);
  return data;
}

void save_checkpoint(const std::string& folder, const CheckpointSource& source) {
  const std::string newest = folder + kNewest;
  const std::string partial = newest + ".tmp";
  const RemoveUnlessMoved cleanup{partial};
  write_file(partial, source);
  sync_file(partial);
  if (std::filesystem::exists(newest)) link_as(newest, folder + kPrevious);
  replace_file(partial, newest);
  sync_folder(folder);
}

void save_state_file(const std::string& path, const CheckpointSource& source) {
  const std::string partial = path + ".tmp";
  const RemoveUnlessMoved cleanup{partial};
  write_file(partial, source);
  sync_file(partial);
  replace_file(partial, path);
}

CheckpointData load_state_file(const std::string& path) { return read_file(path); }

LoadedCheckpoint load_checkpoint(const std::string& folder) {
  const std::string newest = folder + kNewest, previous = folder + kPrevious;
  check(has_checkpoint(folder),
        folder + ": has no checkpoint (checkpoint.h5). Start the run without --resume.",
        Exit::kFileError);
  std::string trouble;
  try {
    return {read_file(newest), newest, ""};
  } catch (const TooNew&) {
    throw;
  } catch (const Error& error) {
    trouble = error.what();
  }
  if (!std::filesystem::exists(previous)) {
    throw Error(trouble + "\nThere is no checkpoint before it. Start again with --overwrite.",
                Exit::kFileError);
  }
  try {
    return {read_file(previous), previous,
            trouble + "\nContinuing from the checkpoint before it: " + previous};
  } catch (const TooNew&) {
    throw;
  } catch (const Error& error) {
    throw Error(trouble + "\n" + error.what() +
                    "\nNeither checkpoint can be used. Start again with --overwrite.",
                Exit::kFileError);
  }
}

bool has_checkpoint(const std::string& folder) {
  std::error_code ignored;
  return std::filesystem::exists(folder + kNewest, ignored) ||
         std::filesystem::exists(folder + kPrevious, ignored);
}

}  // namespace acinus::io
