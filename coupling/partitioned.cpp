#include "coupling/partitioned.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace acinus::coupling {

solve::CgResult solve_partitioned(const solve::Operator& op, std::span<const double> b,
                                  std::span<double> x, std::size_t n_dcm_block,
                                  const solve::CgOptions& options, solve::CgWorkspace& work) {
  constexpr int kMaxExchanges = 1000;
  const std::size_t n_block = op.system().block.size();
  solve::CgResult total;
  std::vector<double> residual(b.size()), scaled(b.size());
  op.precondition(b, scaled);
  const double rhs = std::sqrt(op.dot(b, scaled));
  for (int exchange = 0; exchange < kMaxExchanges; ++exchange) {
    for (const solve::BlockRange range : {solve::BlockRange{0, n_dcm_block}, solve::BlockRange{n_dcm_block, n_block}}) {
      const solve::CgResult alone = solve::solve_cg(op, b, x, options, work, range);
      total.iterations += alone.iterations;
      if (!alone.status.ok) {
        total.status = alone.status;
        return total;
      }
    }
    // After the spheres' turn only the deformable side can disagree: its residual is the change of
    // the interface force since its own turn.
    op.apply(x, residual);
    for (std::size_t k = 0; k < b.size(); ++k) residual[k] = b[k] - residual[k];
    op.precondition(residual, scaled);
    total.residual = rhs > 0 ? std::sqrt(op.dot(residual, scaled)) / rhs : 0;
    if (total.residual <= 2 * options.tolerance) return total;
  }
  total.status = Status::failed("the two models' interface forces did not agree");
  return total;
}

}  // namespace acinus::coupling
