#pragma once
/// Matrix of a System entry by entry, from what each element is said to be. The index of an
/// unknown is its place in the [row][3][lane] arrays. All entries are computed in double from the
/// numbers as stored.

#include <Eigen/Dense>

#include "solve/system.hpp"

namespace acinus::reference {

/// Three components of one lane of an element.
template <class T>
Vec3 element_vector(const T& element, std::size_t at, int lane) {
  const std::size_t k = at + static_cast<std::size_t>(lane);
  return {static_cast<double>(element[k]), static_cast<double>(element[k + kLanes]),
          static_cast<double>(element[k + 2 * kLanes])};
}

inline Vec3 normal_of(const std::array<float, 3>& n) {
  return {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])};
}

/// One place in an element: a point and its vector or weight.
struct PointVector {
  Address at;
  Vec3 g;
};
struct PointWeight {
  Address at;
  double weight;
};

/// Adds g g^T.
inline void add_outer(Eigen::MatrixXd& to, const std::vector<PointVector>& g) {
  for (const PointVector& p : g)
    for (const PointVector& q : g)
      for (Address r = 0; r < 3; ++r)
        for (Address c = 0; c < 3; ++c) to(p.at + r * kLanes, q.at + c * kLanes) += p.g[r] * q.g[c];
}

/// Adds W^T m W of the relative vector sum weight x.
inline void add_relative(Eigen::MatrixXd& to, const std::vector<PointWeight>& w, const Mat3& m) {
  for (const PointWeight& p : w)
    for (const PointWeight& q : w)
      for (Address r = 0; r < 3; ++r)
        for (Address c = 0; c < 3; ++c)
          to(p.at + r * kLanes, q.at + c * kLanes) += p.weight * q.weight * m(r, c);
}

inline void add_medium(Eigen::MatrixXd& to, const solve::System& s) {
  for (std::size_t row = 0; row < s.n_row; ++row)
    for (int l = 0; l < kLanes; ++l)
      add_relative(to, {{make_address(row, l), 1}},
                   s.friction_scale * s.medium[row * kLanes + static_cast<std::size_t>(l)] *
                       Mat3::Identity());
}

/// Point of the shape, from which directions of springs and hinges are taken.
inline Vec3 shape_place(const solve::System& s, const solve::Block& block, int point, int lane) {
  const std::size_t row = block.first_shape + static_cast<std::size_t>(point);
  return element_vector(s.shape, row * kPointStride, lane);
}

/// Matrix of a spring on the displacement of its ends from each other.
inline Mat3 spring_matrix(const solve::System& s, const solve::Block& block, std::size_t e,
                          int lane) {
  const auto& [i, j] = block.pattern->spring[e];
  const Vec3 d = shape_place(s, block, j, lane) - shape_place(s, block, i, lane);
  const auto number = [&](std::size_t k) {
    const std::size_t at = (block.first_spring + e) * solve::kSpringStride + k * kLanes;
    return static_cast<double>(s.spring[at + static_cast<std::size_t>(lane)]);
  };
  return number(0) * d * d.transpose() + number(1) * Mat3::Identity();
}

/// Springs, hinges, faces and beams of one lane of a block.
inline void add_elements(Eigen::MatrixXd& to, const solve::System& s, const solve::Block& block,
                         int lane) {
  const auto at = [&](int point) {
    return make_address(block.first_row + static_cast<std::size_t>(point), lane);
  };
  const solve::BlockPattern& p = *block.pattern;
  const auto place = [&](int point) { return shape_place(s, block, point, lane); };
  for (std::size_t e = 0; e < p.spring.size(); ++e)
    add_relative(to, {{at(p.spring[e][1]), 1}, {at(p.spring[e][0]), -1}},
                 spring_matrix(s, block, e, lane));
  for (std::size_t e = 0; e < p.wing.size(); ++e) {
    const std::size_t k = (block.first_hinge + e) * solve::kHingeStride;
    const auto number = [&](std::size_t i) {
      return static_cast<double>(s.hinge[k + i * kLanes + static_cast<std::size_t>(lane)]);
    };
    const Vec3 end = place(p.spring[e][1]), d = end - place(p.spring[e][0]);
    const Vec3 n1 = d.cross(place(p.wing[e][0]) - end), n2 = (place(p.wing[e][1]) - end).cross(d);
    const Vec3 g1 = number(0) * n1, g2 = number(1) * n2, g3 = number(2) * n1 + number(3) * n2;
    add_outer(to, {{at(p.wing[e][0]), g1},
                   {at(p.wing[e][1]), g2},
                   {at(p.spring[e][0]), g3},
                   {at(p.spring[e][1]), -(g1 + g2 + g3)}});
  }
  for (std::size_t e = 0; e < p.face.size(); ++e) {
    const std::size_t k = (block.first_face + e) * solve::kFaceStride;
    const Vec3 g1 = element_vector(s.face, k, lane),
               g2 = element_vector(s.face, k + 3 * kLanes, lane);
    add_outer(to, {{at(p.face[e][0]), g1}, {at(p.face[e][1]), g2}, {at(p.face[e][2]), -(g1 + g2)}});
  }
  for (std::size_t e = 0; e < p.beam.size(); ++e)
    for (std::size_t d = 0; d < 2; ++d) {
      const std::size_t k = (block.first_beam + e) * solve::kBeamStride + 6 * kLanes * d;
      const Vec3 end = element_vector(s.beam, k, lane),
                 turn = element_vector(s.beam, k + 3 * kLanes, lane);
      add_outer(to, {{at(p.beam[e][0]), -end},
                     {at(p.beam[e][1]), end},
                     {at(p.beam[e][2]), turn},
                     {at(p.beam[e][3]), turn}});
    }
}

