#pragma once
/// Scripts, styles and bodies of the browser pages, compiled in by page_assets.cmake.

#include <string_view>

namespace acinus::service {

/// Assets of report pages, as bundled by bundle.sh.
extern const std::string_view kPageScript, kPageStyle, kPageBody, kPageLicences;
/// Assets of the service's pages.
extern const std::string_view kServiceScript, kPreviewScript, kServiceStyle, kServicePage,
    kLoginPage;

}  // namespace acinus::service
