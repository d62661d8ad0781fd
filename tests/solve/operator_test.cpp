#include "solve/operator.hpp"

#include "solve/kernels.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cstdio>
#include <limits>
#include <type_traits>

#include "core/parallel/threads.hpp"
#include "tests/solve/tissue.hpp"

namespace acinus::solve {
namespace {

using reference::kEps;

/// Round-off of the number type.
template <class T>
constexpr double kEpsOf = static_cast<double>(std::numeric_limits<T>::epsilon());

/// Fixture of claims about both number types.
template <class T>
class OperatorOf : public testing::Test {};
using NumberTypes = testing::Types<double, float>;
struct NumberName {
  template <class T>
  static std::string GetName(int) {
    return std::is_same_v<T, float> ? "Float" : "Double";
  }
};
TYPED_TEST_SUITE(OperatorOf, NumberTypes, NumberName);

// What the other tests rely on: nothing is left out of the random system.
TEST(RandomSystem, HoldsEveryKindOfElementAndContact) {
  const System s = make_system(100);
  const auto any = [](const auto& numbers) {
    return std::ranges::any_of(numbers, [](auto v) { return v != 0; });
  };
  EXPECT_TRUE(any(s.spring));
  EXPECT_TRUE(any(s.hinge));
  EXPECT_TRUE(any(s.face));
  EXPECT_EQ(s.rank_one.size(), 2u);
  bool softer_along = false;
  for (std::size_t k = 0; k < s.spring.size(); k += kSpringStride)
    softer_along = softer_along || s.spring[k] < 0;
  EXPECT_TRUE(softer_along);
  int kinds[2][3] = {};  // points of side a against those of side b, 0: boundary
  bool within = false, without_matrix = false;
  for (const Link& l : s.links.link) {
    ++kinds[l.a.is_single() ? 0 : 1][!l.b.exists() ? 0 : l.b.is_single() ? 1 : 2];
    without_matrix = without_matrix || (l.stiffness == 0 && l.friction == 0);
    const std::size_t first = s.block[1].first_row * kLanes, last = s.block[2].first_row * kLanes;
    within = within || (l.b.exists() && l.a.point[0] % kLanes == l.b.point[0] % kLanes &&
                        std::min(l.a.point[0], l.b.point[0]) >= first &&
                        std::max(l.a.point[0], l.b.point[0]) < last);
  }
  for (const auto& of_a : kinds)
    for (int n : of_a) EXPECT_GT(n, 0);
  EXPECT_TRUE(within);
  EXPECT_TRUE(without_matrix);
  int pairs = 0, external = 0;
  for (const PointLink& l : s.point_links) ++(l.b == kNowhere ? external : pairs);
  EXPECT_GT(pairs, 0);
  EXPECT_GT(external, 0);
}

TEST(IndexedSprings, AreFoundFromBothEnds) {
  for (int n_node : {12, 42}) {
    const BlockPattern p = make_icosphere(n_node).pattern;
    ASSERT_EQ(p.spring.size(), static_cast<std::size_t>(3 * n_node - 6));
    for (std::size_t k = 0; k < p.spring.size(); ++k) {
      EXPECT_EQ(find_spring(p, p.spring[k][0], p.spring[k][1]), k);
      EXPECT_EQ(find_spring(p, p.spring[k][1], p.spring[k][0]), k);
    }
    EXPECT_EQ(p.spring_of.size(), 2 * p.spring.size());
    EXPECT_EQ(p.first_spring_of.back(), p.spring_of.size());
  }
}

TYPED_TEST(OperatorOf, ProductIsThatOfTheDenseMatrix) {
  using T = TypeParam;
  double worst = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const System s = make_system(100 + seed);
    const Eigen::MatrixXd dense = reference::make_dense(s);
    Operator op;
    op.prepare(s);
    const std::vector<T> x = random_vector_of<T>(s, 200 + seed);
    std::vector<T> y(x.size(), static_cast<T>(1e30));  // must be overwritten
    const double energy = op.apply<T>(x, y);
    const Eigen::VectorXd expected = dense * as_eigen(x);
    EXPECT_NEAR(energy, as_eigen(x).dot(expected),
                256 * kEpsOf<T> * as_eigen(x).norm() * expected.norm());
    worst = std::max(
        worst, (as_eigen(y) - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff());
    EXPECT_LT((dense - dense.transpose()).cwiseAbs().maxCoeff(),
              16 * kEps * dense.cwiseAbs().maxCoeff());
  }
  std::printf("product against dense %.1e\n", worst);
  EXPECT_LT(worst, 256 * kEpsOf<T>);  // about 200 terms a row
}

TYPED_TEST(OperatorOf, ProductOfEveryKindAlone) {
  using T = TypeParam;
  const System all = make_system(20);
  const std::vector<T> x = random_vector_of<T>(all, 21);
  for (const auto& [kind, system] : make_each_alone(all)) {
    Operator op;
    op.prepare(system);
    std::vector<T> y(x.size());
    op.apply<T>(x, y);
    const Eigen::VectorXd expected = reference::make_dense(system) * as_eigen(x);
    const double scale = expected.cwiseAbs().maxCoeff();
    EXPECT_GT(scale, 0.01) << kind;
    EXPECT_LT((as_eigen(y) - expected).cwiseAbs().maxCoeff(), 64 * kEpsOf<T> * scale) << kind;
  }
}

TEST(Operator, ExternalProductHasMediumAndBoundaryOnly) {
  const System s = make_system(1);
  System external = s;
  std::ranges::fill(external.spring, 0.0f);
  std::ranges::fill(external.hinge, 0.0f);
  std::ranges::fill(external.face, 0.0f);
  external.rank_one.clear();
  for (Link& l : external.links.link)
    if (l.b.exists()) l.friction = l.stiffness = 0;
  for (PointLink& l : external.point_links)
    if (l.b != kNowhere) l.friction = l.stiffness = 0;
  Operator op;
  op.prepare(s);
  const std::vector<double> x = random_vector_of(s, 2);
  std::vector<double> y(x.size(), 1e300);
  op.apply_external(x, y);
  const Eigen::VectorXd expected = reference::make_dense(external) * as_eigen(x);
  EXPECT_LT((as_eigen(y) - expected).norm(), 64 * kEps * expected.norm());
}

// Elements see differences only, and both ends of a difference get the same force, whatever the
// coefficients were rounded to.
TYPED_TEST(OperatorOf, TranslationGivesExactlyNothing) {
  using T = TypeParam;
  const System s = keep_inner(make_system(22));
  Operator op;
  op.prepare(s);
  std::vector<T> x(s.n_dof()), y(x.size(), 1);
  for (std::size_t row = 0; row < s.n_row; ++row)
    for (std::size_t l = 0; l < kLanes; ++l) {
      const Vec3 shift(0.3, -1.7e3, 2.9e-4);
      for (std::size_t c = 0; c < 3; ++c)
        x[row * kPointStride + c * kLanes + l] = static_cast<T>(shift[static_cast<int>(c)]);
    }
  EXPECT_EQ(op.template apply<T>(x, y), 0);
  for (T v : y) ASSERT_EQ(v, 0);
}

TYPED_TEST(OperatorOf, InnerForcesCarryNoMomentum) {
  using T = TypeParam;
  double worst = 0;
  for (std::uint64_t seed = 23; seed < 26; ++seed) {
    const System s = keep_inner(make_system(seed));
    Operator op;
    op.prepare(s);
    const std::vector<T> x = random_vector_of<T>(s, seed + 10);
    std::vector<T> y(x.size());
    op.template apply<T>(x, y);
    for (std::size_t c = 0; c < 3; ++c) {
      long double sum = 0, size = 0;
      for (std::size_t row = 0; row < s.n_row; ++row)
        for (std::size_t l = 0; l < kLanes; ++l) {
          const auto v = static_cast<long double>(y[row * kPointStride + c * kLanes + l]);
          sum += v;
          size += std::abs(v);
        }
      EXPECT_GT(size, 1);
      worst = std::max(worst, static_cast<double>(std::abs(sum) / size));
    }
  }
  std::printf("momentum of the inner forces %.1e of the sum\n", worst);
  EXPECT_LT(worst, 4.5 * kEpsOf<T>);  // what the points' sums round; 1e-15 in double
}

// Rounded to floats the elements still are squares, so the matrix has no negative direction.
TEST(Operator, ElementsAreSemiDefiniteAsStored) {
  for (std::uint64_t seed = 26; seed < 29; ++seed) {
    const System s = make_system(seed);
    const Eigen::MatrixXd elements = reference::make_dense_elements(s);
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(elements, Eigen::EigenvaluesOnly)
            .eigenvalues();
    std::printf("elements: eigenvalues %.1e .. %.3g\n", values.minCoeff(), values.maxCoeff());
    EXPECT_GE(values.minCoeff(), -1e-14 * values.maxCoeff());
    EXPECT_LT(values.minCoeff(), 1e-12 * values.maxCoeff()) << "nothing singular: too easy";
  }
}

/// Blocks of 3x3 on the diagonal, of everything but the rank-one terms, made a little stiffer.
Eigen::MatrixXd stiffened_blocks(const System& s) {
  Eigen::MatrixXd all = reference::make_dense_elements(s);
  reference::add_medium(all, s);
  Eigen::MatrixXd blocks = reference::make_zero(s);
  for (std::size_t row = 0; row < s.n_row; ++row)
    for (int l = 0; l < kLanes; ++l) {
      const Address a = make_address(row, l);
      double trace = 0;
      for (Address r = 0; r < 3; ++r) {
        trace += all(a + r * kLanes, a + r * kLanes);
        for (Address c = 0; c < 3; ++c)
          blocks(a + r * kLanes, a + c * kLanes) = all(a + r * kLanes, a + c * kLanes);
      }
      for (Address r = 0; r < 3; ++r) blocks(a + r * kLanes, a + r * kLanes) += kRegularise * trace;
    }
  return blocks;
}

TYPED_TEST(OperatorOf, PreconditionerInvertsDiagonalBlocksAndRankOneTerms) {
  using T = TypeParam;
  const System s = make_system(3);
  ASSERT_GE(s.rank_one.size(), 2U);
  Eigen::MatrixXd m = stiffened_blocks(s);
  reference::add_rank_one(m, s);
  Operator op;
  op.prepare(s);
  const std::vector<T> x = random_vector_of<T>(s, 4);
  std::vector<T> y(x.size());
  const double product = op.template precondition<T>(x, y);
  const Eigen::VectorXd in = as_eigen(x), out = as_eigen(y);
  EXPECT_NEAR(product, in.dot(out), 64 * kEpsOf<T> * in.norm() * out.norm());
  EXPECT_NEAR(product, op.template precondition<T>(x, {}), 64 * kEpsOf<T> * product);
  const Eigen::VectorXd left = m * out - in;
  const Eigen::VectorXd scale = m.cwiseAbs() * out.cwiseAbs() + in.cwiseAbs();
  const double worst = left.cwiseQuotient(scale).cwiseAbs().maxCoeff();
  std::printf("preconditioner %.1e of the largest summands\n", worst);
  EXPECT_LT(worst, 64 * kEpsOf<float>);  // contacts' part of the blocks and the inverse are floats
}

/// However stiff the volume, the preconditioner stays positive definite in floats.
TYPED_TEST(OperatorOf, PreconditionerIsPositiveWhateverTheStiffnessOfRankOneTerms) {
  using T = TypeParam;
  System s = make_system(3);
  for (RankOne& family : s.rank_one)
    for (double& c : family.coefficient) c *= 1e9;
  Operator op;
  op.prepare(s);
  for (const RankOne& family : s.rank_one) {
    std::vector<T> r(s.n_dof(), T{0});  // where the inverse is smallest
    for (std::size_t k = 0; k < family.vector.size(); ++k) r[k] = static_cast<T>(family.vector[k]);
    EXPECT_GT(op.template precondition<T>(r, {}), 0);
  }
}

TYPED_TEST(OperatorOf, DescendAndRedirectAreTheStepsOfConjugateGradients) {
  using T = TypeParam;
  const System s = make_system(14);
  Operator op;
  op.prepare(s);
  const auto p = random_vector_of<T>(s, 15), q = random_vector_of<T>(s, 16);
  auto x = random_vector_of<T>(s, 17), r = random_vector_of<T>(s, 18),
       z = random_vector_of<T>(s, 19);
  const Eigen::VectorXd x_after = as_eigen(x) + 0.3 * as_eigen(p);
  const Eigen::VectorXd r_after = as_eigen(r) - 0.3 * as_eigen(q);
  const double rho = op.template descend<T>(0.3, p, q, x, r, z);
  EXPECT_LT((as_eigen(x) - x_after).cwiseAbs().maxCoeff(), 8 * kEpsOf<T>);
  EXPECT_LT((as_eigen(r) - r_after).cwiseAbs().maxCoeff(), 8 * kEpsOf<T>);
  std::vector<T> expected(r.size());
  op.template precondition<T>(r, expected);
  EXPECT_EQ(z, expected);
  EXPECT_NEAR(rho, op.template dot<T>(r, z),
              64 * kEpsOf<T> * as_eigen(r).norm() * as_eigen(z).norm());
  auto direction = p;
  op.template redirect<T>(z, 0.7, direction);
  const Eigen::VectorXd redirected = as_eigen(z) + 0.7 * as_eigen(p);
  EXPECT_LT((as_eigen(direction) - redirected).norm(), 8 * kEpsOf<T> * redirected.norm());
}

TYPED_TEST(OperatorOf, DotIsTheDotProduct) {
  using T = TypeParam;
  const System s = make_system(5);
  Operator op;
  op.prepare(s);
  const auto a = random_vector_of<T>(s, 6), b = random_vector_of<T>(s, 7);
  EXPECT_NEAR(op.template dot<T>(a, b), as_eigen(a).dot(as_eigen(b)),
              64 * kEpsOf<T> * as_eigen(a).norm() * as_eigen(b).norm());
}

TEST(Operator, LinkForcesAreScatteredByWeight) {
  System s = make_system(8);
  std::ranges::fill(s.force, 0.5);  // added to, not overwritten
  std::ranges::fill(s.external_force, 0.25);
  Eigen::VectorXd expected_pair = as_eigen(s.force), expected_external = as_eigen(s.external_force);
  for (std::size_t l = 0; l < s.links.size(); ++l) {
    const Link& link = s.links.link[l];
    std::vector<reference::PointWeight> stencil;
    reference::add_side(stencil, link.a, 1);
    reference::add_side(stencil, link.b, -1);
    for (const auto& [at, weight] : stencil)
      for (Address c = 0; c < 3; ++c)
        (link.b.exists() ? expected_pair : expected_external)(at + c * kLanes) +=
            weight * force_of(link)[static_cast<int>(c)];
  }
  Operator op;
  op.add_link_forces(s, [&](std::size_t l) { return force_of(s.links.link[l]); });
  EXPECT_LT((as_eigen(s.force) - expected_pair).cwiseAbs().maxCoeff(), 64 * kEps);
  EXPECT_LT((as_eigen(s.external_force) - expected_external).cwiseAbs().maxCoeff(), 64 * kEps);
  EXPECT_GT((as_eigen(s.external_force).array() - 0.25).abs().maxCoeff(), 0.01);
  Vec3 net = Vec3::Zero();
  for (std::size_t row = 0; row < s.n_row; ++row)
    for (int l = 0; l < kLanes; ++l)
      net += load_point(s.force.data(), make_address(row, l)) - Vec3::Constant(0.5);
  EXPECT_LT(net.norm(), 1024 * kEps);
}

/// Results of all operations.
template <class T>
std::vector<std::vector<T>> run_all(const System& s, std::vector<double>& number) {
  const auto x = random_vector_of<T>(s, 10), other = random_vector_of<T>(s, 11);
  Operator op;
  op.prepare(s);
  std::vector<std::vector<T>> v(4, std::vector<T>(s.n_dof()));
  number.push_back(op.apply<T>(x, v[0]));
  number.push_back(op.precondition<T>(x, v[1]));
  number.push_back(op.dot<T>(x, other));
  auto r = other;
  number.push_back(op.descend<T>(0.4, x, v[0], v[2], r, v[3]));
  op.redirect<T>(r, 0.6, v[1]);
  v.push_back(r);
  return v;
}

TEST(Operator, SameBitsForAnyNumberOfThreads) {
  const System s = make_system(9, 80);  // 567 rows: threads do start
  const int before = thread_count();
  struct Seen {
    std::vector<std::vector<double>> full;
    std::vector<std::vector<float>> single;
    std::vector<double> number, external;
    RowVector<double> force, external_force;
    bool operator==(const Seen&) const = default;
  };
  std::vector<Seen> seen;
  for (int threads : {1, 2, 3}) {
    set_threads(threads);
    Seen now;
    now.full = run_all<double>(s, now.number);
    now.single = run_all<float>(s, now.number);
    Operator op;
    op.prepare(s);
    now.external.resize(s.n_dof());
    op.apply_external(random_vector_of(s, 10), now.external);
    System loaded = s;
    op.add_link_forces(loaded, [&](std::size_t l) { return force_of(s.links.link[l]); });
    now.force = loaded.force;
    now.external_force = loaded.external_force;
    seen.push_back(now);
  }
  set_threads(before);
  EXPECT_TRUE(seen[0] == seen[1]);
  EXPECT_TRUE(seen[0] == seen[2]);
  EXPECT_GT(as_eigen(seen[0].external).norm(), 1);
  for (const auto& v : {seen[0].force, seen[0].external_force}) EXPECT_GT(as_eigen(v).norm(), 1);
}

TEST(Links, StencilNamesEveryPointWithItsWeight) {
  Link link;
  link.a = {{8, 17, 42}, {0.2f, 0.5f}};
  link.b = Side::at(27);
  Stencil s = stencil_of(link);
  ASSERT_EQ(s.n, 4);
  const Point points[] = {8, 17, 42, 27};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(s.address[k], make_address(points[k] / kLanes, static_cast<int>(points[k] % kLanes)));
    EXPECT_EQ(s.address[k], address_of(points[k]));
    EXPECT_EQ(point_at(s.address[k]), points[k]);
  }
  // In double, from the floats as stored: the third weight takes what they leave.
  EXPECT_EQ(s.weight[0], static_cast<double>(0.2f));
  EXPECT_EQ(s.weight[1], 0.5);
  EXPECT_EQ(s.weight[2], 1 - static_cast<double>(0.2f) - 0.5);
  EXPECT_EQ(s.weight[3], -1);

