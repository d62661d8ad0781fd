#include "runs/scene/bounded_json.hpp"

#include <fmt/format.h>

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

#define ACINUS_INSTANTIATE(Json)                                             \
  template Json parse_bounded<Json>(const std::string&, const std::string&); \
  template Json parse_or_discard<Json>(const std::string&);                  \
  template std::string text_at<Json>(const Json&, const char*);
ACINUS_INSTANTIATE(nlohmann::json)
ACINUS_INSTANTIATE(nlohmann::ordered_json)
#undef ACINUS_INSTANTIATE

}  // namespace acinus::runs
