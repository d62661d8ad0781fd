#include "coupling/step/balance.hpp"

#include <algorithm>

#include "core/threads.hpp"
#include "coupling/step/cell_sums.hpp"

namespace acinus::coupling {

namespace {

/// Brings w.cg.residual to that of the step, and w.cg.product to what boundary and medium
/// exert in it.
void find_products(const World& world, Workspace& w) {
  // Of A dx = b the residual is known; displacements made up of stages need the product.
  const Integrator method = world.params.numerics.integrator;
  if (method == Integrator::kRos2 || method == Integrator::kNewton) {
    w.op.apply(w.move, w.cg.product);
    for_each_number(w.rhs.size(),
                    [&](std::size_t k) { w.cg.residual[k] = w.rhs[k] - w.cg.product[k]; });
  }
  if (!w.linearisation.is_ahead()) {
    w.op.apply_external(w.move, w.cg.product);
    return;
  }
  // The matrix is that of the rest of the way.
  for_each_number(w.move.size(), [&](std::size_t k) { w.move[k] -= w.linearisation.move[k]; });
  w.op.apply_external(w.move, w.cg.product);
  for_each_number(w.move.size(), [&](std::size_t k) {
    w.move[k] += w.linearisation.move[k];
    w.cg.product[k] -= w.linearisation.pair_friction[k];
  });
}

struct CenterSum {
  Vec3 sum = Vec3::Zero();
  double n = 0;
  void add(const CenterSum& o) {
    sum += o.sum;
    n += o.n;
  }
};

Vec3 find_center(const Workspace& w) {
  const CenterSum middle = sum_over_cells<CenterSum>(
      w, true, [&](std::size_t, Address first, int n_point, CenterSum& part) {
        for (int i = 0; i < n_point; ++i)
          part.sum += load_point(w.position.data(), first + static_cast<Address>(i * kPointStride));
        part.n += n_point;
      });
  return middle.sum / std::max(middle.n, 1.0);
}

struct Sums {
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero(), rest_torque = Vec3::Zero();
  double force_size = 0, torque_size = 0, rest_torque_size = 0;
  void add(const Sums& o) {
    force += o.force;
    torque += o.torque;
    rest_torque += o.rest_torque;
    force_size += o.force_size;
    torque_size += o.torque_size;
    rest_torque_size += o.rest_torque_size;
  }
};

}  // namespace

Balance measure_balance(const World& world, Workspace& w) {
  find_products(world, w);
  const Vec3 center = find_center(w);
  const Sums t =
      sum_over_cells<Sums>(w, false, [&](std::size_t, Address first, int n_point, Sums& part) {
        for (int i = 0; i < n_point; ++i) {
          const Address a = first + static_cast<Address>(i * kPointStride);
          const Vec3 conservative = load_point(w.system.force.data(), a);
          // what pair friction and the pair forces' change exert during the step
          const Vec3 product = load_point(w.rhs.data(), a) - load_point(w.cg.residual.data(), a);
          const Vec3 rest = load_point(w.cg.product.data(), a) - product;
          const Vec3 arm = load_point(w.position.data(), a) - center;
          part.force += conservative + rest;
          part.force_size += conservative.norm() + rest.norm();
          part.torque += arm.cross(conservative);
          part.torque_size += arm.norm() * conservative.norm();
          part.rest_torque += arm.cross(rest);
          part.rest_torque_size += arm.norm() * rest.norm();
        }
      });
  auto relative = [](const Vec3& sum, double size) { return size > 0 ? sum.norm() / size : 0; };
  return {relative(t.force, t.force_size), relative(t.torque, t.torque_size),
          relative(t.rest_torque, t.rest_torque_size)};
}

}  // namespace acinus::coupling