  std::swap(link.a, link.b);
  s = stencil_of(link);
  ASSERT_EQ(s.n, 4);
  EXPECT_EQ(s.weight[0], 1);
  EXPECT_EQ(s.address[0], address_of(27));
  EXPECT_EQ(s.weight[1], -static_cast<double>(0.2f));

  link.b = Side::nowhere();
  s = stencil_of(link);
  ASSERT_EQ(s.n, 1);
  EXPECT_EQ(s.weight[0], 1);
}

// Pairs feel no translation, contacts with boundary all of it.
TEST(Links, WeightsAddUpToNothingOrToOne) {
  const System s = make_system(12);
  for (const Link& link : s.links.link) {
    const Stencil stencil = stencil_of(link);
    double sum = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(stencil.n); ++k) sum += stencil.weight[k];
    EXPECT_NEAR(sum, link.b.exists() ? 0 : 1, 4 * kEps);
  }
}

TEST(Links, LawIsRoundedToWhatALinkKeeps) {
  Link link;
  set_law(0.1, 0.7, std::numeric_limits<double>::infinity(), Vec3(0.6, -0.8, 1e-9), link);
  EXPECT_EQ(link.stiffness, 0.1f);
  EXPECT_EQ(link.friction, 0.7f);
  EXPECT_EQ(link.gap, std::numeric_limits<float>::infinity());
  EXPECT_EQ(link.normal, (std::array<float, 3>{0.6f, -0.8f, 1e-9f}));
}