/// Points and weights of one side of a contact.
inline void add_side(std::vector<PointWeight>& to, const solve::Side& side, double sign) {
  if (!side.exists()) return;
  const double w0 = static_cast<double>(side.weight[0]), w1 = static_cast<double>(side.weight[1]);
  const double weight[3] = {w0, w1, 1 - w0 - w1};
  for (std::size_t m = 0; m < 3; ++m)
    to.push_back({solve::address_of(side.point[m]), sign * weight[m]});
}

inline Mat3 contact_matrix(const solve::System& s, const Vec3& n, float stiffness, float friction) {
  return s.stiffness_scale * static_cast<double>(stiffness) * n * n.transpose() +
         s.friction_scale * static_cast<double>(friction) * Mat3::Identity();
}

inline void add_contacts(Eigen::MatrixXd& to, const solve::System& s) {
  for (const solve::Link& l : s.links.link) {
    std::vector<PointWeight> w;
    add_side(w, l.a, 1);
    add_side(w, l.b, -1);
    add_relative(to, w, contact_matrix(s, normal_of(l.normal), l.stiffness, l.friction));
  }
  for (const solve::PointLink& l : s.point_links) {
    std::vector<PointWeight> w{{solve::address_of(l.a), 1}};
    if (l.b != solve::kNowhere) w.push_back({solve::address_of(l.b), -1});
    add_relative(to, w, contact_matrix(s, normal_of(l.normal), l.stiffness, l.friction));
  }
}

inline void add_rank_one(Eigen::MatrixXd& to, const solve::System& s) {
  for (const solve::RankOne& family : s.rank_one)
    for (std::size_t b = 0; b * kLanes < family.coefficient.size(); ++b)
      for (int l = 0; l < kLanes; ++l) {
        Eigen::VectorXd g = Eigen::VectorXd::Zero(to.rows());
        for (int i = 0; i < s.block[b].pattern->n_point; ++i)
          for (Address c = 0; c < 3; ++c) {
            const Address at =
                make_address(s.block[b].first_row + static_cast<std::size_t>(i), l) + c * kLanes;
            g(at) = static_cast<double>(family.vector[at]);
          }
        to += family.coefficient[b * kLanes + static_cast<std::size_t>(l)] * g * g.transpose();
      }
}

inline Eigen::MatrixXd make_zero(const solve::System& s) {
  const auto n = static_cast<Eigen::Index>(s.n_dof());
  return Eigen::MatrixXd::Zero(n, n);
}

/// Matrix of the small elements: springs, hinges, faces, beams and contacts.
inline Eigen::MatrixXd make_dense_elements(const solve::System& s) {
  Eigen::MatrixXd a = make_zero(s);
  for (std::size_t b = 0; b < s.block.size(); ++b)
    for (int l = 0; l < kLanes; ++l) add_elements(a, s, s.block[b], l);
  add_contacts(a, s);
  return a;
}

inline Eigen::MatrixXd make_dense(const solve::System& s) {
  Eigen::MatrixXd a = make_dense_elements(s);
  add_medium(a, s);
  add_rank_one(a, s);
  return a;
}

}  // namespace acinus::reference
