#include "imaging/tiff_chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <unordered_set>

#include "core/error.hpp"

namespace acinus::imaging {
namespace {

constexpr std::uint16_t kWidth = 256, kStripOffsets = 273, kStripBytes = 279, kTileOffsets = 324,
                        kTileBytes = 325, kSubPages = 330, kUic2 = 33629;

/// Size of a value by the number of its type in TIFF 6.0 and BigTIFF, bytes; 0: unknown.
std::uint64_t bytes_of_type(std::uint16_t type) {
  constexpr std::array<std::uint8_t, 19> kBytes{0, 1, 1, 2, 4, 8, 1, 1, 2, 4,
                                                8, 4, 8, 4, 0, 0, 8, 8, 8};
  return type < kBytes.size() ? kBytes[type] : 0;
}

struct TagEntry {
  std::uint16_t type = 0;
  std::uint64_t count = 0, place = 0;  ///< byte of the first value in the file
};

struct Directory {
  std::map<std::uint16_t, TagEntry> entry;
  std::uint64_t end = 0, next = 0;
};

/// Range of bytes [begin, end).
struct Span {
  std::uint64_t begin = 0, end = 0;
};

class Walker {
 public:
  explicit Walker(const std::string& path)
      : path_(path), file_(path, std::ios::binary), size_(std::filesystem::file_size(path)) {
    std::array<char, 4> mark{};
    file_.read(mark.data(), 4);
    big_endian_ = mark[0] == 'M';
    big_ = mark[big_endian_ ? 3 : 2] == 43;
  }

  TiffChain run(bool pages_known) {
    TiffChain chain;
    use(0, big_ ? 16 : 8);
    std::uint64_t at = big_ ? number(8, 8) : number(4, 4);
    while (at != 0) {
      const std::string name = fmt::format("page {}", chain.page.size());
      const Directory d = read_new(at, name);
      if (chain.page.empty()) read_first(d, chain);
      chain.page.push_back(at);
      chain.stored += use_data(d, name);
      at = d.next;
    }
    check(!chain.page.empty(), fmt::format("{}: has no pages. The file is damaged.", path_));
    if (!pages_known) check_lost_pages();
    return chain;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(fmt::format("{}: {}. The file is truncated or damaged.", path_, what));
  }

  /// Unsigned integer of `bytes` bytes.
  std::uint64_t number(std::uint64_t place, std::uint64_t bytes) {
    std::array<unsigned char, 8> raw{};
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(place));
    file_.read(reinterpret_cast<char*>(raw.data()), static_cast<std::streamsize>(bytes));
    return decode(raw.data(), bytes);
  }

  std::uint64_t decode(const unsigned char* raw, std::uint64_t bytes) const {
    std::uint64_t value = 0;
    for (std::uint64_t k = 0; k < bytes; ++k)
      value = value << 8 | raw[big_endian_ ? k : bytes - 1 - k];
    return value;
  }

  /// Bytes of the file. @pre  they are in the file
  std::string bytes(std::uint64_t place, std::uint64_t n) {
    std::string out(n, '\0');
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(place));
    file_.read(out.data(), static_cast<std::streamsize>(n));
    return out;
  }

  bool fits(std::uint64_t place, std::uint64_t n) const {
    return place <= size_ && n <= size_ - place;
  }

  void use(std::uint64_t place, std::uint64_t n) { used_.push_back({place, place + n}); }

  Directory read_new(std::uint64_t at, const std::string& name) {
    if (!seen_.insert(at).second)
      fail(fmt::format("the chain of pages comes back to byte {} behind {}", at, name));
    Directory d = read(at, name);
    use(at, d.end - at);
    return d;
  }

  Directory read(std::uint64_t at, const std::string& name) {
    const std::uint64_t head = big_ ? 8 : 2, each = big_ ? 20 : 12, tail = big_ ? 8 : 4;
    const auto beyond = [&] {
      fail(
          fmt::format("{} is said to begin at byte {} and goes beyond the end of the file, which "
                      "has {}",
                      name, at, size_));
    };
    if (!fits(at, head)) beyond();
    const std::uint64_t n = number(at, head);
    constexpr std::uint64_t kMostEntries = 65535;
    if (n > kMostEntries || !fits(at, head + each * n + tail)) beyond();
    const std::string text = bytes(at + head, each * n + tail);
    const auto* raw = reinterpret_cast<const unsigned char*>(text.data());
    Directory d;
    d.end = at + head + each * n + tail;
    for (std::uint64_t k = 0; k < n; ++k, raw += each) {
      TagEntry e;
      e.type = static_cast<std::uint16_t>(decode(raw + 2, 2));
      e.count = decode(raw + 4, big_ ? 8 : 4);
      const std::uint64_t inside = big_ ? 8 : 4, own = at + head + each * k + (big_ ? 12 : 8);
      const std::uint64_t one = bytes_of_type(e.type);
      const bool here = e.count <= inside && one * e.count <= inside;
      e.place = here ? own : decode(raw + (big_ ? 12 : 8), inside);
      d.entry[static_cast<std::uint16_t>(decode(raw, 2))] = e;
    }
    d.next = decode(raw, tail);
    return d;
  }