TEST(System, ClearLoadsLeavesOnlyWhatIsWrittenAfresh) {
  System s = make_system(13);
  for (auto* v : {&s.force, &s.external_force}) std::ranges::fill(*v, 1.0);
  const auto hinge = s.hinge, face = s.face;
  clear_loads(s);
  for (const auto* v : {&s.force, &s.external_force, &s.medium})
    for (double x : *v) ASSERT_EQ(x, 0);
  for (float x : s.spring) ASSERT_EQ(x, 0);
  for (const RankOne& family : s.rank_one) {
    for (float x : family.vector) ASSERT_EQ(x, 0);
    for (double x : family.coefficient) ASSERT_EQ(x, 0);
  }
  EXPECT_EQ(s.links.size(), 0u);
  EXPECT_TRUE(s.links.law.empty());
  EXPECT_EQ(s.hinge, hinge);  // one term each, which writes and does not add
  EXPECT_EQ(s.face, face);
}

TEST(System, BlocksLieOneAfterTheOther) {
  const System s = make_system(13);
  ASSERT_EQ(s.block.size(), 4u);
  EXPECT_EQ(s.block[1].first_row, 5u);
  EXPECT_EQ(s.block[1].first_spring, 5u);
  EXPECT_EQ(s.block[1].first_hinge, 0u);
  EXPECT_EQ(s.block[1].first_face, 2u);
  EXPECT_EQ(s.block[2].first_row, 12u);
  EXPECT_EQ(s.spring.size(), 11u * kSpringStride);
  EXPECT_EQ(s.hinge.size(), 6u * kHingeStride);
  EXPECT_EQ(s.shape.size(), 12u * kPointStride);
  EXPECT_EQ(s.face.size(), 5u * kFaceStride);
  EXPECT_EQ(s.n_dof(), 14u * kPointStride);
}

TEST(System, AddSpringAddsAlongAndAcross) {
  std::vector<float> element(kSpringStride);
  add_spring(element.data(), lane_of(2), lane_of(0.25));
  add_spring(element.data(), lane_of(-0.5), lane_of(0.5));
  for (std::size_t l = 0; l < kLanes; ++l) {
    EXPECT_EQ(element[l], 1.5f);
    EXPECT_EQ(element[kLanes + l], 0.75f);
  }
}

}  // namespace
}  // namespace acinus::solve
