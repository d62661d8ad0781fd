#include "service/report/picture.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "runs/session/child.hpp"

namespace acinus::service {
namespace fs = std::filesystem;
namespace {

constexpr double kRenderTimeLimit = 120;  // s

/// Name of the first known browser in PATH, "" if there is none.
std::string find_browser() {
  const char* path = std::getenv("PATH");
  for (const char* name : {"chromium", "chromium-browser", "google-chrome", "chrome"}) {
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
      const std::string file = folder + "/" + name;
      if (access(file.c_str(), X_OK) == 0) return file;
    }
  }
  return "";
}

}  // namespace

void take_picture(const std::string& html, const std::string& png) {
  const std::string browser = find_browser();
  check(!browser.empty(),
        fmt::format("--png {}: no Chromium or Chrome in PATH to draw it; {} is written. Install "
                    "chromium, or open the page and take the picture there.",
                    png, html),
        Exit::kFileError);
  std::error_code code;
  fs::remove(png, code);
  const std::string profile = io::make_temporary_folder("acinus-picture-");
  std::vector<std::string> words{"--headless=new", "--hide-scrollbars", "--use-angle=swiftshader",
                                 "--enable-unsafe-swiftshader", "--window-size=1400,1600",
                                 // Time for the script to unpack and draw before the picture.
                                 "--virtual-time-budget=20000", "--user-data-dir=" + profile,
                                 "--screenshot=" + fs::absolute(png).string(),
                                 "file://" + fs::absolute(html).string()};
  if (geteuid() == 0) words.insert(words.begin(), "--no-sandbox");  // it refuses root without
  runs::ChildEnd end;
  {
    runs::Child child(
        words,
        {.program = browser, .output = profile + "/output.txt", .limit_s = kRenderTimeLimit});
    runs::wait_for_any({&child}, kRenderTimeLimit + 1);
    end = child.collect();
  }
  fs::remove_all(profile, code);
  check(fs::exists(png, code),
        fmt::format("--png {}: {} drew nothing (exit code {}); {} is written", png, browser,
                    end.code, html),
        Exit::kFileError);
}

}  // namespace acinus::service
