#include "service/report/page.hpp"

#include <fmt/format.h>

#include "service/page/page_assets.hpp"

namespace acinus::service {
namespace {

/// Head of the page. Its policy allows no external resource, so that the page is self-contained.
constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:">
<meta name="viewport" content="width=device-width, initial-scale=1">
)";

std::string replaced(std::string_view text, std::string_view what, std::string_view by) {
  std::string out;
  for (std::size_t from = 0;;) {
    const std::size_t at = text.find(what, from);
    out += text.substr(from, at - from);
    if (at == std::string_view::npos) return out;
    out += by;
    from = at + what.size();
  }
}

std::string escaped(std::string_view text) {
  return replaced(replaced(replaced(text, "&", "&amp;"), "<", "&lt;"), ">", "&gt;");
}

}  // namespace

std::size_t empty_page_size() { return write_page("", "").size(); }

std::string write_page(std::string_view title, std::string_view data) {
  // "</script" in a text would end the data.
  return fmt::format(
      "{}<title>{}</title>\n<style>\n{}\n</style>\n</head>\n<body>\n{}\n"
      "<script type=\"application/json\" id=\"data\">{}</script>\n<script>\n{}\n</script>\n"
      "<!--\n{}\n-->\n</body>\n</html>\n",
      kHead, escaped(title), kPageStyle, kPageBody, replaced(data, "<", "\\u003c"), kPageScript,
      kPageLicences);
}

}  // namespace acinus::service
