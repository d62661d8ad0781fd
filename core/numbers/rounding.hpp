#pragma once
/// Rounding to float that the compiler must not remove.

namespace acinus {

/// Float nearest to v. g++ 12 drops the rounding of a vectorised narrowing that is widened again at
/// once; the empty statement keeps it.
inline float round_to_float(double v) {
#if defined(__x86_64__) && defined(__GNUC__)
  float f = static_cast<float>(v);
  __asm__("" : "+x"(f));
  return f;
#else
  volatile float f = static_cast<float>(v);
  return f;
#endif
}

}  // namespace acinus
