#pragma once
/// A file that one process at a time holds. The system lets go of it when the process ends, however
/// it ends, so no stale lock is ever left behind.

#include <optional>
#include <string>

namespace acinus::io {

/// Holds the lock until it is destroyed. Not inherited by programs started meanwhile. The file
/// names the process while it holds. Over a network file system it holds between machines where the
/// file system has locks (NFS 3 with a lock service, NFS 4). Accounts without the right to
/// write in the folder can neither take nor open it.
class FileLock {
 public:
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

  /// Makes the file if needed, and writes into it who holds it now.
  /// @param patience_s  how long to try: is_locked() of others holds the lock for a moment
  /// @return nothing while another process (or another FileLock of this one) holds it
  /// @throws Error(kFileError) if the file cannot be opened. On file systems without locks nothing
  ///         is held and nothing refused.
  static std::optional<FileLock> try_take(const std::string& path, double patience_s = 0);
  /// The same, but waits.
  static FileLock take(const std::string& path);

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  void sign() const;
  int descriptor_ = -1;
};

/// Whether someone else holds the lock of a file; false if there is no such file.
bool is_locked(const std::string& path);

/// Which process holds the lock, "process 4711 on host since 2026-01-31 12:00:00 UTC"; "another
/// process" if the file does not say.
/// @param patience_s  how long to look: a process that has just taken the lock has not signed yet
std::string name_holder(const std::string& path, double patience_s = 0);

}  // namespace acinus::io
