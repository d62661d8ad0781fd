#include "io/journal.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <cstring>
#include <vector>

#include "io/disk.hpp"
#include "io/inside.hpp"

namespace acinus::io::h5 {
namespace {

/// Journal format: magic, end, then (index, page) for every page, then a hash of all before it.
constexpr std::uint64_t kJournalMagic = 0x314a'5355'4e49'4341;  // "ACINUSJ1"
constexpr std::size_t kJournalHead = 2 * sizeof(std::uint64_t), kTail = sizeof(std::uint64_t);
constexpr std::size_t kRecord = sizeof(std::uint64_t) + kPage;

}  // namespace

std::string journal_of(const std::string& path) { return path + ".journal"; }

bool write_journal(const std::string& path, const Journal& journal) {
  std::vector<std::byte> bytes(kJournalHead + journal.page.size() * kRecord + kTail);
  std::byte* out = bytes.data();
  const auto put = [&](const void* data, std::size_t size) {
    std::memcpy(out, data, size);
    out += size;
  };
  put(&kJournalMagic, sizeof kJournalMagic);
  put(&journal.end, sizeof journal.end);
  for (const auto& [index, page] : journal.page) {
    put(&index, sizeof index);
    put(page.data(), kPage);
  }
  const std::uint64_t hash = XXH3_64bits(bytes.data(), bytes.size() - kTail);
  put(&hash, sizeof hash);

  const std::string name = journal_of(path);
  const int descriptor =
      open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (descriptor < 0) return false;
  bool written = write_all(descriptor, bytes.data(), bytes.size(), 0);
  int error = errno;
  if (::close(descriptor) != 0 && written) {
    written = false;
    error = errno;
  }
  if (!written) {
    unlink(name.c_str());
    errno = error;
  }
  return written;
}

Journal read_journal(const std::string& path) {
  const std::string name = journal_of(path);
  if (access(name.c_str(), F_OK) != 0) return {};
  const std::string bytes = read_text_beside(name);
  if (bytes.size() < kJournalHead + kTail || (bytes.size() - kJournalHead - kTail) % kRecord != 0)
    return {};
  const auto number_at = [&](std::size_t i) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + i, sizeof value);
    return value;
  };
  const std::size_t end = bytes.size() - kTail;
  if (number_at(0) != kJournalMagic || number_at(end) != XXH3_64bits(bytes.data(), end)) return {};
  Journal journal{number_at(sizeof kJournalMagic), {}};
  for (std::size_t i = kJournalHead; i < end; i += kRecord) {
    std::memcpy(journal.page[number_at(i)].data(), bytes.data() + i + sizeof(std::uint64_t), kPage);
  }
  return journal;
}

bool is_possible(const Journal& journal, std::uint64_t file_size) {
  if (journal.page.empty()) return true;
  const std::uint64_t n = journal.page.size(), pages = (file_size + kPage - 1) / kPage + n;
  return journal.end <= pages * kPage && journal.page.rbegin()->first < pages;
}

void remove_journal(const std::string& path) { unlink(journal_of(path).c_str()); }

}  // namespace acinus::io::h5
