#include "tests/coupling/partitioned.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace acinus::coupling {

solve::CgResult solve_partitioned(solve::Operator& op, std::span<const double> b,
                                  std::span<double> x, std::size_t n_dcm_block,
                                  const solve::CgOptions& options, solve::CgWorkspace& work) {
  constexpr int kMaxExchanges = 2000;
  constexpr double kAgree =
      100;  // each side's own solve leaves noise of its tolerance in the exchange
  constexpr int kExtrapolate = 4;  // exchanges between two extrapolations
  const std::size_t n_block = op.system().block.size();
  solve::CgResult total;
  std::vector<double> scaled(b.size());
  std::vector<double>& residual = work.residual;
  op.precondition(b, scaled);
  const double rhs = std::sqrt(op.dot(b, scaled));
  std::vector<double> before(x.begin(), x.end()), change(x.size(), 0.0);
  for (int exchange = 1; exchange <= kMaxExchanges; ++exchange) {
    for (const solve::BlockRange range :
         {solve::BlockRange{0, n_dcm_block}, solve::BlockRange{n_dcm_block, n_block}}) {
      const solve::CgResult alone = solve::solve_cg(op, b, x, options, work, range);
      total.iterations += alone.iterations;
      if (!alone.status.ok) {
        total.status = alone.status;
        return total;
      }
    }
    // Exchanges converge like a geometric series with one slow ratio (the drift of the whole
    // cluster): its limit is extrapolated now and then (Aitken).
    double same = 0, size = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double now = x[k] - before[k];
      same += now * change[k];
      size += change[k] * change[k];
      change[k] = now;
    }
    const double ratio = size > 0 ? same / size : 0;
    if (exchange % kExtrapolate == 0 && ratio > 0 && ratio < 1)
      for (std::size_t k = 0; k < x.size(); ++k) x[k] += ratio / (1 - ratio) * change[k];
    std::ranges::copy(x, before.begin());

    // After the spheres' turn only the deformable side can disagree: its residual is the change of
    // the interface force since its own turn.
    residual.resize(b.size());
    op.apply(x, residual);
    for (std::size_t k = 0; k < b.size(); ++k) residual[k] = b[k] - residual[k];
    op.precondition(residual, scaled);
    total.residual = rhs > 0 ? std::sqrt(op.dot(residual, scaled)) / rhs : 0;
    if (total.residual <= kAgree * options.tolerance) return total;
  }
  total.status = Status::failed("the two models' interface forces did not agree");
  return total;
}

}  // namespace acinus::coupling
