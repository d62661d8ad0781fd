#pragma once
/// HTML page that carries the data of a report.

#include <string>
#include <string_view>

namespace acinus::service {

/// Size of the page without data, bytes.
std::size_t empty_page_size();

/// HTML text of a page.
/// @param title  plain text
/// @param data   JSON for page/src/report.js
std::string write_page(std::string_view title, std::string_view data);

}  // namespace acinus::service
