#pragma once
/// A picture of a page, by a browser that is installed.

#include <string>

namespace acinus::runs {

/// Draws the page with Chromium or Chrome, without a screen.
/// @param png  replaced
/// @throws Error(kFileError) if there is no browser, or it draws nothing
void take_picture(const std::string& html, const std::string& png);

}  // namespace acinus::runs
