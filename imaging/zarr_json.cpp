#include "imaging/zarr_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/json_size.hpp"
#include "geometry/readers/input_file.hpp"

namespace acinus::imaging {
namespace {

std::string shown(const Json& json) {
  constexpr std::size_t kMost = 60;
  if (json.is_array() && json.size() > kMost) return fmt::format("a list of {}", json.size());
  if (json.is_object()) return fmt::format("an object of {} names", json.size());
  const std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() <= kMost ? text : text.substr(0, kMost) + "...";
}

}  // namespace

JsonFile JsonFile::read(const std::string& path) {
  constexpr JsonBounds kBounds{.depth = 40, .names = 4096, .values = 1'000'000, .bytes = 1 << 26};
  const geometry::InputFile file(path);
  const std::string text(file.bytes());
  const std::string fault = fault_of_json_size(text, kBounds);
  check(fault.empty(), fmt::format("{}: {}. The metadata are damaged, or too large to be those of "
                                   "an image.",
                                   path, fault));
  std::string reason;
  Json json(Json::value_t::discarded);
  try {
    json = Json::parse(text);
  } catch (const Json::parse_error& error) {
    reason = fmt::format("no JSON from byte {} on", error.byte);
  } catch (const Json::exception&) {
    reason = "a number beyond all bounds";
  }
  check(reason.empty() && json.is_object(),
        fmt::format("{}: {}. The metadata of zarr are a JSON object: the file is truncated or "
                    "damaged; copy or write the image again.",
                    path, reason.empty() ? "holds " + shown(json) : reason));
  return {path, std::make_shared<const Json>(std::move(json))};
}

bool JsonPart::is_null() const { return value_->is_null(); }
bool JsonPart::is_boolean() const { return value_->is_boolean(); }
bool JsonPart::is_number() const { return value_->is_number(); }
bool JsonPart::is_text() const { return value_->is_string(); }
bool JsonPart::is_list() const { return value_->is_array(); }
bool JsonPart::is_object() const { return value_->is_object(); }
bool JsonPart::has(const std::string& name) const { return is_object() && value_->contains(name); }

std::vector<std::string> JsonPart::names() const {
  std::vector<std::string> all;
  if (is_object())
    for (const auto& m : value_->items()) all.push_back(m.key());
  return all;
}

JsonPart JsonPart::at(const std::string& name) const {
  if (!is_object()) fail(fmt::format("an object with \"{}\" is needed", name));
  check(has(name),
        fmt::format("{}: {}/{} is missing. Write the image again.", *path_, pointer_, name));
  return {*path_, value_->at(name), pointer_ + "/" + name};
}

std::vector<JsonPart> JsonPart::items() const {
  if (!is_list()) fail("a list is needed");
  std::vector<JsonPart> all;
  for (const Json& v : *value_)
    all.emplace_back(*path_, v, fmt::format("{}/{}", pointer_, all.size()));
  return all;
}

std::string JsonPart::text() const {
  if (!is_text()) fail("a text is needed");
  return value_->get<std::string>();
}

double JsonPart::number() const {
  if (!is_number()) fail("a number is needed");
  return value_->get<double>();
}

bool JsonPart::boolean() const {
  if (!is_boolean()) fail("true or false is needed");
  return value_->get<bool>();
}

std::vector<double> JsonPart::numbers() const {
  std::vector<double> all;
  for (const JsonPart& p : items()) all.push_back(p.number());
  return all;
}

std::vector<std::int64_t> JsonPart::counts(std::int64_t least) const {
  constexpr double kMost = 1e15;
  std::vector<std::int64_t> all;
  for (const JsonPart& p : items()) {
    const double n = p.number();
    if (!(n >= static_cast<double>(least) && n <= kMost && n == std::floor(n)))
      p.fail(fmt::format("a whole number from {} on is needed", least));
    all.push_back(static_cast<std::int64_t>(n));
  }
  return all;
}

std::string JsonPart::where() const {
  return fmt::format("{}: {} = {}", *path_, pointer_.empty() ? "/" : pointer_,
                     is_text() ? geometry::in_quotes(value_->get<std::string>()) : shown(*value_));
}

void JsonPart::fail(const std::string& rule) const {
  throw Error(fmt::format("{}: {}.", where(), rule));
}

}  // namespace acinus::imaging
