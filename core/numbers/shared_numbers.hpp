#pragma once
/// Numbers that are never changed, shared by all copies.

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace acinus {

/// Constant array of numbers. A copy has the same storage: the owners are the states of which one
/// was copied from the other, such as that of a linearisation point or of the next set of cells.
class SharedNumbers {
 public:
  SharedNumbers() = default;
  SharedNumbers(std::vector<double> values)  // NOLINT: it is such an array
      : values_(values.empty() ? nullptr
                               : std::make_shared<const std::vector<double>>(std::move(values))) {}

  bool empty() const { return values_ == nullptr; }
  std::size_t size() const { return empty() ? 0 : values_->size(); }
  /// Part of the memory that falls to this copy, bytes.
  std::size_t memory() const {
    return empty() ? 0
                   : values_->capacity() * sizeof(double) /
                         static_cast<std::size_t>(values_.use_count());
  }
  const double* data() const { return empty() ? nullptr : values_->data(); }
  const double* begin() const { return data(); }
  const double* end() const { return data() + size(); }
  const double& operator[](std::size_t k) const { return (*values_)[k]; }
  bool operator==(const SharedNumbers& o) const {
    return values_ == o.values_ || (!empty() && !o.empty() && *values_ == *o.values_);
  }

 private:
  std::shared_ptr<const std::vector<double>> values_;  ///< null: none
};

}  // namespace acinus
