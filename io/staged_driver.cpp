#include "io/staged_driver.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "io/disk.hpp"
#include "io/journal.hpp"
#include "io/page_sums.hpp"

namespace acinus::io::h5 {
namespace {

constexpr haddr_t kMaxAddress = (haddr_t{1} << 62) - 1;

struct DriverInfo {
  StagedState* state;
  bool sums;  ///< checksums for a new file; an opened one has them or not
};

struct StagedFile : H5FD_t {
  int descriptor = -1;
  bool writable = false;
  dev_t device = 0;
  ino_t inode = 0;
  std::string path;
  haddr_t end_of_allocation = 0;
  haddr_t end_of_file = 0;  ///< end of the file for HDF5
  haddr_t committed = 0;    ///< bytes below it are part of the last good state
  Journal staged;           ///< new content of bytes below `committed`
  bool has_sums = false;
  PageSums sums;
  std::vector<bool> checked;  ///< [page] found as written
  StagedState* state = nullptr;
};

StagedFile* self(H5FD_t* file) { return static_cast<StagedFile*>(file); }
const StagedFile* self(const H5FD_t* file) { return static_cast<const StagedFile*>(file); }

herr_t fail(StagedFile* file) {
  if (file->state->error == 0) file->state->error = errno != 0 ? errno : EIO;
  file->state->discard = true;
  return -1;
}

/// Reads bytes; those past the end are zero, as HDF5 expects.
bool read_all(int descriptor, std::byte* data, haddr_t size, haddr_t address) {
  while (size > 0) {
    const ssize_t n = pread(descriptor, data, size, static_cast<off_t>(address));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    if (n == 0) {
      std::memset(data, 0, size);
      return true;
    }
    data += n;
    address += static_cast<haddr_t>(n);
    size -= static_cast<haddr_t>(n);
  }
  return true;
}

/// True if a page of the file has the bytes that were written. A reader beside a writer may see a
/// new page and an old sum: a mismatch is checked again before it counts as damage.
bool is_as_written(StagedFile* file, std::uint64_t page) {
  constexpr int kTries = 4;
  constexpr useconds_t kRetryInterval = 20'000;  // us
  if (page < file->checked.size() && file->checked[page]) return true;
  for (int attempt = 0; !file->sums.is_as_written(file->descriptor, page); ++attempt) {
    if (errno != EBADMSG || file->writable || attempt == kTries - 1) return false;
    usleep(kRetryInterval);
    file->sums = PageSums::read(file->path);
  }
  if (file->checked.size() <= page) file->checked.resize(page + 1, false);
  file->checked[page] = true;
  return true;
}

/// True if that holds for all pages of a range that are not waiting to be replaced.
bool are_as_written(StagedFile* file, haddr_t begin, haddr_t end) {
  if (!file->has_sums) return true;
  end = std::min<haddr_t>(end, file->sums.covered_end(file->staged));
  for (std::uint64_t page = begin / kPage; page * kPage < end; ++page)
    if (!file->staged.page.contains(page) && !is_as_written(file, page)) return false;
  return true;
}

/// Updates the sums of new and replaced pages. @pre the file has its final content
bool renew_sums(StagedFile* file) {
  if (!file->has_sums) return true;
  const std::uint64_t end = file->committed, first_new = file->sums.end() / kPage;
  file->sums.set_end(end);
  std::vector<std::byte> content(kPage);
  const auto renew = [&](std::uint64_t page) {
    const std::uint64_t size = file->sums.size_of(page);
    if (!read_all(file->descriptor, content.data(), size, page * kPage)) return false;
    file->sums.set(page, {content.data(), size});
    return true;
  };
  for (const auto& [index, page] : file->staged.page)
    if (index < first_new && !renew(index)) return false;
  for (std::uint64_t page = first_new; page * kPage < end; ++page)
    if (!renew(page)) return false;
  return file->sums.write(file->path);
}

/// Writes the staged pages, which are in the journal, and removes the journal.
bool overwrite(StagedFile* file) {
  if (file->staged.page.empty()) return true;
  for (const auto& [index, page] : file->staged.page) {
    const haddr_t begin = index * kPage;
    const haddr_t size = std::min<haddr_t>(kPage, file->staged.end - begin);
    if (!write_all(file->descriptor, page.data(), size, begin)) return false;
  }
  if (!renew_sums(file)) return false;
  file->staged.page.clear();
  remove_journal(file->path);
  return true;
}

H5FD_t* open_file(const char* name, unsigned flags, hid_t list, haddr_t max_address) {
  const auto* info = static_cast<const DriverInfo*>(H5Pget_driver_info(list));
  if (info == nullptr || info->state == nullptr || max_address == 0) return nullptr;
  int mode = (flags & H5F_ACC_RDWR) != 0 ? O_RDWR : O_RDONLY;
  if ((flags & H5F_ACC_TRUNC) != 0) mode |= O_TRUNC;
  if ((flags & H5F_ACC_CREAT) != 0) mode |= O_CREAT;
  if ((flags & H5F_ACC_EXCL) != 0) mode |= O_EXCL;
  auto file = std::make_unique<StagedFile>();
  file->state = info->state;
  file->path = name;
  file->has_sums =
      (flags & H5F_ACC_TRUNC) != 0 ? info->sums : access(sums_of(name).c_str(), F_OK) == 0;
  *file->state = {};  // HDF5 tries a plain open before it creates; that failure does not count
  errno = 0;
  if ((flags & H5F_ACC_TRUNC) != 0) {  // they belong to what is replaced
    remove_journal(name);
    PageSums::remove(name);
  }
  if ((mode & O_CREAT) != 0) mode |= O_NOFOLLOW;  // else a link would make another file go
  // A pipe would wait for a writer for ever, and has no bytes to go back to.
  file->descriptor = open(name, mode | O_CLOEXEC | O_NONBLOCK, 0666);
  struct stat status {};
  const bool opened = file->descriptor >= 0 && fstat(file->descriptor, &status) == 0;
  if (opened && !S_ISREG(status.st_mode)) errno = S_ISDIR(status.st_mode) ? EISDIR : ESPIPE;
  if (!opened || !S_ISREG(status.st_mode)) {
    fail(file.get());
    if (file->descriptor >= 0) ::close(file->descriptor);
    return nullptr;
  }
  file->device = status.st_dev;
  file->inode = status.st_ino;
  file->end_of_file = file->committed = static_cast<haddr_t>(status.st_size);
  file->writable = (flags & H5F_ACC_RDWR) != 0;
  file->state->discard = !file->writable;  // a reader never writes, not even to mend a length
  try {
    file->staged = read_journal(name);  // of a session that was killed; else empty
    file->sums = PageSums::read(name);
    if (!is_possible(file->staged, file->committed)) {
      errno = EBADMSG;
      fail(file.get());
    }
  } catch (...) {  // exceptions must not cross the C library
    errno = EIO;
    fail(file.get());
  }
  if (file->writable && file->state->error == 0 && !overwrite(file.get())) fail(file.get());
  if (file->state->error != 0) {
    ::close(file->descriptor);
    return nullptr;
  }
  return file.release();
}

/// Commits the session. Once the journal is complete, the new state is the file's state, whatever
/// happens.
bool commit(StagedFile* file) {
  if (file->end_of_file < file->end_of_allocation) {
    if (ftruncate(file->descriptor, static_cast<off_t>(file->end_of_allocation)) != 0) return false;
    file->end_of_file = file->end_of_allocation;
  }
  if (!file->staged.page.empty() && !write_journal(file->path, file->staged)) return false;
  // What is new must not hide damage to the page that it begins in.
  if (!are_as_written(file, file->committed / kPage * kPage, file->committed)) return false;
  file->committed = file->end_of_file;
  return file->staged.page.empty() ? renew_sums(file) : overwrite(file);
}

herr_t close_file(H5FD_t* handle) {
  const std::unique_ptr<StagedFile> file(self(handle));
  if (!file->state->discard && !commit(file.get())) fail(file.get());
  if (file->state->discard &&
      file->writable) {  // a failed write may have put part of its bytes there
    // Cutting a file back needs no space; if even that fails the extra bytes are harmless.
    if (ftruncate(file->descriptor, static_cast<off_t>(file->committed)) != 0) fail(file.get());
  }
  if (::close(file->descriptor) != 0) fail(file.get());
  return 0;  // the session's outcome is in the state; HDF5 must always get rid of its handle
}

int compare_files(const H5FD_t* a, const H5FD_t* b) {
  const auto* file_a = self(a);
  const auto* file_b = self(b);
  if (file_a->device != file_b->device) return file_a->device < file_b->device ? -1 : 1;
  if (file_a->inode != file_b->inode) return file_a->inode < file_b->inode ? -1 : 1;
  return 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  if (flags != nullptr) {
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA;
  }
  return 0;
}

haddr_t get_end_of_allocation(const H5FD_t* file, H5FD_mem_t) {
  return self(file)->end_of_allocation;
}
haddr_t get_end_of_file(const H5FD_t* file, H5FD_mem_t) { return self(file)->end_of_file; }
herr_t set_end_of_allocation(H5FD_t* file, H5FD_mem_t, haddr_t address) {
  self(file)->end_of_allocation = address;
  return 0;
}

herr_t read_bytes(H5FD_t* handle, H5FD_mem_t, hid_t, haddr_t address, std::size_t size,
                  void* buffer) {
  StagedFile* file = self(handle);
  auto* out = static_cast<std::byte*>(buffer);
  errno = 0;
  try {
    if (!are_as_written(file, address, address + size) ||
        !read_all(file->descriptor, out, size, address)) {
      file->state->read_error = errno;
      return -1;
    }
  } catch (...) {  // exceptions must not cross the C library
    return -1;
  }
  const haddr_t end = address + size;
  const Pages& staged = file->staged.page;
  for (auto it = staged.lower_bound(address / kPage); it != staged.end(); ++it) {
    const haddr_t page_begin = it->first * kPage;
    if (page_begin >= end) break;
    const haddr_t from = std::max(address, page_begin);
    const haddr_t to = std::min({end, page_begin + kPage, file->staged.end});
    if (from < to)
      std::memcpy(out + (from - address), it->second.data() + (from - page_begin), to - from);
  }
  return 0;
}

/// Stages new content of already committed bytes.
bool stage(StagedFile* file, const std::byte* data, haddr_t begin, haddr_t end) {
  file->staged.end = file->committed;
  Pages& staged = file->staged.page;
  for (haddr_t index = begin / kPage; index * kPage < end; ++index) {
    const haddr_t page_begin = index * kPage;
    auto it = staged.find(index);
    if (it == staged.end()) {
      it = staged.emplace(index, Page{}).first;
      const haddr_t known = std::min<haddr_t>(kPage, file->committed - page_begin);
      if (!are_as_written(file, page_begin, page_begin + known)) return false;
      if (!read_all(file->descriptor, it->second.data(), known, page_begin)) return false;
    }
    const haddr_t from = std::max(begin, page_begin);
    const haddr_t to = std::min(end, page_begin + kPage);
    std::memcpy(it->second.data() + (from - page_begin), data + (from - begin), to - from);
  }
  return true;
}

herr_t write_bytes(H5FD_t* handle, H5FD_mem_t, hid_t, haddr_t address, std::size_t size,
                   const void* buffer) {
  StagedFile* file = self(handle);
  if (file->state->discard) return 0;  // lets HDF5 finish closing a session that is already lost
  const auto* data = static_cast<const std::byte*>(buffer);
  const haddr_t end = address + size;
  const haddr_t split = std::clamp(file->committed, address, end);
  errno = 0;
  try {
    if (split > address && !stage(file, data, address, split)) return fail(file);
  } catch (...) {  // no memory; exceptions must not cross the C library
    errno = ENOMEM;
    return fail(file);
  }
  if (end > split && !write_all(file->descriptor, data + (split - address), end - split, split)) {
    return fail(file);
  }
  file->end_of_file = std::max(file->end_of_file, end);
  return 0;
}

herr_t flush_file(H5FD_t* handle, hid_t, hbool_t) {
  StagedFile* file = self(handle);
  if (file->state->discard) return 0;
  errno = 0;
  return commit(file) ? 0 : fail(file);
}

/// Extends the file, never cuts it: bytes past the allocation are harmless, bytes below `committed`
/// must stay.
herr_t truncate_file(H5FD_t* handle, hid_t, hbool_t) {
  StagedFile* file = self(handle);
  if (file->state->discard || file->end_of_file >= file->end_of_allocation) return 0;
  errno = 0;
  if (ftruncate(file->descriptor, static_cast<off_t>(file->end_of_allocation)) != 0)
    return fail(file);
  file->end_of_file = file->end_of_allocation;
  return 0;
}

H5FD_class_t make_driver() {
  H5FD_class_t driver{};
  driver.name = "acinus_staged";
  driver.maxaddr = kMaxAddress;
  driver.fc_degree = H5F_CLOSE_STRONG;  // closing the file closes what is still open in it
  driver.fapl_size = sizeof(DriverInfo);
  driver.open = open_file;
  driver.close = close_file;
  driver.cmp = compare_files;
  driver.query = query;
  driver.get_eoa = get_end_of_allocation;
  driver.set_eoa = set_end_of_allocation;
  driver.get_eof = get_end_of_file;
  driver.read = read_bytes;
  driver.write = write_bytes;
  driver.flush = flush_file;
  driver.truncate = truncate_file;
  const H5FD_mem_t map[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(map), std::end(map), std::begin(driver.fl_map));
  return driver;
}

}  // namespace

herr_t use_staged_driver(hid_t access, StagedState* state, bool sums) {
  static const H5FD_class_t driver = make_driver();
  static const hid_t id = H5FDregister(&driver);
  const DriverInfo info{state, sums};
  return id < 0 ? -1 : H5Pset_driver(access, id, &info);
}

}  // namespace acinus::io::h5
