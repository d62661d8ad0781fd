#include "solve/merged_links.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "core/parallel/threads.hpp"
#include "solve/cg.hpp"
#include "tests/solve/tissue.hpp"

namespace acinus::solve {
namespace {

constexpr double kFloatEps = static_cast<double>(std::numeric_limits<float>::epsilon());

MergedLinks merge(const System& s) {
  MergedLinks out;
  LinkMerger().merge(s, out);
  return out;
}

template <class T = float>
std::vector<T> product(const Operator& op, const std::vector<T>& x) {
  std::vector<T> y(x.size(), static_cast<T>(1e30));  // must be overwritten
  op.apply<T>(x, y);
  return y;
}

/// Largest error over the largest entry.
double compare(const std::vector<float>& y, const Eigen::VectorXd& expected) {
  return (as_eigen(y) - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

// By hand: a face and a sphere, weights 1/2, 1/8 and 3/8, matrix 2 n n^T + 4 I with n = x.
TEST(MergedLinks, FaceAndSphereBecomeThreePairsAndThreeSprings) {
  System s;
  const BlockPattern& pattern = mesh_of(kOctahedron).pattern;
  set_blocks(s, {block_of(kSingle), block_of(pattern)});
  const Point sphere = 5, lane = 3;
  auto node = [](Point i) { return (1 + i) * kLanes + lane; };
  Link link;
  link.a = {{node(4), node(1), node(2)}, {0.5f, 0.125f}};
  link.b = {{sphere, sphere, sphere}, {0.25f, 0.5f}};  // a single point: its weights do not count
  set_law(2, 4, 0, Vec3::UnitX(), link);
  s.links.link = {link};
  const MergedLinks m = merge(s);
  // rows are the points of the lower cell: the sphere
  ASSERT_EQ(m.pairs.row.size(), 1u);
  EXPECT_EQ(m.pairs.row[0].a, sphere);
  EXPECT_EQ(m.pairs.row[0].first, 0u);
  EXPECT_EQ(m.pairs.row[0].last, 3u);
  EXPECT_EQ(m.pairs.b, (std::vector<Point>{node(4), node(1), node(2)}));
  EXPECT_EQ(m.pairs.block[0], (SymBlock{3, 0, 0, 2, 0, 2, 0, 0}));
  EXPECT_EQ(m.pairs.block[1], (SymBlock{0.75f, 0, 0, 0.5f, 0, 0.5f, 0, 0}));
  EXPECT_EQ(m.pairs.block[2], (SymBlock{2.25f, 0, 0, 1.5f, 0, 1.5f, 0, 0}));
  const float times[12] = {0, -0.125f * 0.375f, 0, 0, 0, -0.5f * 0.125f, -0.5f * 0.375f};
  ASSERT_EQ(m.edge.size(), 12u * kEdgeStride);
  for (std::size_t k = 0; k < 12; ++k)
    for (std::size_t l = 0; l < kLanes; ++l) {
      const float w = l == lane ? times[k] : 0;
      const float expected[6] = {6 * w, 0, 0, 4 * w, 0, 4 * w};
      for (std::size_t e = 0; e < 6; ++e)
        EXPECT_EQ(m.edge[k * kEdgeStride + e * kLanes + l], expected[e]) << k << ", " << l;
    }
}

/// Sum of matrices, and of the largest entries of what was added.
struct Sum {
  Mat3 value = Mat3::Zero();
  double size = 0;
  void add(double w, const Mat3& m) {
    value += w * m;
    size += m.cwiseAbs().maxCoeff();
  }
};
/// Largest error of a block over the sizes of what it is the sum of.
double compare(const Sum& expected, const std::array<float, 6>& m) {
  Mat3 full;
  full << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
  return (full - expected.value).cwiseAbs().maxCoeff() / expected.size;
}

/// Points of a side with weights that count.
std::vector<std::pair<Point, double>> weighted_points(const Side& s) {
  if (s.point[0] == s.point[2]) return {{s.point[2], 1}};
  const double w0 = static_cast<double>(s.weight[0]), w1 = static_cast<double>(s.weight[1]);
  return {{s.point[0], w0}, {s.point[1], w1}, {s.point[2], 1 - w0 - w1}};
}

TEST(MergedLinks, AreTheSumsOverContactsWorkedOutPlainly) {
  const System s = make_tissue(40);
  auto cell = [&](const Side& side) {
    return static_cast<Point>(s.block_of(side.point[0])) * kLanes + side.point[0] % kLanes;
  };
  std::map<std::pair<Point, Point>, Sum> across;  // by point of the lower cell
  std::map<std::pair<Point, Point>, Sum> within;  // by lower point
  std::size_t n_merged = 0;
  for (const Link& l : s.links.link) {
    if (!is_merged(s, l) || (l.stiffness == 0 && l.friction == 0)) continue;
    ++n_merged;
    const Mat3 m =
        reference::contact_matrix(s, reference::normal_of(l.normal), l.stiffness, l.friction);
    const auto low = weighted_points(cell(l.a) > cell(l.b) ? l.b : l.a),
               high = weighted_points(cell(l.a) > cell(l.b) ? l.a : l.b);
    for (const auto& [p, w] : low)
      for (const auto& [q, v] : high) across[{p, q}].add(w * v, m);
    for (const auto& points : {low, high})
      for (const auto& [p, w] : points)
        for (const auto& [q, v] : points)
          if (p < q) within[{p, q}].add(-w * v, m);
  }

  const MergedLinks merged = merge(s);
  const PointPairs& pairs = merged.pairs;
  ASSERT_EQ(pairs.b.size(), across.size());  // each pair once
  ASSERT_EQ(pairs.block.size(), across.size());
  double worst = 0;
  std::uint32_t next = 0;
  for (const PointPairs::Row& row : pairs.row) {
    EXPECT_EQ(row.first, next);
    EXPECT_LT(row.first, row.last);
    next = row.last;
    for (std::uint32_t k = row.first; k < row.last; ++k) {
      const auto at = across.find({row.a, pairs.b[k]});
      ASSERT_NE(at, across.end());
      const SymBlock& b = pairs.block[k];
      worst = std::max(worst, compare(at->second, {b[0], b[1], b[2], b[3], b[4], b[5]}));
      EXPECT_EQ(b[6], 0);  // read along with the rest
      EXPECT_EQ(b[7], 0);
    }
  }
  EXPECT_EQ(next, across.size());

  ASSERT_EQ(merged.edge.size(), s.spring.size() / kSpringStride * kEdgeStride);
  for (std::size_t b = 0; b < s.block.size(); ++b)
    for (std::size_t e = 0; e < s.block[b].pattern->spring.size(); ++e)
      for (int l = 0; l < kLanes; ++l) {
        const Block block = s.block[b];
        const std::size_t k = block.first_spring + e, lane = l;
        Sum expected;
        expected.add(1, reference::spring_matrix(s, block, e, l));
        const auto [i, j] = block.pattern->spring[e];
        auto point = [&](int n) {
          return static_cast<Point>((block.first_row + static_cast<std::size_t>(n)) * kLanes +
                                    lane);
        };
        const auto at = within.find({point(std::min(i, j)), point(std::max(i, j))});
        if (at != within.end()) {
          expected.value += at->second.value;
          expected.size += at->second.size;
          within.erase(at);
        }
        std::array<float, 6> found;
        for (std::size_t c = 0; c < 6; ++c)
          found[c] = merged.edge[k * kEdgeStride + c * kLanes + lane];
        worst = std::max(worst, compare(expected, found));
      }
  EXPECT_TRUE(within.empty()) << "a pair within a side has no spring";
  std::printf("merged blocks %.1e; %zu contacts, %zu pairs\n", worst, n_merged, across.size());
  EXPECT_LT(worst, 4 * kFloatEps);  // each term is a product of four rounded numbers
}

// What merging is for: many contacts of two cells share their points.
TEST(MergedLinks, ManyContactsOfTwoCellsAreFewerPairsInOrder) {
  Tissue t(41, 1);
  for (int k = 0; k < 600; ++k) t.add_contacts(kKinds[0]);
  const PointPairs pairs = merge(t.system).pairs;
  const auto n_contact = std::ranges::count_if(
      t.system.links.link, [](const Link& l) { return l.stiffness > 0 || l.friction > 0; });
  EXPECT_LT(pairs.b.size(), 9 * static_cast<std::size_t>(n_contact));
  EXPECT_LE(pairs.b.size(), 64u * 72u);  // all there are: 8 x 8 cells with 6 x 12 pairs each
  EXPECT_GT(pairs.b.size(), 32u * 72u);
  auto cells = [&](const PointPairs::Row& r) {  // one block of each shape: the lane names the cell
    return std::pair{r.a % kLanes, pairs.b[r.first] % kLanes};
  };
  for (std::size_t k = 0; k < pairs.row.size(); ++k) {
    const PointPairs::Row& row = pairs.row[k];
    for (std::uint32_t i = row.first; i < row.last; ++i)
      EXPECT_EQ(pairs.b[i] % kLanes, pairs.b[row.first] % kLanes) << "one cell";
    if (k == 0) continue;
    const PointPairs::Row& last = pairs.row[k - 1];
    EXPECT_LE(cells(last), cells(row));
    if (cells(last) == cells(row)) {
      EXPECT_LT(last.a, row.a);
    }
  }
}

TEST(MergedLinks, NothingToMergeLeavesTheSpringsAsTheyAre) {
  for (System s : {System{}, keep_inner(make_system(42))}) {
    MergedLinks m;
    EXPECT_FALSE(LinkMerger().merge(s, m));
    EXPECT_TRUE(m.pairs.row.empty());
    EXPECT_TRUE(m.edge.empty());
    Operator op;
    op.prepare(s);
    const auto x = random_vector_of<float>(s, 43);
    const Eigen::VectorXd expected = as_eigen(product(op, x));
    op.merge_links();
    if (s.n_row > 0) {
      EXPECT_LT(compare(product(op, x), expected), 4 * kFloatEps);
    }
  }
}

TEST(MergedProduct, IsThatOfTheDenseMatrix) {
  double worst = 0;
  for (std::uint64_t seed = 44; seed < 47; ++seed) {
    const System s = make_tissue(seed);
    const Eigen::MatrixXd dense = reference::make_dense(s);
    Operator op;
    op.prepare(s);
    op.merge_links();
    const auto x = random_vector_of<float>(s, 100 + seed);
    std::vector<float> y(x.size(), 1e30f);
    const double energy = op.apply<float>(x, y);
    const Eigen::VectorXd expected = dense * as_eigen(x);
    EXPECT_NEAR(energy, as_eigen(x).dot(expected),
                16 * kFloatEps * as_eigen(x).norm() * expected.norm());
    worst = std::max(worst, compare(y, expected));
  }
  std::printf("merged product against dense %.1e\n", worst);
  EXPECT_LT(worst, 16 * kFloatEps);  // about 200 terms a row, rounded either way
}

// One kind at a time, without and with springs below: a mistake in one must not hide behind others.
TEST(MergedProduct, OfEveryKindAlone) {
  double worst = 0;
  std::uint64_t seed = 50;
  for (const Kind& kind : kKinds) {
    SCOPED_TRACE(kind.name);
    Tissue t(seed++, 2);
    for (int k = 0; k < 30; ++k) t.add_contacts(kind);
    for (const Link& l : t.system.links.link) EXPECT_EQ(is_merged(t.system, l), kind.is_merged);
    EXPECT_EQ(merge(t.system).pairs.b.empty(), !kind.is_merged);
    Operator op;
    op.prepare(t.system);
    op.merge_links();
    const auto x = random_vector_of<float>(t.system, seed);
    const Eigen::VectorXd expected = reference::make_dense(t.system) * as_eigen(x);
    EXPECT_GT(expected.cwiseAbs().maxCoeff(), 0.1);
    const double error = compare(product(op, x), expected);
    EXPECT_LT(error, 16 * kFloatEps);
    worst = std::max(worst, error);
  }
  std::printf("merged product of a kind against dense %.1e\n", worst);
}

TEST(MergedProduct, OfEveryElementAlone) {
  const System all = make_tissue(70);
  const auto x = random_vector_of<float>(all, 71);
  for (const auto& [kind, system] : make_each_alone(all)) {
    Operator op;
    op.prepare(system);
    op.merge_links();
    const Eigen::VectorXd expected = reference::make_dense(system) * as_eigen(x);
    EXPECT_GT(expected.cwiseAbs().maxCoeff(), 0.01) << kind;
    EXPECT_LT(compare(product(op, x), expected), 16 * kFloatEps) << kind;
  }
}

// Pairs and springs see differences only.
TEST(MergedProduct, TranslationGivesExactlyNothing) {
  const System s = keep_inner(make_tissue(72));
  Operator op;
  op.prepare(s);
  op.merge_links();
  std::vector<float> x(s.n_dof()), y(x.size(), 1);
  const float shift[3] = {0.3f, -1.7e3f, 2.9e-4f};
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = shift[k / kLanes % 3];
  EXPECT_EQ(op.apply<float>(x, y), 0);
  for (float v : y) ASSERT_EQ(v, 0);
}

TEST(MergedProduct, InnerForcesCarryNoMomentum) {
  double worst = 0;
  for (std::uint64_t seed = 73; seed < 76; ++seed) {
    const System s = keep_inner(make_tissue(seed));
    Operator op;
    op.prepare(s);
    op.merge_links();
    const auto y = product(op, random_vector_of<float>(s, seed + 10));
    long double sum[3] = {}, size[3] = {};
    for (std::size_t k = 0; k < y.size(); ++k) {
      sum[k / kLanes % 3] += static_cast<long double>(y[k]);
      size[k / kLanes % 3] += static_cast<long double>(std::abs(y[k]));
    }
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_GT(size[c], 1);
      worst = std::max(worst, static_cast<double>(std::abs(sum[c]) / size[c]));
    }
  }
  std::printf("momentum of the merged inner forces %.1e of the sum\n", worst);
  EXPECT_LT(worst, kFloatEps);  // what the points' sums round, either way
}

TEST(MergedProduct, SameBitsForAnyNumberOfThreads) {
  const System s = make_tissue(77, 20);
  ASSERT_TRUE(worth_threads(s.n_row));
  const auto x = random_vector_of<float>(s, 78);
  const int before = thread_count();
  std::vector<MergedLinks> merged;
  std::vector<std::vector<float>> y;
  for (int threads : {1, 2, 3}) {
    set_threads(threads);
    merged.push_back(merge(s));
    Operator op;
    op.prepare(s);
    op.merge_links();
    y.push_back(product(op, x));
  }
  set_threads(before);
  EXPECT_GT(merged[0].pairs.b.size(), 1000u);
  for (std::size_t k : {1, 2}) {
    EXPECT_EQ(y[k], y[0]);
    EXPECT_EQ(merged[k].edge, merged[0].edge);
    EXPECT_EQ(merged[k].pairs.b, merged[0].pairs.b);
    EXPECT_EQ(merged[k].pairs.block, merged[0].pairs.block);
    ASSERT_EQ(merged[k].pairs.row.size(), merged[0].pairs.row.size());
    for (std::size_t i = 0; i < merged[0].pairs.row.size(); ++i) {
      const PointPairs::Row &p = merged[k].pairs.row[i], &q = merged[0].pairs.row[i];
      ASSERT_TRUE(p.a == q.a && p.first == q.first && p.last == q.last) << i;
    }
  }
}

TEST(MergedProduct, MergingTwiceChangesNothing) {
  const System s = make_tissue(79);
  const auto x = random_vector_of<float>(s, 80);
  Operator op;
  op.prepare(s);
  op.merge_links();
  const std::vector<float> once = product(op, x);
  op.merge_links();
  EXPECT_EQ(product(op, x), once);
  op.prepare(s);
  op.merge_links();
  EXPECT_EQ(product(op, x), once);
}

TEST(MergedProduct, IsThatOfTheContactsWhereNoneCanBeMerged) {
  Tissue t(93, 1);
  t.add_elements();
  for (const Kind& kind : kKinds)
    if (!kind.is_merged) t.add_contacts(kind);
  const auto x = random_vector_of<float>(t.system, 94);
  Operator op;
  op.prepare(t.system);
  const std::vector<float> before = product(op, x);
  op.merge_links();
  EXPECT_EQ(product(op, x), before);
}

TEST(MergedProduct, ContactsAreReadAgainOnlyIfPreparedAgain) {
  Tissue t(91, 1);
  for (int k = 0; k < 20; ++k) t.add_contacts(kKinds[0]);
  const auto x = random_vector_of<float>(t.system, 92);
  Operator op;
  op.prepare(t.system);
  op.merge_links();
  std::vector<float> y = product(op, x);
  for (Link& l : t.system.links.link) {  // twice as stiff: exactly twice the product
    l.stiffness *= 2;
    l.friction *= 2;
  }
  op.merge_links();
  EXPECT_EQ(product(op, x), y);
  op.prepare(t.system);
  op.merge_links();
  for (float& v : y) v *= 2;
  EXPECT_EQ(product(op, x), y);
}

TEST(MergedProduct, EverythingElseIsLeftAlone) {
  const System s = make_tissue(81);
  const auto x = random_vector_of(s, 82);
  const auto single = random_vector_of<float>(s, 83);
  Operator op;
  op.prepare(s);
  auto run = [&] {
    std::vector<std::vector<double>> v(4, std::vector<double>(s.n_dof()));
    v[0] = product<double>(op, x);
    op.apply_within(x, v[1]);
    op.apply_external(x, v[2]);
    op.precondition(x, v[3]);
    return v;
  };
  auto precondition = [&] {
    std::vector<float> z(s.n_dof());
    op.precondition<float>(single, z);
    return z;
  };
  const auto before = run();
  const auto before_single = precondition();
  const auto product_before = product(op, single);
  op.merge_links();
  EXPECT_EQ(run(), before);
  EXPECT_EQ(precondition(), before_single);
  EXPECT_NE(product(op, single), product_before) << "nothing was merged";
}

// An operator is used for one step after another, of tissues that grow and shrink.
TEST(MergedProduct, PreparingForgetsTheMerge) {
  Operator used;
  for (const System& s : {make_tissue(84), make_tissue(85, 20), System{}, make_tissue(86, 1)}) {
    const auto x = random_vector_of<float>(s, 87);
    Operator fresh;
    fresh.prepare(s);
    used.prepare(s);
    EXPECT_EQ(product(used, x), product(fresh, x));
    fresh.merge_links();
    used.merge_links();
    EXPECT_EQ(product(used, x), product(fresh, x));
  }
}

/// Solved tissue, with a flag: products in float were left merged.
struct SolvedTissue {
  System system = make_tissue(88);
  std::vector<double> rhs = random_vector_of(system, 89), x = std::vector<double>(rhs.size());
  Operator op;
  CgResult result;

  SolvedTissue(double tolerance, Precision precision, int expected_iterations = 0) {
    op.prepare(system);
    CgWorkspace work;
    result =
        solve_cg({op, rhs, nullptr, expected_iterations}, x, {tolerance, 2000, precision}, work);
  }
  bool is_merged() const {
    const auto probe = random_vector_of<float>(system, 90);
    Operator plain;
    plain.prepare(system);
    return product(op, probe) != product(plain, probe);
  }
  /// sqrt(r D^-1 r) of the residual of x over that of the right-hand side.
  double true_residual(const Eigen::MatrixXd& dense) const {
    const Eigen::VectorXd r = as_eigen(rhs) - dense * as_eigen(x);
    const std::vector<double> residual(r.data(), r.data() + r.size());
    return std::sqrt(op.precondition(residual, {}) / op.precondition(rhs, {}));
  }
};

TEST(MergedSolve, ReachesTheSolutionOfDoubles) {
  const Eigen::MatrixXd dense = reference::make_dense(make_tissue(88));
  const Eigen::VectorXd exact = dense.ldlt().solve(as_eigen(random_vector_of(make_tissue(88), 89)));
  for (double tolerance : {1e-4, 1e-8, 1e-12}) {
    const SolvedTissue mixed(tolerance, Precision::kMixed), full(tolerance, Precision::kDouble);
    double error[2];
    int k = 0;
    for (const SolvedTissue* s : {&mixed, &full}) {
      ASSERT_TRUE(s->result.status.ok) << s->result.status.cause;
      EXPECT_GT(s->result.iterations, 20);  // twice as many as it takes to merge
      const double residual = s->true_residual(dense);
      EXPECT_LE(residual, tolerance * (1 + 1e-6));
      EXPECT_NEAR(s->result.residual, residual, 1e-6 * tolerance + 1e-13);
      error[k++] = (as_eigen(s->x) - exact).norm() / exact.norm();
    }
    EXPECT_TRUE(mixed.is_merged());
    EXPECT_FALSE(full.is_merged()) << "only products in float gain";
    std::printf("to %.0e: merged %d iterations, error %.1e; in double %d, %.1e\n", tolerance,
                mixed.result.iterations, error[0], full.result.iterations, error[1]);
    EXPECT_LT(error[0], 420 * tolerance);  // about the condition of this matrix
    EXPECT_LT(error[1], 420 * tolerance);
  }
}

TEST(MergedSolve, ShortOnesDoNotMerge) {
  const SolvedTissue s(0.3, Precision::kMixed);
  ASSERT_TRUE(s.result.status.ok);
  EXPECT_GT(s.result.iterations, 0);
  EXPECT_LT(s.result.iterations, 10);
  EXPECT_FALSE(s.is_merged());
}

TEST(MergedSolve, OnesThatAreExpectedToBeLongMergeAtOnce) {
  const SolvedTissue s(0.3, Precision::kMixed, 20);
  ASSERT_TRUE(s.result.status.ok);
  EXPECT_LT(s.result.iterations, 10);
  EXPECT_TRUE(s.is_merged());
  EXPECT_LE(s.true_residual(reference::make_dense(s.system)), 0.3);
}

}  // namespace
}  // namespace acinus::solve
