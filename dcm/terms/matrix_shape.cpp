#include "dcm/terms/matrix_shape.hpp"

namespace acinus::dcm {
namespace {

ACINUS_KERNEL void shape_kernel(int n_node, const double* position, float* shape) {
  Lane3 sum{lane_of(0), lane_of(0), lane_of(0)};
  for (int i = 0; i < n_node; ++i) sum = sum + load3(position + i * kPointStride);
  const Lane3 middle = (1.0 / lane_of(n_node)) * sum;
  for (int i = 0; i < n_node; ++i)
    store3(shape + i * kPointStride, load3(position + i * kPointStride) - middle);
}

}  // namespace

void write_shape(const GroupView& g, solve::System& s) {
  shape_kernel(g.topology->n_node, g.position, s.shape.data() + g.first_shape * kPointStride);
}

}  // namespace acinus::dcm
