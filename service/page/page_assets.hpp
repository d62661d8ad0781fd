#pragma once
/// Scripts, styles and bodies of the pages for browsers, put into the program by page_assets.cmake.

#include <string_view>

namespace acinus::runs {

/// Of reports, as bundle.sh made them.
extern const std::string_view kPageScript, kPageStyle, kPageBody, kPageLicences;
/// Of the service.
extern const std::string_view kServiceScript, kServiceStyle, kServicePage, kLoginPage;

}  // namespace acinus::runs
