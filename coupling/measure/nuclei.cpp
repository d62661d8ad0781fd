#include "coupling/measure/nuclei.hpp"

#include <vector>

#include "geometry/audit_body.hpp"

namespace acinus::coupling {

NucleusLeak measure_nucleus_leak(const State& s, std::span<const std::uint8_t> ghost) {
  NucleusLeak worst;
  std::vector<Vec3> cortex, nucleus;
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l) {
    const dcm::Group& g = s.dcm.group[l / kLanes];
    if (!s.dcm.active(l) || !g.nucleus.exists()) continue;
    if (!ghost.empty() && ghost[l] != 0) continue;
    dcm::copy_nodes(s.dcm, l, cortex);
    dcm::copy_nucleus(s.dcm, l, nucleus);
    const geometry::AuditBody body(cortex, g.topology->triangle);
    for (const Vec3& x : nucleus) {
      if (body.locate(x) != geometry::Location::kOutside) continue;
      const double depth = body.distance(x);
      if (depth > worst.depth_um) worst = {depth, s.dcm.lineage[l]};
    }
  }
  return worst;
}

}  // namespace acinus::coupling
