#include "coupling/step/balance.hpp"

#include <algorithm>
#include <array>

#include "core/parallel/threads.hpp"
#include "coupling/step/cell_sums.hpp"

namespace acinus::coupling {

namespace {

/// Computes the residual of the step into w.cg.residual and the forces of boundary and medium into
/// w.cg.product.
void compute_products(const World& world, Workspace& w) {
  // The solve of A dx = b leaves its residual; a displacement corrected by Newton needs the
  // product.
  if (world.params.numerics.integrator == Integrator::kNewton) {
    w.op.apply(w.move, w.cg.product);
    for_each_own_number(w.system,
                        [&](std::size_t k) { w.cg.residual[k] = w.rhs[k] - w.cg.product[k]; });
  }
  if (!w.linearisation.is_elsewhere()) {
    w.op.apply_external(w.move, w.cg.product);
    return;
  }
  // The matrix acts on the displacement from the point of linearisation.
  for_each_own_number(w.system, [&](std::size_t k) { w.move[k] -= w.linearisation.move[k]; });
  w.op.apply_external(w.move, w.cg.product);
  for_each_own_number(w.system, [&](std::size_t k) {
    w.move[k] += w.linearisation.move[k];
    w.cg.product[k] -= w.linearisation.pair_friction[k];
  });
}

/// Offsets of the sums in the array of numbers.
enum Number : std::size_t { kForce = 0, kTorque = 3, kRestTorque = 6, kSizes = 9, kNumbers = 12 };

void add(const Vec3& v, std::size_t at, std::array<double, kNumbers>& to) {
  for (std::size_t k = 0; k < 3; ++k) to[at + k] += v[static_cast<int>(k)];
}
Vec3 vector_at(const std::array<double, kNumbers>& from, std::size_t at) {
  return {from[at], from[at + 1], from[at + 2]};
}

Vec3 compute_center(const Workspace& w) {
  const auto middle =
      sum_over_cells<4>(w, true, [&](std::size_t, Address first, int n_point, CellSums<4>& part) {
        for (int i = 0; i < n_point; ++i) {
          const Vec3 x =
              load_point(w.position.data(), first + static_cast<Address>(i * kPointStride));
          for (std::size_t k = 0; k < 3; ++k) part.number[k] += x[static_cast<int>(k)];
        }
        part.number[3] += n_point;
      }).number;
  return Vec3(middle[0], middle[1], middle[2]) / std::max(middle[3], 1.0);
}

/// Force on a point from pair friction and from the change of pair forces during the step, nN.
Vec3 rest_on(const Workspace& w, Address a) {
  const Vec3 product = load_point(w.rhs.data(), a) - load_point(w.cg.residual.data(), a);
  return load_point(w.cg.product.data(), a) - product;
}

}  // namespace

Balance measure_balance(const World& world, Workspace& w) {
  compute_products(world, w);
  const Vec3 center = compute_center(w);
  const auto t = sum_over_cells<kNumbers>(
                     w, false,
                     [&](std::size_t lane, Address first, int n_point, CellSums<kNumbers>& part) {
                       std::array<double, kNumbers>& sum = part.number;
                       for (int i = 0; i < n_point; ++i) {
                         const Address a = first + static_cast<Address>(i * kPointStride);
                         const Vec3 conservative = load_point(w.system.force.data(), a);
                         const Vec3 rest = rest_on(w, a);
                         const Vec3 arm = load_point(w.position.data(), a) - center;
                         add(conservative + rest, kForce, sum);
                         add(arm.cross(conservative), kTorque, sum);
                         add(arm.cross(rest), kRestTorque, sum);
                         // The rest is a difference and has the rounding of the forces of boundary
                         // and medium, which may be all there are.
                         const double others = load_point(w.cg.product.data(), a).norm();
                         sum[kSizes] += conservative.norm() + rest.norm() + others;
                         sum[kSizes + 1] += arm.norm() * conservative.norm();
                         sum[kSizes + 2] += arm.norm() * (rest.norm() + others);
                       }
                       const int n_all = w.system.block[lane / kLanes].pattern->n_point;
                       for (int i = n_point; i < n_all; ++i) {  // moments on rotations
                         const Address a = first + static_cast<Address>(i * kPointStride);
                         const Vec3 conservative = load_point(w.system.force.data(), a);
                         const Vec3 rest = rest_on(w, a);
                         add(conservative, kTorque, sum);
                         add(rest, kRestTorque, sum);
                         sum[kSizes + 1] += conservative.norm();
                         sum[kSizes + 2] += rest.norm();
                       }
                     })
                     .number;
  const auto relative = [&t](std::size_t at, std::size_t size) {
    return t[size] > 0 ? vector_at(t, at).norm() / t[size] : 0;
  };
  return {relative(kForce, kSizes), relative(kTorque, kSizes + 1),
          relative(kRestTorque, kSizes + 2)};
}

}  // namespace acinus::coupling
