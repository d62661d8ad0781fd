#include "geometry/nearest_rotation.hpp"

#include <Eigen/SVD>

namespace acinus::geometry {

Mat3 nearest_rotation(const Mat3& m) {
  const Eigen::JacobiSVD<Mat3> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 flip = Mat3::Identity();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) flip(2, 2) = -1;
  return svd.matrixU() * flip * svd.matrixV().transpose();
}

}  // namespace acinus::geometry
