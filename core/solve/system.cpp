#include "core/solve/system.hpp"

#include <algorithm>
#include <utility>

namespace acinus::solve {

void Links::clear() {
  start.assign(1, 0);
  address.clear();
  weight.clear();
  force.clear();
  stiffness.clear();
  friction.clear();
  external.clear();
  normal.clear();
  gap.clear();
}

void Links::close(const Vec3& f, const Sym3& k, const Sym3& g, bool is_external, const Vec3& opens,
                  double gap_now) {
  start.push_back(static_cast<std::uint32_t>(address.size()));
  force.push_back(f);
  stiffness.push_back(k);
  friction.push_back(g);
  external.push_back(is_external ? 1 : 0);
  normal.push_back(opens);
  gap.push_back(gap_now);
}

void Links::append(const Links& other) {
  const auto base = static_cast<std::uint32_t>(address.size());
  for (std::size_t l = 1; l < other.start.size(); ++l) start.push_back(base + other.start[l]);
  address.insert(address.end(), other.address.begin(), other.address.end());
  weight.insert(weight.end(), other.weight.begin(), other.weight.end());
  force.insert(force.end(), other.force.begin(), other.force.end());
  stiffness.insert(stiffness.end(), other.stiffness.begin(), other.stiffness.end());
  friction.insert(friction.end(), other.friction.begin(), other.friction.end());
  external.insert(external.end(), other.external.begin(), other.external.end());
  normal.insert(normal.end(), other.normal.begin(), other.normal.end());
  gap.insert(gap.end(), other.gap.begin(), other.gap.end());
}

void set_blocks(System& system, std::vector<Block> blocks) {
  system.n_row = 0;
  system.n_pair = 0;
  for (Block& b : blocks) {
    b.first_row = system.n_row;
    b.first_pair = system.n_pair;
    system.n_row += static_cast<std::size_t>(b.pattern->n_point);
    system.n_pair += b.pattern->pair.size();
  }
  system.block = std::move(blocks);
  system.force.resize(system.n_dof());
  system.external_force.resize(system.n_dof());
  system.medium.resize(system.n_row * kLanes);
  system.diagonal.resize(system.n_row * kSymStride);
  system.upper.resize(system.n_pair * kMatStride);
  clear_loads(system);
}

void clear_loads(System& system) {
  std::ranges::fill(system.force, 0.0);
  std::ranges::fill(system.external_force, 0.0);
  std::ranges::fill(system.medium, 0.0);
  std::ranges::fill(system.diagonal, 0.0);
  std::ranges::fill(system.upper, 0.0);
  for (RankOne& r : system.rank_one) {
    std::ranges::fill(r.vector, 0.0);
    std::ranges::fill(r.coefficient, 0.0);
  }
  system.links.clear();
}

}  // namespace acinus::solve
