#include "solve/links.hpp"

namespace acinus::solve {

Stencil stencil_of(const Link& link) {
  Stencil s;
  auto add = [&](const Side& side, double sign) {
    if (!side.exists()) return;
    const double w0 = side.weight[0], w1 = side.weight[1], w2 = 1 - w0 - w1;
    for (int m = 0; m < 3; ++m) {
      const double w = m == 0 ? w0 : m == 1 ? w1 : w2;
      if (side.is_single() && m < 2) continue;
      s.address[s.n] = address_of(side.point[m]);
      s.weight[s.n++] = sign * (side.is_single() ? 1 : w);
    }
  };
  add(link.a, 1);
  add(link.b, -1);
  return s;
}

}  // namespace acinus::solve
