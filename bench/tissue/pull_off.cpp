#include "bench/tissue/pull_off.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "bench/tissue/pulled_pair.hpp"
#include "core/error.hpp"
#include "core/vec.hpp"

namespace acinus::bench {
namespace {

struct OrientationSpread {
  double sum = 0, squares = 0;
  int n = 0;
  void add(double x) { sum += x, squares += x * x, ++n; }
  double mean() const { return sum / n; }
  double deviation() const {
    return n > 1 ? std::sqrt(std::max(0.0, squares - sum * sum / n) / (n - 1)) : 0;
  }
};

struct PullOffPoint {
  double adhesion = 0, force = 0;
};

double contact_radius(double area) { return std::sqrt(area / kPi); }

/// Pull-off force of a case over several mesh orientations.
BenchRow measure(const std::string& name, PairCase c, const BenchOptions& options,
                 std::vector<PullOffPoint>& points) {
  OrientationSpread ratio, rigid, radius, distance, last_radius, last_distance, outside, lowest;
  for (int k = 0; k < options.seeds; ++k) {
    c.seed = options.first + k;
    const PullOff p = measure_pull_off(c);
    check(p.adhered, "bench pull-off: the cells do not adhere", Exit::kCannotContinue);
    points.push_back({c.adhesion, p.force()});
    ratio.add(p.force() / vesicle_force(c));
    rigid.add(compute_rigid_pull_off(c) / (2 * vesicle_force(c)));
    radius.add(contact_radius(p.start.area));
    distance.add(p.start.distance);
    last_radius.add(contact_radius(p.last.area));
    last_distance.add(p.last.distance);
    outside.add(p.start.tension_outside);
    lowest.add(p.start.tension_contact_min);
  }
  BenchRow row{name, 2, {}};
  row.value = {{"ratio_to_piWR", ratio.mean()},
               {"ratio_sd", ratio.deviation()},
               {"pull_off_nN", ratio.mean() * vesicle_force(c)},
               {"rigid_ratio_to_2piWR", rigid.mean()},
               {"rigid_sd", rigid.deviation()},
               {"contact_radius_um", radius.mean()},
               {"distance_um", distance.mean()},
               {"last_radius_um", last_radius.mean()},
               {"last_distance_um", last_distance.mean()},
               {"tension_outside_mN_m", outside.mean()},
               {"tension_contact_min_mN_m", lowest.mean()}};
  print_row(row);
  return row;
}

/// Least-squares line of force over adhesion energy.
BenchRow fit(const std::string& name, const std::vector<PullOffPoint>& points, double radius) {
  OrientationSpread x, y;
  double product = 0;
  for (const PullOffPoint& p : points) {
    x.add(p.adhesion);
    y.add(p.force);
    product += p.adhesion * p.force;
  }
  const double n = x.n;
  const double xy = product - x.sum * y.sum / n, xx = x.squares - x.sum * x.sum / n,
               yy = y.squares - y.sum * y.sum / n;
  const double slope = xy / xx;
  BenchRow row{name, 2, {}};
  row.value = {{"slope_in_piR", slope / (kPi * radius)},
               {"intercept_nN", y.mean() - slope * x.mean()},
               {"r_squared", xy * xy / (xx * yy)}};
  print_row(row);
  return row;
}

}  // namespace

BenchTable bench_pull_off(const BenchOptions& options) {
  BenchTable table;
  for (const int nodes : {162, 642}) {
    std::vector<PullOffPoint> points;
    PairCase c;
    c.nodes = nodes;
    for (const double adhesion : {0.01, 0.02, 0.03, 0.05, 0.1}) {
      c.adhesion = adhesion;
      table.push_back(measure(fmt::format("{} nodes, W {:g} J/m^2", nodes, 1e-3 * adhesion), c,
                              options, points));
    }
    table.push_back(fit(fmt::format("{} nodes, straight line", nodes), points,
                        vesicle_force(c) / (kPi * c.adhesion)));
  }
  return table;
}

BenchTable bench_pull_off_causes(const BenchOptions& options) {
  const PairCase plain;
  std::vector<std::pair<std::string, PairCase>> cases;
  const auto vary = [&](const std::string& name, auto change) {
    change(cases.emplace_back(name, plain).second);
  };
  vary("162 nodes", [](PairCase&) {});
  vary("range 0.545 um", [](PairCase& c) { c.range = 0.545; });
  vary("range 1.8 um", [](PairCase& c) { c.range = 1.8; });
  vary("points at nodes", [](PairCase& c) { c.quadrature = contact::Quadrature::kNodes; });
  vary("nodes and edges", [](PairCase& c) { c.quadrature = contact::Quadrature::kNodesAndEdges; });
  vary("held 100 s", [](PairCase& c) { c.hold = 100, c.step = 0.5; });
  vary("held 5000 s", [](PairCase& c) { c.hold = 5000, c.step = 5; });
  vary("friction 5e10, held 1000 s", [](PairCase& c) { c.friction = 50, c.step = 5; });
  vary("friction 5e10, held 20000 s",
       [](PairCase& c) { c.friction = 50, c.hold = 20000, c.step = 30; });
  vary("bending x 10", [](PairCase& c) { c.bending = 10; });
  vary("bending x 100", [](PairCase& c) { c.bending = 100; });
  vary("stretching x 4", [](PairCase& c) { c.stretching = 4; });
  vary("stretching / 4", [](PairCase& c) { c.stretching = 0.25; });
  vary("642 nodes", [](PairCase& c) { c.nodes = 642; });
  vary("642 nodes, range 1.09 um", [](PairCase& c) { c.nodes = 642, c.range = 1.09; });
  BenchTable table;
  std::vector<PullOffPoint> points;
  for (const auto& [name, c] : cases) table.push_back(measure(name, c, options, points));
  return table;
}

}  // namespace acinus::bench
