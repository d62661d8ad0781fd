#include "imaging/zarr_chunks.hpp"

#include <fmt/format.h>

#include <atomic>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/threads.hpp"

namespace acinus::imaging {
namespace {

using Index = std::vector<std::int64_t>;

/// Blocks of a grid: those from `first` on, `count` of them, along each axis.
struct BlockRange {
  Index first, count;

  std::int64_t size() const {
    std::int64_t n = 1;
    for (const std::int64_t c : count) n *= c;
    return n;
  }
  Index at(std::int64_t k) const {
    Index i = first;
    for (std::size_t a = i.size(); a-- > 0; k /= count[a]) i[a] += k % count[a];
    return i;
  }
};

/// Blocks that hold what is asked for. @param origin, extent  of what the blocks divide
BlockRange blocks(const Index& origin, const Index& extent, const Index& length,
                  std::span<const std::optional<std::int64_t>> fixed) {
  BlockRange r;
  for (std::size_t a = 0; a < length.size(); ++a) {
    const std::int64_t all = (extent[a] + length[a] - 1) / length[a];
    r.first.push_back(fixed[a] ? (*fixed[a] - origin[a]) / length[a] : 0);
    r.count.push_back(fixed[a] ? 1 : all);
  }
  return r;
}

std::string path_of(const ZarrArray& a, const Index& block) {
  std::string key = a.prefix;
  for (const std::int64_t k : block) {
    if (!key.empty()) key += a.separator;
    key += std::to_string(k);
  }
  return fmt::format("{}/{}", a.folder, key);
}

/// File of chunks, opened; nothing where it is not stored.
class ChunkFile {
 public:
  explicit ChunkFile(std::string path) : path_(std::move(path)) {
    std::error_code error;
    const auto status = std::filesystem::status(path_, error);
    if (status.type() == std::filesystem::file_type::not_found) return;
    check(status.type() == std::filesystem::file_type::regular,
          fmt::format("{}: is no file, where the metadata expect a chunk. Copy the image again.",
                      path_));
    size_ = std::filesystem::file_size(path_, error);
    in_.open(path_, std::ios::binary);
    check(in_.good() && !error,
          fmt::format("{}: cannot be read. Check its permissions and the disk.", path_),
          Exit::kFileError);
  }
  bool stored() const { return in_.is_open(); }
  std::uint64_t size() const { return size_; }
  const std::string& path() const { return path_; }
  /// @pre from + n <= size()
  std::string read(std::uint64_t from, std::uint64_t n) {
    std::string bytes(n, '\0');
    in_.seekg(static_cast<std::streamoff>(from));
    in_.read(bytes.data(), static_cast<std::streamsize>(n));
    check(in_.good(), fmt::format("{}: cannot be read. Check the disk.", path_), Exit::kFileError);
    return bytes;
  }

 private:
  std::string path_;
  std::ifstream in_;
  std::uint64_t size_ = 0;
};

std::size_t bytes_of_chunk(const ZarrArray& a) {
  std::size_t n = bytes_of(a.type);
  for (const std::int64_t c : a.chunk) n *= static_cast<std::size_t>(c);
  return n;
}

/// Reads the index of a shard: a position and a size for each of its chunks.
std::vector<std::uint64_t> read_index(const ZarrArray& a, std::int64_t n_chunk, ChunkFile& file) {
  const std::uint64_t n = 2 * static_cast<std::uint64_t>(n_chunk);
  const std::uint64_t size = n * sizeof(std::uint64_t) + (a.shards->has_sum ? 4 : 0);
  check(size <= file.size(),
        fmt::format("{}: {} bytes, fewer than the {} of its index of {} chunks. The shard is "
                    "truncated; copy or write the image again.",
                    file.path(), file.size(), size, n_chunk));
  const ZarrCodec sum = ZarrCodec::kCrc32c;
  const std::string bytes = undo_codecs(
      file.path() + ", index of the shard", std::span(&sum, a.shards->has_sum ? 1 : 0),
      file.read(a.shards->at_end ? file.size() - size : 0, size), n * sizeof(std::uint64_t));
  std::vector<std::uint64_t> index(n);
  std::memcpy(index.data(), bytes.data(), bytes.size());
  if (a.shards->swap)
    for (std::uint64_t& v : index) v = __builtin_bswap64(v);
  return index;
}

class ChunkVisit {
 public:
  ChunkVisit(const ZarrArray& a, std::span<const std::optional<std::int64_t>> fixed,
             const std::function<void(const ZarrChunk&)>& visit)
      : a_(a), fixed_(fixed), visit_(visit), bytes_(bytes_of_chunk(a)) {}

