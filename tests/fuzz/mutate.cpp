#include "tests/fuzz/mutate.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/fuzz/targets.hpp"
#include "tests/paths.hpp"

namespace acinus::fuzz {

namespace fs = std::filesystem;

std::vector<std::string> read_folder(const std::string& folder) {
  std::vector<fs::path> paths;
  if (fs::exists(folder))
    for (const auto& entry : fs::directory_iterator(folder)) paths.push_back(entry.path());
  std::ranges::sort(paths);
  std::vector<std::string> bytes;
  for (const fs::path& path : paths) {
    std::ifstream file(path, std::ios::binary);
    bytes.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return bytes;
}

std::vector<std::string> make_corpus(const std::string& target, const std::string& folder) {
  fs::create_directories(folder);
  find_target(target).write_seeds(folder);
  std::vector<std::string> corpus = read_folder(folder);
  for (std::string& kept : read_folder(test::source_path("tests/fuzz/corpus/" + target)))
    corpus.push_back(std::move(kept));
  return corpus;
}

namespace {

/// Another number of one to eight bytes, as in the header of a binary file; or a bit turned over.
void overwrite(std::string& text, std::size_t at, std::mt19937_64& random) {
  static const std::array<std::uint64_t, 12> hard{0,
                                                  1,
                                                  0x7f,
                                                  0x80,
                                                  0xffff,
                                                  0x7fff'ffff,
                                                  0x8000'0000,
                                                  0xffff'ffff,
                                                  0x7ff8'0000'0000'0000,
                                                  0x7fc0'0000,
                                                  0x7fff'ffff'ffff'ffff,
                                                  0xffff'ffff'ffff'ffff};
  if (at >= text.size()) return;
  if (random() % 2 == 0) {
    text[at] = static_cast<char>(text[at] ^ (1 << (random() % 8)));
    return;
  }
  const std::size_t size = std::size_t{1} << (random() % 4);
  const std::uint64_t number = hard[random() % hard.size()];
  for (std::size_t k = 0; k < std::min(size, text.size() - at); ++k)
    text[at + k] = static_cast<char>(number >> (8 * k));
}

}  // namespace

std::string mutate(const std::vector<std::string>& corpus, std::mt19937_64& random) {
  static const std::vector<std::string> hard{"1e999",       "-1",
                                             "0",           "nan",
                                             "1e-320",      "18446744073709551616",
                                             "-0.0",        "1e95 J/m^2",
                                             "null",        "[]",
                                             "{}",          "\"\"",
                                             "true",        "2147483648",
                                             "-2147483649", "\xff",
                                             "inf",         "1e10",
                                             "\n",          "9999999999999999999999999999999999"};
  const auto below = [&](std::size_t n) { return random() % std::max<std::size_t>(n, 1); };
  std::string text = corpus[below(corpus.size())];
  const bool in_place = below(2) == 0;
  for (std::size_t n = 1 + below(4); n > 0; --n) {
    const std::size_t at = below(text.size() + 1), length = 1 + below(16);
    if (in_place) {
      overwrite(text, at, random);
      continue;
    }
    switch (below(7)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      case 3:
        text.resize(at);
        break;
      case 4: {
        const std::string& other = corpus[below(corpus.size())];
        text.insert(at, other.substr(below(other.size()), 1 + below(200)));
        break;
      }
      case 5: {  // a number or word
        const auto digit = text.find_first_of("0123456789", at);
        if (digit == std::string::npos) break;
        const auto end = text.find_first_not_of("0123456789.eE+-", digit);
        text.replace(digit, std::min(end, text.size()) - digit, hard[below(hard.size())]);
        break;
      }
      default:
        text.insert(at, hard[below(hard.size())]);
        break;
    }
  }
  return text;
}

}  // namespace acinus::fuzz
