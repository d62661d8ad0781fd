#pragma once
/// Lock files, held by one process at a time. The system releases a lock when its process ends, in
/// whatever way, so no stale lock remains.

#include <optional>
#include <string>

namespace acinus::io {

/// Lock, held until it is destroyed. Not inherited by child processes. The file names the holder.
/// Over a network file system it holds between machines where the file system has locks (NFS 3 with
/// a lock service, NFS 4). Accounts that may not write in the folder can neither take nor open it.
class FileLock {
 public:
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

  /// Takes the lock and writes the holder's name into the file, which is made if needed.
  /// @param patience_s  s, time to retry: is_locked() of other processes holds the lock for a
  ///                    moment
  /// @return nothing while another process (or another FileLock of this one) holds it
  /// @throws Error(kFileError) if the file cannot be opened. On file systems without locks nothing
  /// is held and nothing refused.
  static std::optional<FileLock> try_take(const std::string& path, double patience_s = 0);
  /// Takes the lock; waits while another holds it.
  static FileLock take(const std::string& path);

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  void sign() const;
  int descriptor_ = -1;
};

/// True if another process holds the lock of a file; false if there is no such file.
bool is_locked(const std::string& path);

/// Name of the lock's holder, "process 4711 on host since 2026-01-31 12:00:00 UTC"; "another
/// process" if the file does not name it.
/// @param patience_s  s, time to retry: a process that has just taken the lock has not signed yet
std::string name_holder(const std::string& path, double patience_s = 0);

}  // namespace acinus::io