  std::int64_t run(std::size_t ordered) {
    BlockRange files = blocks(Index(a_.shape.size(), 0), a_.shape, a_.file_length(), fixed_);
    const std::int64_t n = std::exchange(files.count[ordered], 1);
    for_each_index(static_cast<std::size_t>(files.size()), true, [&](std::size_t k) {
      Index block = files.at(static_cast<std::int64_t>(k));
      for (std::int64_t i = 0; i < n; ++i, ++block[ordered]) read_file(block);
    });
    return n_;
  }

 private:
  void read_file(const Index& block) {
    ChunkFile file(path_of(a_, block));
    if (!file.stored()) return;
    Index first = block;
    for (std::size_t k = 0; k < first.size(); ++k) first[k] *= a_.file_length()[k];
    if (a_.shards) return read_shard(first, file);
    decode({first, file.path(), {}}, file.read(0, file.size()));
  }

  void read_shard(const Index& origin, ChunkFile& file) {
    constexpr std::uint64_t kMissing = ~std::uint64_t{0};
    const BlockRange all = blocks(origin, a_.shards->length, a_.chunk,
                                  std::vector<std::optional<std::int64_t>>(origin.size()));
    const std::vector<std::uint64_t> index = read_index(a_, all.size(), file);
    const BlockRange inner = blocks(origin, a_.shards->length, a_.chunk, fixed_);
    for (std::int64_t k = 0; k < inner.size(); ++k) {
      const Index block = inner.at(k);
      Index first = origin;
      std::int64_t at = 0;
      bool inside = true;
      for (std::size_t d = 0; d < block.size(); ++d) {
        at = at * all.count[d] + block[d];
        first[d] += block[d] * a_.chunk[d];
        inside = inside && first[d] < a_.shape[d];
      }
      const std::uint64_t from = index[2 * at], size = index[2 * at + 1];
      if (!inside || (from == kMissing && size == kMissing)) continue;
      const std::string place = fmt::format("{}, chunk {} of the shard", file.path(), at);
      check(from <= file.size() && size <= file.size() - from,
            fmt::format("{}: {} bytes from {} on, in a file of {}. The shard is truncated or "
                        "damaged; copy or write the image again.",
                        place, size, from, file.size()));
      decode({first, place, {}}, file.read(from, size));
    }
  }

  void decode(ZarrChunk chunk, std::string stored) {
    chunk.bytes = undo_codecs(chunk.place, a_.encoding.codec, std::move(stored), bytes_);
    visit_(chunk);
    ++n_;
  }

  const ZarrArray& a_;
  std::span<const std::optional<std::int64_t>> fixed_;
  const std::function<void(const ZarrChunk&)>& visit_;
  std::size_t bytes_;
  std::atomic<std::int64_t> n_ = 0;
};

}  // namespace

std::int64_t visit_chunks(const ZarrArray& array,
                          std::span<const std::optional<std::int64_t>> fixed, std::size_t ordered,
                          const std::function<void(const ZarrChunk&)>& visit) {
  return ChunkVisit(array, fixed, visit).run(ordered);
}

std::vector<std::size_t> chunk_strides(const ZarrArray& array) {
  std::vector<std::size_t> stride(array.shape.size());
  std::size_t n = bytes_of(array.type);
  for (std::size_t k = stride.size(); k-- > 0;) {
    const std::size_t axis = array.encoding.order[k];
    stride[axis] = n;
    n *= static_cast<std::size_t>(array.chunk[axis]);
  }
  return stride;
}

}  // namespace acinus::imaging
