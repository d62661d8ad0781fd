#pragma once
/// Screenshots of a page by an installed browser.

#include <string>

namespace acinus::service {

/// Renders the page with headless Chromium or Chrome.
/// @param png  file to write, replaced if it exists
/// @throws Error(kFileError) if there is no browser, or it renders nothing
void take_picture(const std::string& html, const std::string& png);

}  // namespace acinus::service
