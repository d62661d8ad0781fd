/// Updates of the operator after changes of few contacts.

#include "solve/operator.hpp"

namespace acinus::solve {

/// Adds a contact that has got a matrix to the shares of the threads, behind all others.
void Operator::add_share(std::uint32_t l) {
  const Link& link = system_->links.link[l];
  const int a = range_of(link.a.point[0]), b = range_of(link.b.point[0]);
  if (a >= 0) range_[a].link.back().push_back({l, 1, a == b ? 1U : 0U});
  if (b >= 0 && b != a) range_[b].link.back().push_back({l, 0, 1});
  if (a >= 0 && !link.b.exists()) range_[a].external.push_back(l);
}

/// Adds stiffness n n^T to the diagonal block D of an own point: D^-1 - k a a^T with a = D^-1 n,
/// and the vectors u = s D^-1 v of the rank-one terms become u - k a (n . u), k = stiffness / (1 +
/// stiffness n . a). Their s remains, which keeps the preconditioner definite.
void Operator::stiffen(Address point, double stiffness, const Vec3& n) {
  constexpr double kLeast = 1e-3;  // rounding would remain of a smaller block
  const std::size_t row = point / kPointStride, lane = point % kPointStride;
  if (range_of_row_[row] == 0) return;
  float* const inverse = inverse_.data() + row * kSymStride + lane;
  const auto at = [&](int c) { return static_cast<double>(inverse[c * kLanes]); };
  const Vec3 a(at(0) * n.x() + at(1) * n.y() + at(2) * n.z(),
               at(1) * n.x() + at(3) * n.y() + at(4) * n.z(),
               at(2) * n.x() + at(4) * n.y() + at(5) * n.z());
  const double size = 1 + stiffness * n.dot(a);
  if (!(size > kLeast)) return;
  const double k = stiffness / size;
  int c = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j, ++c)
      inverse[c * kLanes] = static_cast<float>(at(c) - k * a[i] * a[j]);
  if (system_->block[system_->block.block_of_row(row)].still) return;
  for (RowVector<float>& family : rank_one_) {
    if (point >= family.size()) continue;
    float* const u = family.data() + point;
    const Vec3 old(static_cast<double>(u[0]), static_cast<double>(u[kLanes]),
                   static_cast<double>(u[2 * kLanes]));
    const Vec3 now = old - k * n.dot(old) * a;
    for (int i = 0; i < 3; ++i) u[i * kLanes] = static_cast<float>(now[i]);
  }
}

void Operator::update_links(std::span<const LinkChange> changes) {
  merged_ = false;
  for (const LinkChange& change : changes) {
    if (change.gained) add_share(change.link);
    const Link& link = system_->links.link[change.link];
    const Vec3 normal = normal_of(link);
    const Stencil stencil = stencil_of(link);
    for (int k = 0; k < stencil.n; ++k)
      stiffen(stencil.address[k], stencil.weight[k] * stencil.weight[k] * change.stiffer, normal);
  }
}

}  // namespace acinus::solve
