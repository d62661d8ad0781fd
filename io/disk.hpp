#pragma once
/// Atomic file operations: files appear whole or not at all. Every failure is an Error(kFileError)
/// with the system's reason.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace acinus::io {

/// Makes an empty folder in the system's folder for temporary files. @param prefix  start of its
/// name
std::string make_temporary_folder(const std::string& prefix);

/// Replaces the content of `path` in one step: readers see the old text or the new one. A device or
/// a pipe is written to.
void write_text_file(const std::string& path, std::string_view text);
std::string read_text_file(const std::string& path);

/// Writes all bytes at `address` of an open file. Returns false with errno set when the disk
/// refuses.
bool write_all(int descriptor, const std::byte* data, std::uint64_t size, std::uint64_t address);

/// Writes all of a text to a terminal, pipe or device. Returns 0, or the error number.
int write_stream(int descriptor, std::string_view text);

/// Renames a file over an existing one.
void replace_file(const std::string& from, const std::string& to);
/// Waits until a file, or the entries of a folder, are stored on the disk.
void sync_file(const std::string& path);
void sync_folder(const std::string& folder);

/// Removes a temporary file at the end of a scope, unless it was renamed.
struct RemoveUnlessMoved {
  std::string path;
  ~RemoveUnlessMoved();
};

/// Throws Error(kFileError): "<path>: cannot <attempted>: <system text>. <what to do>."
/// @param error  errno
[[noreturn]] void fail_on_disk(const std::string& path, const std::string& attempted, int error);

/// Advice for a failed file operation, as a sentence without its full stop.
const char* disk_advice(int error);

}  // namespace acinus::io
