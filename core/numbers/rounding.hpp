#pragma once
/// Rounding that the compiler must not undo.

namespace acinus {

/// v rounded to float. g++ 12 drops the rounding of a vectorised narrowing that is widened again at
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
