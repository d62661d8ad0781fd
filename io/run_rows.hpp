#pragma once
/// Datasets of a run file: their storage, writing and reading. Used by RunFile and RunReader only.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/frame.hpp"
#include "io/frame_source.hpp"
#include "io/hdf5.hpp"
#include "io/row_writer.hpp"
#include "io/run_layout.hpp"

namespace acinus::io {

inline constexpr std::int64_t kTableChunkRows = 4096;  ///< of kFrameTables, unfiltered
inline constexpr std::int64_t kIndexChunkRows = 1024;
inline constexpr int kCodeWidth = 32;
inline constexpr int kMessageWidth = 512;

void create_index_rows(h5::File& file, bool filtered);
void create_field_rows(h5::File& file, const RunLayout& layout, bool filtered);
void create_event_rows(h5::File& file);

/// Dataset with the end of each frame's rows, after a first zero.
inline std::string offsets_of(const FrameTable& table) {
  return std::string(table.group) + "/frame_offset";
}

/// Groups whose rows are samples of named numbers.
inline constexpr char kSeries[] = "/series", kObservables[] = "/observables";

/// Creates a group without columns or rows.
void create_samples(h5::File& file, const std::string& group);
void create_sample_rows(h5::File& file, const std::string& group, const RowNames& names);

/// Path of the XDMF file beside a run file.
std::string sidecar_of(const std::string& path);
/// Replaces an old run file by a complete new one, with the checksums of its pages.
void replace_run_file(const std::string& from, const std::string& to);

/// Reads rows of a dataset with one value each.
/// @throws Error(kFileError) where rows are missing, or have several values
template <class T>
std::vector<T> read_column(const h5::File& file, const std::string& name, std::int64_t first,
                           std::int64_t n) {
  std::vector<T> value = file.read_rows<T>(name, first, n);
  check(std::ssize(value) == n,
        file.path() + ": dataset " + name + " has rows of several values. The file is damaged.",
        Exit::kFileError);
  return value;
}

/// Frame in the course of being written.
struct FrameWrite {
  h5::File& file;
  const FrameSource& frame;
  const FrameIndex* last;         ///< previous frame; null for the first
  const StaticHashes& last_hash;  ///< not known after a restart
  bool filtered;
  FrameIndex index;   ///< out: position of the frame
  StaticHashes hash;  ///< out: of this frame
};

/// Writes a frame's arrays after those of the last one. Topology and cell data whose hash did not
/// change are not written again: the index repeats their place.
void write_frame(FrameWrite& w);
/// Writes row `k` of /VTKHDF/Steps and of the tables' frame_offset.
void write_index(h5::File& file, std::int64_t k, const FrameIndex& index);

/// Writes rows of samples. @param value  [row][column]
void write_samples(h5::File& file, const std::string& group, const RowNames& names,
                   std::int64_t first_row, std::span<const double> value);
/// Writes events; returns the number of rows of /events/cell_id afterwards.
std::int64_t write_events(h5::File& file, std::int64_t first_row, std::int64_t n_cell_written,
                          std::span<const Event> event);
/// Writes the counts that make rows valid. To be called after a flush.
void write_counts(h5::File& file, const RunFileCounts& counts);

/// Throws Error(kFileError) unless the file is a run file of a version that can be read.
void check_run_schema(const h5::File& file);
RunFileCounts read_counts(const h5::File& file);
RunLayout read_layout(const h5::File& file);
std::vector<FrameIndex> read_frame_index(const h5::File& file, const RunLayout& layout,
                                         std::int64_t n_frame);
/// Names and units of samples in their order; none if there are no samples, or no such group.
RowNames read_sample_names(const h5::File& file, const std::string& group);
/// First n_row values of each sample column, by name.
std::map<std::string, std::vector<double>> read_samples(const h5::File& file,
                                                        const std::string& group,
                                                        std::int64_t n_row);

std::vector<Event> read_events(const h5::File& file, std::int64_t first, std::int64_t n);

/// Copies frames into a file without /VTKHDF, /cells, /interface; sets NSteps.
void copy_frames(const h5::File& from, h5::File& to, const RunLayout& layout,
                 const std::vector<FrameIndex>& frame);
void copy_samples(const h5::File& from, h5::File& to, const std::string& group, std::int64_t n_row);
/// Copies events; returns the number of rows of /events/cell_id kept.
std::int64_t copy_events(const h5::File& from, h5::File& to, std::int64_t n_row);

/// Names and units of a first row. Throws Error(kInternal) on an invalid one.
RowNames names_of(std::span<const SeriesValue> sample, const std::string& group);
/// Throws Error(kInternal) unless every value is finite and names, units and order match.
void check_sample(std::span<const SeriesValue> sample, const RowNames& names,
                  const std::string& group);

}  // namespace acinus::io
