#include "io/page_sums.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "io/disk.hpp"
#include "io/inside.hpp"

namespace acinus::io::h5 {
namespace {

/// Format of the sums: magic, end, sum of the last page, hash of these, then the entries.
constexpr std::uint64_t kSumsMagic = 0x3153'4d55'534e'4341;  // "ACNSUMS1"
constexpr std::size_t kWord = sizeof(std::uint64_t), kSumsHead = 4;

std::uint64_t make_entry(std::span<const std::byte> content) {
  const auto sum = static_cast<std::uint32_t>(XXH3_64bits(content.data(), content.size()));
  return std::uint64_t{sum} << 32 | static_cast<std::uint32_t>(~sum);
}

bool is_entry(std::uint64_t e) {
  return static_cast<std::uint32_t>(e >> 32) == static_cast<std::uint32_t>(~e);
}

using Head = std::array<std::uint64_t, kSumsHead>;

Head make_head(std::uint64_t end, std::uint64_t tail) {
  Head head{kSumsMagic, end, tail, 0};
  head[3] = XXH3_64bits(head.data(), 3 * kWord);
  return head;
}

}  // namespace

std::string sums_of(const std::string& path) { return path + ".sums"; }

PageSums PageSums::read(const std::string& path) {
  PageSums sums;
  if (access(sums_of(path).c_str(), F_OK) != 0) return sums;
  const std::string bytes = read_text_beside(sums_of(path));
  if (bytes.size() < kSumsHead * kWord) return sums;
  std::vector<std::uint64_t> word(bytes.size() / kWord);
  std::memcpy(word.data(), bytes.data(), word.size() * kWord);
  if (!std::ranges::equal(make_head(word[1], word[2]), std::span(word).first(kSumsHead)))
    return sums;
  sums.end_ = word[1];
  sums.tail_ = word[2];
  sums.entry_.assign(word.begin() + kSumsHead, word.end());
  return sums;
}

void PageSums::remove(const std::string& path) { unlink(sums_of(path).c_str()); }

std::uint64_t PageSums::size_of(std::uint64_t page) const {
  const std::uint64_t begin = page * kPage;
  return begin < end_ ? std::min(kPage, end_ - begin) : 0;
}

bool PageSums::matches(std::uint64_t page, std::span<const std::byte> content) const {
  const std::uint64_t entry =
      content.size() < kPage ? tail_ : (page < entry_.size() ? entry_[page] : 0);
  return content.empty() || !is_entry(entry) || entry == make_entry(content);
}

bool PageSums::is_as_written(int descriptor, std::uint64_t page) const {
  std::array<std::byte, kPage> content;
  const std::uint64_t size = size_of(page);
  for (std::uint64_t done = 0; done < size;) {
    const ssize_t n = pread(descriptor, content.data() + done, size - done,
                            static_cast<off_t>(page * kPage + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    if (n == 0) break;  // cut short
    done += static_cast<std::uint64_t>(n);
    if (done == size && matches(page, {content.data(), size})) return true;
  }
  errno = EBADMSG;
  return size == 0;
}

std::uint64_t PageSums::covered_end(const Journal& pending) const {
  return pending.page.empty() ? end_ : std::min(end_, pending.end / kPage * kPage);
}

void PageSums::set_end(std::uint64_t end) {
  end_ = end;
  entry_.resize(std::max<std::size_t>(entry_.size(), end / kPage));
}

void PageSums::set(std::uint64_t page, std::span<const std::byte> content) {
  if (content.size() < kPage) {
    tail_ = make_entry(content);
    return;
  }
  entry_[page] = make_entry(content);
  if (first_changed_ == last_changed_) first_changed_ = last_changed_ = page;
  first_changed_ = std::min(first_changed_, page);
  last_changed_ = std::max(last_changed_, page + 1);
}

bool PageSums::write(const std::string& path) {
  const int descriptor =
      open(sums_of(path).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (descriptor < 0) return false;
  const auto put = [&](const std::uint64_t* word, std::size_t n, std::uint64_t at) {
    return write_all(descriptor, reinterpret_cast<const std::byte*>(word), n * kWord, at * kWord);
  };
  const bool written = put(entry_.data() + first_changed_, last_changed_ - first_changed_,
                           kSumsHead + first_changed_) &&
                       put(make_head(end_, tail_).data(), kSumsHead, 0);
  const int error = errno;
  if (::close(descriptor) != 0 && written) return false;
  errno = error;
  first_changed_ = last_changed_ = 0;
  return written;
}

bool is_damaged(const std::string& path) {
  const PageSums sums = PageSums::read(path);
  const Journal journal = read_journal(path);
  const std::uint64_t end = sums.covered_end(journal);
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  bool damaged = false;
  for (std::uint64_t page = 0; page * kPage < end && !damaged; ++page)
    damaged = !journal.page.contains(page) && !sums.is_as_written(descriptor, page);
  ::close(descriptor);
  return damaged;
}

}  // namespace acinus::io::h5