  /// Values of an entry; empty where it is missing or not in the file.
  std::vector<std::uint64_t> values(const Directory& d, std::uint16_t tag) {
    const auto found = d.entry.find(tag);
    if (found == d.entry.end()) return {};
    const TagEntry& e = found->second;
    const std::uint64_t one = bytes_of_type(e.type);
    if (one == 0 || e.count > size_ || !fits(e.place, e.count * one)) return {};
    const std::string text = bytes(e.place, e.count * one);
    std::vector<std::uint64_t> out(e.count);
    for (std::uint64_t k = 0; k < e.count; ++k)
      out[k] = decode(reinterpret_cast<const unsigned char*>(text.data()) + k * one, one);
    return out;
  }

  void read_first(const Directory& d, TiffChain& chain) {
    if (const auto found = d.entry.find(kUic2); found != d.entry.end())
      chain.planes_in_first =
          static_cast<std::int64_t>(std::min<std::uint64_t>(found->second.count, 1u << 30));
    const std::vector<std::uint64_t> width = values(d, kWidth);
    if (width.size() == 1) width_ = width[0];
  }

  /// Byte ranges of the strips or tiles of a page.
  std::vector<Span> data_of(const Directory& d) {
    for (const auto& [offsets, counts] :
         {std::pair{kStripOffsets, kStripBytes}, std::pair{kTileOffsets, kTileBytes}}) {
      const std::vector<std::uint64_t> at = values(d, offsets), n = values(d, counts);
      std::vector<Span> out;
      for (std::size_t k = 0; k < std::min(at.size(), n.size()); ++k)
        out.push_back({at[k], n[k] > std::numeric_limits<std::uint64_t>::max() - at[k]
                                  ? std::numeric_limits<std::uint64_t>::max()
                                  : at[k] + n[k]});
      if (!out.empty()) return out;
    }
    return {};
  }

  /// Marks the data of a page, its further values and pages below it as used; returns the bytes of
  /// the data.
  double use_data(const Directory& d, const std::string& name) {
    double stored = 0;
    for (const Span& s : data_of(d)) {
      if (s.end > size_)
        fail(fmt::format("the data of {} go to byte {}, but the file has {}", name, s.end, size_));
      used_.push_back(s);
      stored += static_cast<double>(s.end - s.begin);
    }
    for (const auto& [tag, e] : d.entry) {
      const std::uint64_t one = bytes_of_type(e.type);
      if (one != 0 && e.count <= size_ && fits(e.place, one * e.count)) use(e.place, one * e.count);
    }
    for (const std::uint64_t at : values(d, kSubPages)) {
      if (at == 0 || !seen_.insert(at).second || !fits(at, 2)) continue;
      const Directory below = read(at, name + " (a smaller copy)");
      use(at, below.end - at);
      for (const Span& s : data_of(below)) used_.push_back(s);
    }
    return stored;
  }

  /// Throws Error at a lost page: a directory in bytes that no page uses, with its data in such
  /// bytes too.
  void check_lost_pages() {
    std::ranges::sort(used_, {}, &Span::begin);
    std::uint64_t end = 0, searched = 0;
    constexpr std::uint64_t kMostSearched = 1u << 28;
    std::vector<Span> gap;
    used_.push_back({size_, size_});
    for (const Span& s : used_) {
      if (s.begin > end) gap.push_back({end, s.begin});
      end = std::max(end, s.end);
    }
    for (const Span& g : gap) {
      if ((searched += g.end - g.begin) > kMostSearched) return;
      check_gap(g, gap);
    }
  }

  void check_gap(const Span& g, const std::vector<Span>& gap) {
    const std::string text = bytes(g.begin, g.end - g.begin);
    const auto* raw = reinterpret_cast<const unsigned char*>(text.data());
    const std::uint64_t head = big_ ? 8 : 2, each = big_ ? 20 : 12;
    constexpr std::uint64_t kFewest = 6, kMost = 100, kFirstTags = 260;
    for (std::uint64_t k = 0; k + head + each * kFewest <= text.size(); ++k) {
      const std::uint64_t n = decode(raw + k, head);
      if (n < kFewest || n > kMost || k + head + each * n > text.size()) continue;
      const std::uint64_t tag = decode(raw + k + head, 2);
      if (tag < 254 || tag > kFirstTags || !fits(g.begin + k, head + each * n + each)) continue;
      const Directory d = read(g.begin + k, "a lost page");
      const std::vector<std::uint64_t> width = values(d, kWidth);
      const std::vector<Span> data = data_of(d);
      if (width.size() != 1 || width[0] != width_ || data.empty()) continue;
      const bool alone = std::ranges::any_of(
          gap, [&](const Span& o) { return data[0].begin >= o.begin && data[0].end <= o.end; });
      if (alone && data[0].end > data[0].begin)
        fail(fmt::format("a page at byte {} is in no chain: pages are missing", g.begin + k));
    }
  }

  const std::string& path_;
  std::ifstream file_;
  std::uint64_t size_ = 0, width_ = 0;
  bool big_endian_ = false, big_ = false;
  std::vector<Span> used_;
  std::unordered_set<std::uint64_t> seen_;
};

}  // namespace

TiffChain read_tiff_chain(const std::string& path, bool pages_known) {
  return Walker(path).run(pages_known);
}

}  // namespace acinus::imaging
