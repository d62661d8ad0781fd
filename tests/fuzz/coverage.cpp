/// Entry point for libFuzzer and AFL++: the target is named by the environment variable
/// ACINUS_FUZZ_TARGET. Built with ACINUS_FUZZ; tests/fuzz/fuzz.sh runs it.

#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "io/disk.hpp"
#include "tests/fuzz/targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const char* const name = std::getenv("ACINUS_FUZZ_TARGET");
  if (name == nullptr) throw std::invalid_argument("ACINUS_FUZZ_TARGET names no target");
  static const acinus::fuzz::Target& target = acinus::fuzz::find_target(name);
  static const std::string folder = acinus::io::make_temporary_folder("acinus_fuzz_");
  acinus::fuzz::try_bytes(target, folder, {reinterpret_cast<const char*>(data), size});
  return 0;
}
