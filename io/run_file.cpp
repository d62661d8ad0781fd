#include "io/run_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/page_sums.hpp"
#include "io/run_rows.hpp"
#include "io/xdmf.hpp"

namespace acinus::io {
namespace {

using h5::Access;
using h5::File;
using h5::Format;

constexpr std::int64_t kRunFileSchema[2] = {1, 2};

File create_skeleton(const std::string& path, bool filtered) {
  File file = File::create(path, Format::kEarliest);
  file.write_attribute("/", "schema", "acinus/run");
  file.write_attribute("/", "schema_version", kRunFileSchema);
  file.write_attribute("/", "compression", filtered ? "fast" : "none");
  file.write_attribute("/", "base_units", "um s nN");
  return file;
}

void check_key(const std::string& key) {
  check(!key.empty() && key.find('/') == std::string::npos && key != ".",
        "internal error: \"" + key + "\" cannot be a provenance key", Exit::kInternal);
}

}  // namespace

RunFile::RunFile(std::string path, const RunFileOptions& options)
    : path_(std::move(path)), options_(options) {
  check(options.buffered_rows >= 1, "internal error: buffered_rows must be at least 1",
        Exit::kInternal);
}

RunFile::~RunFile() {
  try {
    flush();
  } catch (...) {  // a destructor cannot report; close() can
  }
}

RunFile RunFile::create(const std::string& path,
                        const std::map<std::string, std::string>& provenance,
                        const RunFileOptions& options) {
  for (const auto& [key, value] : provenance) check_key(key);
  RunFile run(path, options);
  File file = create_skeleton(path, options.compress);
  create_index_rows(file, options.compress);
  create_event_rows(file);
  create_samples(file, kSeries);
  create_samples(file, kObservables);
  file.create_group("/provenance");
  for (const auto& [key, value] : provenance) file.write_text("/provenance/" + key, value);
  file.close();
  return run;
}

RunFile RunFile::open_for_append(const std::string& path, const RunFileCounts& keep,
                                 const RunFileOptions& options) {
  if (h5::is_damaged(path)) return recover(path, keep, options);
  RunFile run(path, options);
  const std::string partial = path + ".tmp";
  const RemoveUnlessMoved cleanup{partial};
  {
    const File old = File::open(path, Access::kAppend);  // puts a killed session's journal in place
    check_run_schema(old);
    check(old.read_attribute("/", "schema_version").at(1) == kRunFileSchema[1],
          path +
              ": was begun by another version, whose frames have other columns. Continue it with "
              "that version, or run the scene anew in another folder (--out).",
          Exit::kCannotContinue);
    const RunFileCounts found = read_counts(old);
    if (std::min({keep.frame, keep.series, keep.event, keep.observable}) < 0 ||
        keep.frame > found.frame || keep.series > found.series || keep.event > found.event ||
        keep.observable > found.observable) {
      throw Error(fmt::format("{}: holds {} frames, {} samples, {} events, {} rows of observables, "
                              "but {}, {}, {}, {} are to be continued. It belongs to another run "
                              "or was cut; start again with --overwrite.",
                              path, found.frame, found.series, found.event, found.observable,
                              keep.frame, keep.series, keep.event, keep.observable),
                  Exit::kFileError);
    }
    const bool filtered = old.read_text_attribute("/", "compression") != "none";
    run.options_.compress = filtered;
    File fresh = create_skeleton(partial, filtered);
    if (keep.frame > 0) {
      run.layout_ = read_layout(old);
      run.frame_ = read_frame_index(old, run.layout_, keep.frame);
      copy_frames(old, fresh, run.layout_, run.frame_);
    } else {
      create_index_rows(fresh, filtered);
    }
    copy_samples(old, fresh, kSeries, keep.series);
    copy_samples(old, fresh, kObservables, keep.observable);
    run.event_cell_written_ = copy_events(old, fresh, keep.event);
    fresh.copy_object_from(old, "/provenance");
    run.series_ = read_sample_names(old, kSeries);
    run.series_known_ = !run.series_.name.empty();
    run.observable_ = read_sample_names(old, kObservables);
    fresh.close();
  }
  run.written_ = keep;
  replace_run_file(partial, path);
  if (!run.frame_.empty()) write_xdmf(sidecar_of(path), path, run.frame_, run.layout_);
  return run;
}

void RunFile::append(const Frame& frame, std::span<const SeriesValue> observables) {
  check_frame(frame);
  append(source_of(frame), observables);
}

void RunFile::append(const FrameSource& frame, std::span<const SeriesValue> observables) {
  check_source(frame);
  RowNames observed = observable_;
  if (!observables.empty()) {
    if (observed.name.empty()) observed = names_of(observables, kObservables);
    check_sample(observables, observed, kObservables);
  }
  RunLayout layout = layout_of(frame);
  if (!frame_.empty()) {
    check_same_layout(layout_, layout);
    check(frame.time_s > frame_.back().time_s,
          fmt::format("internal error while writing a frame: time {} s does not come after {} s",
                      frame.time_s, frame_.back().time_s),
          Exit::kInternal);
  }
  File file = File::open(path_, Access::kAppend);
  const bool filtered = options_.compress;
  if (frame_.empty()) create_field_rows(file, layout, filtered);
  FrameWrite w{file, frame, frame_.empty() ? nullptr : &frame_.back(), last_hash_, filtered,
               {},   {}};
  write_frame(w);
  write_index(file, static_cast<std::int64_t>(frame_.size()), w.index);
  if (!observables.empty()) {
    std::vector<double> row;
    for (const SeriesValue& value : observables) row.push_back(value.value);
    if (observable_.name.empty()) create_sample_rows(file, kObservables, observed);
    write_samples(file, kObservables, observed, written_.observable, row);
  }
  const RunFileCounts after{n_frame() + 1, counts().series, counts().event,
                            written_.observable + (observables.empty() ? 0 : 1)};
  const std::int64_t event_cell = write_rows_of_buffers(file);
  file.flush();
  write_counts(file, after);
  file.close();

  layout_ = std::move(layout);
  observable_ = std::move(observed);
  frame_.push_back(std::move(w.index));
  last_hash_ = std::move(w.hash);
  keep_buffers_written(after, event_cell);
  write_xdmf(sidecar_of(path_), path_, frame_, layout_);
}

void RunFile::append_series(std::span<const SeriesValue> sample) {
  RowNames first;
  if (series_.name.empty()) first = names_of(sample, kSeries);
  check_sample(sample, first.name.empty() ? series_ : first, kSeries);
  if (!first.name.empty()) series_ = std::move(first);
  for (const SeriesValue& value : sample) series_buffer_.push_back(value.value);
  if (counts().series - written_.series >= options_.buffered_rows) flush();
}

void RunFile::append_event(const Event& event) {
  check_finite(event.time_s, "event time");
  event_buffer_.push_back(event);
  if (std::ssize(event_buffer_) >= options_.buffered_rows) flush();
}

std::int64_t RunFile::write_rows_of_buffers(File& file) {
  if (!series_buffer_.empty()) {
    if (!series_known_) create_sample_rows(file, kSeries, series_);
    write_samples(file, kSeries, series_, written_.series, series_buffer_);
  }
  return write_events(file, written_.event, event_cell_written_, event_buffer_);
}

void RunFile::keep_buffers_written(const RunFileCounts& after, std::int64_t event_cell) {
  series_known_ = series_known_ || !series_buffer_.empty();
  written_ = after;
  event_cell_written_ = event_cell;
  series_buffer_.clear();
  event_buffer_.clear();
}

void RunFile::flush() {
  if (series_buffer_.empty() && event_buffer_.empty()) return;
  const RunFileCounts after = counts();
  File file = File::open(path_, Access::kAppend);
  const std::int64_t event_cell = write_rows_of_buffers(file);
  file.flush();
  write_counts(file, after);
  file.close();
  keep_buffers_written(after, event_cell);
}

void RunFile::close() { flush(); }

void RunFile::set_provenance(const std::string& key, const std::string& value) {
  check_key(key);
  File file = File::open(path_, Access::kAppend);
  file.write_text("/provenance/" + key, value);
  file.close();
}

RunFileCounts RunFile::counts() const {
  const auto n_series = std::max<std::int64_t>(std::ssize(series_.name), 1);
  return {n_frame(), written_.series + std::ssize(series_buffer_) / n_series,
          written_.event + std::ssize(event_buffer_), written_.observable};
}

}  // namespace acinus::io
