#include "calibration/clump.hpp"

#include <algorithm>
#include <functional>

#include "cbm/contact.hpp"
#include "core/sphere.hpp"

namespace acinus::calibration {
namespace {

constexpr std::size_t kShell = 14;

}  // namespace

std::size_t find_central_cell(std::span<const coupling::CellMeasure> cells, const Vec3& point) {
  const auto nearest = std::ranges::min_element(
      cells, {}, [&](const coupling::CellMeasure& c) { return (c.center - point).squaredNorm(); });
  return nearest - cells.begin();
}

ClumpSample measure_clump(std::span<const coupling::CellMeasure> cells, std::size_t cell) {
  const coupling::CellMeasure& middle = cells[cell];
  std::vector<double> relative;
  double sum = 0;
  for (const coupling::CellMeasure& c : cells) {
    if (&c == &middle) continue;
    relative.push_back(1 - (c.center - middle.center).norm() / (c.radius + middle.radius));
    sum += std::max(0.0, relative.back());
  }
  ClumpSample s;
  s.overlap = sum / cbm::kNeighbours;
  std::ranges::sort(relative, std::greater());
  relative.resize(std::min(relative.size(), kShell));
  for (const double r : relative) s.shell_overlap += r / static_cast<double>(relative.size());
  s.contacts = middle.contacts;
  s.force = middle.normal_force;
  s.contact_force = middle.contact_force;
  s.pressure = middle.pressure;
  s.volume = middle.volume / sphere_volume(middle.radius);
  return s;
}

}  // namespace acinus::calibration
