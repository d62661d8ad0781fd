#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/page_sums.hpp"
#include "io/run_file.hpp"
#include "io/run_reader.hpp"
#include "io/run_rows.hpp"
#include "io/xdmf.hpp"

namespace acinus::io {
namespace {

using h5::Access;
using h5::File;

/// Reader of a damaged file: failures are recorded, and reading goes on.
class DamagedReads {
 public:
  explicit DamagedReads(std::vector<std::string>& lost) : lost_(lost) {}

  bool operator()(const std::string& what, const std::function<void()>& read) {
    try {
      read();
      return true;
    } catch (const Error& error) {
      if (error.code() != Exit::kFileError) throw;
      lost_.push_back(what);
      return false;
    }
  }

  /// Calls read(first, n) for blocks of rows that are stored together.
  void in_blocks(const std::string& what, std::int64_t n_row,
                 const std::function<void(std::int64_t, std::int64_t)>& read) {
    for (std::int64_t first = 0; first < n_row; first += kIndexChunkRows) {
      const std::int64_t n = std::min(kIndexChunkRows, n_row - first);
      (*this)(fmt::format("{} {} to {}", what, first, first + n - 1), [&] { read(first, n); });
    }
  }

 private:
  std::vector<std::string>& lost_;
};

std::map<std::string, std::string> read_provenance(const File& file, DamagedReads& attempt) {
  std::vector<std::string> keys;
  attempt("the provenance", [&] { keys = file.members("/provenance"); });
  std::map<std::string, std::string> provenance;
  for (const std::string& key : keys)
    attempt("the provenance of " + key,
            [&] { provenance[key] = file.read_text("/provenance/" + key); });
  return provenance;
}

/// Samples in the order of their rows: [row][column].
struct SampleRows {
  RowNames names;
  std::vector<double> value;
  std::int64_t n_row() const {
    return names.name.empty() ? 0 : std::ssize(value) / std::ssize(names.name);
  }
};

SampleRows read_readable_samples(const File& file, const std::string& group,
                                 const std::string& what, std::int64_t n_row,
                                 DamagedReads& attempt) {
  SampleRows samples;
  if (!attempt(what, [&] { samples.names = read_sample_names(file, group); })) return {};
  if (samples.names.name.empty()) return samples;
  attempt.in_blocks(what, n_row, [&](std::int64_t first, std::int64_t n) {
    std::vector<std::vector<double>> column;
    for (const std::string& name : samples.names.name)
      column.push_back(read_column<double>(file, group + "/" + name, first, n));
    for (std::int64_t row = 0; row < n; ++row)
      for (const auto& values : column) samples.value.push_back(values[row]);
  });
  return samples;
}

/// Moves a file with its journal and the checksums of its pages.
void move_aside(const std::string& from, const std::string& to) {
  replace_file(from, to);
  for (const auto& beside : {h5::journal_of, h5::sums_of}) {
    std::error_code missing;
    std::filesystem::remove(beside(to), missing);
    std::filesystem::rename(beside(from), beside(to), missing);
  }
}

}  // namespace

RunFile RunFile::recover(const std::string& path, const RunFileCounts& keep,
                         const RunFileOptions& options) {
  std::vector<std::string> lost;
  DamagedReads attempt(lost);
  std::optional<File> old;
  attempt("all that was written before", [&] { old.emplace(File::open(path, Access::kRead)); });
  const std::string partial = std::filesystem::path(path).replace_extension(".tmp").string();
  RunFile run =
      create(partial, old ? read_provenance(*old, attempt) : std::map<std::string, std::string>{},
             options);
  if (old) {
    attempt(fmt::format("all {} frames", keep.frame), [&] {
      const RunReader reader(path);
      for (int k = 0; k < std::min<std::int64_t>(keep.frame, reader.n_frame()); ++k)
        attempt(fmt::format("frame {} at {:.6g} h", k, reader.time_s(k) / 3600),
                [&] { run.append(reader.frame(k)); });
    });
    const SampleRows series =
        read_readable_samples(*old, kSeries, "samples of the series", keep.series, attempt);
    std::vector<SeriesValue> sample(series.names.name.size());
    for (std::int64_t row = 0; row < series.n_row(); ++row) {
      for (std::size_t c = 0; c < sample.size(); ++c)
        sample[c] = {series.names.name[c], series.names.unit[c],
                     series.value[row * sample.size() + c]};
      run.append_series(sample);
    }
    attempt.in_blocks("events", keep.event, [&](std::int64_t first, std::int64_t n) {
      for (const Event& event : read_events(*old, first, n)) run.append_event(event);
    });
    run.flush();
    const SampleRows observed =
        read_readable_samples(*old, kObservables, "rows of observables", keep.observable, attempt);
    if (observed.n_row() > 0) {
      run.observable_ = observed.names;
      run.written_.observable = observed.n_row();
      File file = File::open(partial, Access::kAppend);
      create_sample_rows(file, kObservables, observed.names);
      write_samples(file, kObservables, observed.names, 0, observed.value);
      file.flush();
      write_counts(file, run.counts());
      file.close();
    }
    old.reset();
  }
  move_aside(path, path + ".damaged");
  replace_run_file(partial, path);
  run.path_ = path;
  run.lost_ = lost.empty() ? std::vector<std::string>{"nothing"} : std::move(lost);
  if (!run.frame_.empty()) write_xdmf(sidecar_of(path), path, run.frame_, run.layout_);
  return run;
}

}  // namespace acinus::io
