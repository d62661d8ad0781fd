#include "calibration/law_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cbm/contact.hpp"
#include "contact/jkr.hpp"

namespace acinus::calibration {
namespace {

/// Range of tabulated moduli, relative to that of plain spheres.
constexpr double kLeastModulus = 1e-3, kLargestModulus = 1e3;
/// Largest spacing of entries: in d, and as a factor of moduli.
constexpr double kOverlapSpacing = 0.01, kModulusRatio = 1.25;

/// Share of the largest force below which repulsion and attraction cancel and a ratio of forces has
/// no meaning.
constexpr double kLeastForceShare = 0.002;
constexpr int kRounds = 4;  ///< of corrections; the error stays the same after two or three
/// Largest factor by which one round changes a modulus.
constexpr double kLargestChange = 1.5;

/// Modulus that spheres need at the overlap of one snapshot to carry the force of the cells.
struct Demand {
  double overlap = 0, modulus = 0;
  double force = 0;  ///< nN, of the cells
  const ClumpSnapshot* snapshot = nullptr;
};

/// Modulus of all spheres that gives the force of a snapshot; the force rises with it.
double find_modulus(const ClumpSnapshot& snapshot, double force, cbm::Params sphere,
                    const std::vector<std::size_t>& inner) {
  const double plain = sphere.young;
  double low = kLeastModulus * plain, high = kLargestModulus * plain;
  while (high > 1.0001 * low) {
    sphere.young = std::sqrt(low * high);
    (bulk_as_spheres(snapshot, sphere, inner).force < force ? low : high) = sphere.young;
  }
  return std::sqrt(low * high);
}

std::vector<Demand> find_demands(const Compression& compression, const cbm::Params& sphere,
                                 double highest) {
  const std::vector<Bulk> bulks = measure_bulks(compression.snapshots, compression.inner);
  std::vector<Demand> all;
  for (std::size_t k = 0; k < bulks.size(); ++k)
    all.push_back({bulks[k].overlap, 0, bulks[k].force, &compression.snapshots[k]});
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 10);
  std::vector<Demand> demands;
  for (auto d = std::ranges::min_element(first, all.end(), {}, &Demand::force); d != all.end(); ++d)
    if (d->overlap <= highest) demands.push_back(*d);
  for (Demand& d : demands)
    d.modulus = find_modulus(*d.snapshot, d.force, sphere, compression.inner);
  return demands;
}

/// Table of means over neighbouring demands, finest where moduli rise fastest. Falling moduli are
/// levelled.
std::vector<TableEntry> make_table(std::vector<Demand> demands) {
  struct Bin {
    double overlap = 0, modulus = 0, weight = 0;
  };
  std::ranges::sort(demands, {}, &Demand::overlap);
  std::vector<Bin> bins;
  Demand start;
  for (const Demand& d : demands) {
    if (bins.empty() || d.overlap > start.overlap + kOverlapSpacing ||
        d.modulus > kModulusRatio * start.modulus) {
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

/// Entry of two cells alone: the modulus with which a pair of spheres rests at this overlap. At
/// rest it falls with the overlap to the power 3/2.
TableEntry pair_entry(double overlap, double radius, const cbm::Params& sphere) {
  const contact::SphereBody body{radius, sphere.young, sphere.poisson};
  const double rest =
      contact::jkr_special(contact::reduced_pair(body, body, sphere.adhesion)).zero_force.overlap;
  return {overlap / cbm::kNeighbours, sphere.young * std::pow(rest / (2 * radius * overlap), 1.5)};
}

/// Puts the entry of two cells alone before a table, if it is below all of that.
void add_pair(const Compression& compression, const cbm::Params& sphere,
              std::vector<TableEntry>& table) {
  if (!(compression.pair_overlap > 0) || !(sphere.adhesion > 0)) return;
  const TableEntry pair =
      pair_entry(compression.pair_overlap, compression.snapshots.front().radius.front(), sphere);
  if (pair.overlap < table.front().overlap && pair.modulus < table.front().modulus)
    table.insert(table.begin(), pair);
}

}  // namespace

double force_with(const Law& law, const ClumpSnapshot& snapshot, const cbm::Params& sphere,
                  const std::vector<std::size_t>& inner) {
  cbm::Params p = sphere;
  p.young = law.a0;
  p.correction = stiffness_law(law);
  return bulk_as_spheres(snapshot, p, inner).force;
}

Law tabulate_law(const Compression& compression, const cbm::Params& sphere, const Law& known) {
  std::vector<Demand> demands = find_demands(compression, sphere, known.overlap_range[1]);
  Law best = known;
  double least = std::numeric_limits<double>::infinity(), largest = 0;
  for (const Demand& d : demands) largest = std::max(largest, d.force);
  for (int round = 0; round < kRounds; ++round) {
    Law law = known;
    law.table = make_table(demands);
    if (law.table.size() < 2) break;  // the compression ends where it presses least
    law.overlap_range = {law.table.front().overlap, law.table.back().overlap};
    add_pair(compression, sphere, law.table);
    law.a0 = law.table.front().modulus;
    double misfit = 0;
    for (Demand& d : demands) {
      const double force = force_with(law, *d.snapshot, sphere, compression.inner);
      misfit += std::pow(force - d.force, 2);
      if (d.force > kLeastForceShare * largest)
        d.modulus *= force > 0 ? std::clamp(d.force / force, 1 / kLargestChange, kLargestChange)
                               : kLargestChange;
    }
    if (misfit < least) best = law;
    least = std::min(least, misfit);
  }
  return best;
}

}  // namespace acinus::calibration
