#pragma once
/// Text elements of SVG files.

#include <string>

namespace acinus::io {

/// Text with the characters that XML reserves replaced.
std::string escape_xml(const std::string& text);

/// Text element. @param anchor  start, middle or end  @param more  further attributes
std::string svg_text(double x, double y, const std::string& anchor, const std::string& words,
                     const std::string& more = "");

}  // namespace acinus::io
