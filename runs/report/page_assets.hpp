#pragma once
/// The page's script, style and licences as page/bundle.sh made them, put into the program by
/// page_assets.cmake.

#include <string_view>

namespace acinus::runs {

extern const std::string_view kPageScript, kPageStyle, kPageBody, kPageLicences;

}  // namespace acinus::runs
