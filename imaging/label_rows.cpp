#include "imaging/label_rows.hpp"

#include <utility>

namespace acinus::imaging {

std::size_t LabelRows::count_rows() const {
  std::size_t n = 0;
  for (const LabelLine& l : line) n += l.size();
  return n;
}

void append_row(int end, Label label, LabelLine& line) {
  if (!line.empty() && line.back().label == label)
    line.back().end = end;
  else
    line.push_back({end, label});
}

void append_voxels(int first, std::span<const Label> label, Label fill, LabelLine& line) {
  // The rows are collected first, so that a line takes no more memory than it needs.
  thread_local LabelLine added;
  added.clear();
  const int begin = line.empty() ? 0 : line.back().end;
  if (begin < first) append_row(first, fill, added);
  const int n = static_cast<int>(label.size());
  for (int x = 0; x < n;) {
    int end = x + 1;
    while (end < n && label[end] == label[x]) ++end;
    append_row(first + end, label[x], added);
    x = end;
  }
  if (added.empty()) return;
  const bool joined = !line.empty() && line.back().label == added.front().label;
  if (joined) line.back().end = added.front().end;
  line.reserve(line.size() + added.size() - (joined ? 1 : 0));
  line.insert(line.end(), added.begin() + (joined ? 1 : 0), added.end());
}

void complete_lines(Label fill, LabelRows& image) {
  for (LabelLine& line : image.line)
    if (line.empty() || line.back().end < image.size[0]) append_row(image.size[0], fill, line);
}

LabelRows make_rows(const LabelImage& image) {
  LabelRows rows{image, {}, 0};
  rows.line.resize(static_cast<std::size_t>(image.size[1]) * image.size[2]);
  const std::span<const Label> all = image.label;
  const std::size_t n = image.size[0];
  for (std::size_t k = 0; k < rows.line.size(); ++k)
    append_voxels(0, all.subspan(k * n, n), 0, rows.line[k]);
  return rows;
}

}  // namespace acinus::imaging
