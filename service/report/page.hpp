#pragma once
/// The HTML page around the data.

#include <string>
#include <string_view>

namespace acinus::runs {

/// Bytes of the page without data.
std::size_t empty_page_size();

/// @param title  as text
/// @param data   JSON that page/main.js understands
std::string write_page(std::string_view title, std::string_view data);

}  // namespace acinus::runs
