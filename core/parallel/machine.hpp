#pragma once
/// Description of the machine of a measurement.

#include <string>
#include <string_view>

namespace acinus {

/// Widest of "avx512f", "avx2", "sse2" that this processor supports; "generic" off x86.
std::string_view best_instruction_set();

struct Machine {
  std::string cpu_model;        ///< "unknown" if the system does not report it
  int cores = 1;                ///< logical cores this process may use
  std::string instruction_set;  ///< best_instruction_set()
};

Machine describe_machine();

}  // namespace acinus
