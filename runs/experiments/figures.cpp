#include "runs/experiments/figures.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace acinus::runs {

nlohmann::ordered_json finite_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json finite_number(const std::optional<double>& value) {
  return value ? finite_number(*value) : nlohmann::ordered_json(nullptr);
}

}  // namespace acinus::runs
