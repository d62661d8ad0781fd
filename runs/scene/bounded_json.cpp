#include "runs/scene/bounded_json.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/json_size.hpp"

namespace acinus::runs {

template <class Json>
Json parse_bounded(const std::string& text, const std::string& what) {
  const std::string fault = fault_of_json_size(text);
  check(fault.empty(), fmt::format("{}: {}. It is damaged or not of this program.", what, fault));
  return Json::parse(text, nullptr, false);
}

template <class Json>
Json parse_or_discard(const std::string& text) {
  if (!fault_of_json_size(text).empty()) return Json(Json::value_t::discarded);
  return Json::parse(text, nullptr, false);
}

template <class Json>
std::string text_at(const Json& object, const char* name) {
  if (!object.is_object()) return "";
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->template get<std::string>() : "";
}

template <class Json>
int count_at(const Json& object, const char* name, const std::string& what) {
  const Json& value = object.at(name);
  const bool counts = value.is_number_unsigned() &&
                      value.template get<std::uint64_t>() <= std::numeric_limits<int>::max();
  check(counts, fmt::format("{}: \"{}\" must be a whole number from 0, found {}. The file is "
                            "damaged or not of this program.",
                            what, name, value.dump().substr(0, 40)));
  return value.template get<int>();
}

template <class Json>
double seconds_at(const Json& object, const char* name, const std::string& what, double lowest) {
  const Json& value = object.at(name);
  check(value.is_number() && value.template get<double>() >= lowest,
        fmt::format("{}: \"{}\" must be a number of seconds, found {}. The file is damaged or not "
                    "of this program.",
                    what, name, value.dump().substr(0, 40)));
  return value.template get<double>();
}

#define ACINUS_INSTANTIATE(Json)                                             \
  template Json parse_bounded<Json>(const std::string&, const std::string&); \
  template Json parse_or_discard<Json>(const std::string&);                  \
  template std::string text_at<Json>(const Json&, const char*);              \
  template int count_at<Json>(const Json&, const char*, const std::string&); \
  template double seconds_at<Json>(const Json&, const char*, const std::string&, double);
ACINUS_INSTANTIATE(nlohmann::json)
ACINUS_INSTANTIATE(nlohmann::ordered_json)
#undef ACINUS_INSTANTIATE

}  // namespace acinus::runs
