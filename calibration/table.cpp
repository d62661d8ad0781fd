#include "calibration/table.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::calibration {
namespace {

/// Moduli looked at, over that of plain spheres.
constexpr double kSoftest = 1e-3, kStiffest = 1e3;
/// How far apart entries of the table are at most: in d, and as a factor of moduli.
constexpr double kStride = 0.01, kRise = 1.25;

/// An overlap, and the modulus that it asks for.
struct Demand {
  double overlap = 0, modulus = 0;
};

/// The modulus all spheres must have for the force of a moment, which rises with it.
double find_modulus(const Moment& moment, cbm::Params sphere, const Vec3& point) {
  const double plain = sphere.young;
  double low = kSoftest * plain, high = kStiffest * plain;
  while (high > 1.0001 * low) {
    sphere.young = std::sqrt(low * high);
    (measure_as_spheres(moment, sphere, point).force < moment.force ? low : high) = sphere.young;
  }
  return std::sqrt(low * high);
}

std::vector<Demand> find_demands(const std::vector<Moment>& squeeze, const cbm::Params& sphere,
                                 const Vec3& point, double highest) {
  const auto first = squeeze.begin() + static_cast<std::ptrdiff_t>(squeeze.size() / 10);
  const auto rest = std::ranges::min_element(first, squeeze.end(), {}, &Moment::force);
  std::vector<Demand> demands;
  for (auto m = rest; m != squeeze.end(); ++m) {
    const double d = measure_as_spheres(*m, sphere, point).overlap;
    if (d <= highest) demands.push_back({d, find_modulus(*m, sphere, point)});
  }
  return demands;
}

/// Means over demands near each other, finest where moduli rise fastest. Where they fall they are
/// made level.
std::vector<TableEntry> make_table(std::vector<Demand> demands) {
  struct Bin {
    double overlap = 0, modulus = 0, weight = 0;
  };
  std::ranges::sort(demands, {}, &Demand::overlap);
  std::vector<Bin> bins;
  Demand start;
  for (const Demand& d : demands) {
    if (bins.empty() || d.overlap > start.overlap + kStride || d.modulus > kRise * start.modulus) {
      bins.push_back({});
      start = d;
    }
    bins.back().overlap += d.overlap;
    bins.back().modulus += d.modulus;
    ++bins.back().weight;
  }
  std::vector<Bin> rising;
  for (Bin b : bins) {
    while (!rising.empty() &&
           b.modulus / b.weight <= rising.back().modulus / rising.back().weight) {
      b = {b.overlap + rising.back().overlap, b.modulus + rising.back().modulus,
           b.weight + rising.back().weight};
      rising.pop_back();
    }
    rising.push_back(b);
  }
  std::vector<TableEntry> table;
  if (rising.empty()) return table;
  for (const Bin& b : rising) table.push_back({b.overlap / b.weight, b.modulus / b.weight});
  if (demands.back().overlap > table.back().overlap)
    table.push_back({demands.back().overlap, table.back().modulus});
  return table;
}

}  // namespace

double force_with(const Law& law, const Moment& moment, const cbm::Params& sphere,
                  const Vec3& point) {
  cbm::Params p = sphere;
  p.young = law.a0;
  p.correction = stiffness_law(law);
  return measure_as_spheres(moment, p, point).force;
}

Law tabulate_law(const std::vector<Moment>& squeeze, const cbm::Params& sphere, const Vec3& point,
                 const Law& known) {
  Law law = known;
  law.table = make_table(find_demands(squeeze, sphere, point, known.overlap_range[1]));
  if (law.table.size() < 2) return known;  // the squeeze ends where it presses least
  law.a0 = law.table.front().modulus;
  law.overlap_range = {law.table.front().overlap, law.table.back().overlap};
  return law;
}

}  // namespace acinus::calibration
