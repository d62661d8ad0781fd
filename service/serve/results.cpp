#include "service/serve/results.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/run_reader.hpp"
#include "runs/scene/bounded_json.hpp"

namespace acinus::service {

RunResult read_run_result(const std::string& run_folder) {
  RunResult result;
  const io::RunReader reader(run_folder + "/run.vtkhdf");
  std::map<std::string, std::vector<double>> column = reader.observables();
  result.unit = reader.observable_unit();
  const std::vector<double> time = std::exchange(column["time"], {});
  for (const auto& [name, value] : column) {
    runs::TimeCurve& curve = result.curve[name];
    for (std::size_t k = 0; k < std::min(time.size(), value.size()); ++k) {
      if (!std::isfinite(value[k])) continue;
      curve.time.push_back(time[k]);
      curve.value.push_back(value[k]);
    }
  }
  result.curve.erase("time");
  return result;
}

std::string result_text(const RunResult& result) {
  nlohmann::ordered_json j = nlohmann::ordered_json::object();
  for (const auto& [name, curve] : result.curve)
    j[name] = {{"unit", result.unit.at(name)}, {"time_s", curve.time}, {"value", curve.value}};
  return j.dump();
}

void keep_result(const std::string& file, const RunResult& result) {
  io::write_text_file(file, result_text(result) + "\n");
}

std::optional<RunResult> find_result(const std::string& file) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code)) return std::nullopt;
  try {
    RunResult result;
    const auto j = runs::parse_or_discard<nlohmann::json>(io::read_text_file(file));
    for (const auto& [name, one] : j.items()) {
      result.unit[name] = one.at("unit");
      result.curve[name] = {one.at("time_s").get<std::vector<double>>(),
                            one.at("value").get<std::vector<double>>()};
    }
    return result;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace acinus::service
