#pragma once
/// Parser of untrusted JSON, for all texts other than scenes.

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace acinus::runs {

/// Parses JSON within the bounds of core/json_size.hpp.
/// @tparam Json  nlohmann::json or nlohmann::ordered_json
/// @return the value; one that is_discarded() where the text is no JSON
/// @throws Error(kBadInput) naming `what` and the bound that it breaks
template <class Json>
Json parse_bounded(const std::string& text, const std::string& what);

/// Parses the text of a file that may be absent, cut off or hostile.
/// @return a value that is_discarded() for anything but JSON within the bounds
template <class Json>
Json parse_or_discard(const std::string& text);

/// Member that is a text; "" where there is none, or it is something else.
template <class Json>
std::string text_at(const Json& object, const char* name);

/// Member that is a count.
/// @throws Error(kBadInput) naming `what` and the member unless it is a whole number from 0 to 2^31
/// - 1
template <class Json>
int count_at(const Json& object, const char* name, const std::string& what);

/// Member that is a time, s.
/// @param lowest  s; times of start-up are negative
/// @throws Error(kBadInput) naming `what` and the member unless it is a number from `lowest` on
template <class Json>
double seconds_at(const Json& object, const char* name, const std::string& what, double lowest = 0);

}  // namespace acinus::runs
