#pragma once
/// Run file: a VTKHDF time series of UnstructuredGrids with the analysis tables beside it, and the
/// XDMF sidecar run.xmf for older readers. docs/view/README.md describes the viewers.
///
/// - /VTKHDF: triangles (type 5) first, then one vertex (type 1) per sphere; one part per topology
/// - /cells: one row per biological cell and frame, rows frame_offset[k] .. frame_offset[k + 1]
/// - /interface: one row per DCM-CBM pair in contact, ragged in the same way
/// - /contacts: one row per contact of two cells or of a cell with the boundary, if asked for
/// - /series: one row per sample; attribute n_row counts the finished ones
/// - /observables: what a scene measures, one row per frame that has some; attribute n_row
/// - /events: time, code, message, and ragged cell_id (cell_offset); attribute n_row
/// - /provenance: text, one dataset per key
///
/// Every dataset has a `unit` attribute. /VTKHDF/Steps/@NSteps is written last: it counts the
/// finished frames.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/frame_source.hpp"
#include "io/run_layout.hpp"

namespace acinus::io {

namespace h5 {
class File;
}

struct RunFileOptions {
  bool compress = true;    ///< shuffle, deflate 1, checksums
  int buffered_rows = 64;  ///< series rows and events kept in memory until a flush
};

/// Writer of one run. The file is open only inside a call, so others can read while the run goes
/// on, and each call is all or nothing: after an Error the file and this object are as before the
/// call. Errors: Exit::kFileError for the disk; Exit::kInternal for a value that is not finite,
/// sizes that do not fit, or fields that differ from the first frame's.
class RunFile {
 public:
  /// Makes a new file at `path` (an existing one is replaced) with its provenance. The sidecar has
  /// the same name with the ending .xmf and appears with the first frame.
  static RunFile create(const std::string& path,
                        const std::map<std::string, std::string>& provenance,
                        const RunFileOptions& options = {});

  /// Continues a file cut back to the given counts. The kept part is copied to a new file that then
  /// replaces the old one, so a file damaged past its finished frames is repaired. Every byte of it
  /// is checked first; where bytes are not those that were written, everything still readable is
  /// kept, the rest is listed in lost(), and the damaged file stays under the ending `.damaged`.
  /// Cost: two readings and a copy of the file.
  static RunFile open_for_append(const std::string& path, const RunFileCounts& keep,
                                 const RunFileOptions& options = {});

  RunFile(RunFile&&) = default;
  RunFile& operator=(RunFile&&) = default;
  /// Flushes the buffers if possible. Call close() to be notified of failure.
  ~RunFile();

  /// Writes a frame and the buffers, and renews the sidecar. Times must increase.
  /// @param observables  one row of /observables, with the same names, units and order each time;
  ///                     empty: this frame has none
  void append(const FrameSource& frame, std::span<const SeriesValue> observables = {});
  void append(const Frame& frame, std::span<const SeriesValue> observables = {});
  /// Appends one sample of the time series; all samples have the same names and units in the same
  /// order.
  void append_series(std::span<const SeriesValue> sample);
  void append_event(const Event& event);
  /// Sets or replaces one key of /provenance.
  void set_provenance(const std::string& key, const std::string& value);
  void flush();
  void close();

  int n_frame() const { return static_cast<int>(frame_.size()); }
  /// Parts of a damaged file that open_for_append() could not keep, e.g. "frame 3 at 0.5 h", or
  /// "nothing" where only unused bytes were damaged. Empty: the file was as written.
  const std::vector<std::string>& lost() const { return lost_; }
  /// Numbers of rows, buffered ones included: flush() before a checkpoint stores them.
  RunFileCounts counts() const;
  const std::string& path() const { return path_; }

 private:
  RunFile(std::string path, const RunFileOptions& options);
  static RunFile recover(const std::string& path, const RunFileCounts& keep,
                         const RunFileOptions& options);
  /// Writes the buffered rows; returns the rows of /events/cell_id afterwards. Changes nothing in
  /// memory.
  std::int64_t write_rows_of_buffers(h5::File& file);
  void keep_buffers_written(const RunFileCounts& after, std::int64_t event_cell);

  std::string path_;
  RunFileOptions options_;
  RunLayout layout_;
  std::vector<FrameIndex> frame_;  ///< finished frames
  StaticHashes last_hash_;         ///< of the last frame, to detect unchanged arrays
  RunFileCounts written_;          ///< rows in the file
  std::int64_t event_cell_written_ = 0;
  RowNames series_;            ///< in the order of the first sample
  bool series_known_ = false;  ///< true if the datasets exist in the file
  RowNames observable_;  ///< in the order of the first row; the datasets exist if there are any
  std::vector<double> series_buffer_;  ///< [row][n_series]
  std::vector<Event> event_buffer_;
  std::vector<std::string> lost_;
};

}  // namespace acinus::io
