#include "bench/stress/random_zoom.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/stress/random_streams.hpp"
#include "core/numbers/random.hpp"
#include "core/sort_unique.hpp"

namespace acinus::bench {
namespace {

using Json = nlohmann::ordered_json;

std::string length(double value) { return fmt::format("{:.5g} um", value); }
std::string time(double value) { return fmt::format("{:.5g} s", value); }
std::string stress(double value) { return fmt::format("{:.5g} Pa", value); }

/// Generator of the zoom of one scene, drawn in a fixed order.
class ZoomDrawing {
 public:
  explicit ZoomDrawing(const ZoomSetting& setting)
      : setting_(setting), random_(setting.seed, Purpose::kSampling, kZoomStream) {}
  std::string draw();

 private:
  bool chance(double p) { return random_.uniform() < p; }
  double decades(double low, double high) { return low * std::pow(high / low, random_.uniform()); }
  Json draw_place(const char* kind);
  Json draw_cells();
  Json draw_region();
  Json draw_moving();
  /// Radius of a ball with the volume of all cells, um.
  double reach() const { return setting_.radius * std::cbrt(static_cast<double>(setting_.cells)); }

  ZoomSetting setting_;
  UniformStream random_;
};

/// Draws a fixed region; cells change their model as they move, grow or divide.
Json ZoomDrawing::draw_place(const char* kind) {
  const double size = (0.2 + 0.8 * random_.uniform()) * reach();
  const Vec3 n = random_.unit_vector(), at = 0.3 * reach() * random_.unit_vector();
  const Json place = {length(at.x()), length(at.y()), length(at.z())};
  const std::string name = kind;
  if (name == "sphere") return {{"kind", name}, {"center", place}, {"radius", length(size)}};
  if (name == "half_space")
    return {{"kind", name}, {"point", place}, {"normal", {n.x(), n.y(), n.z()}}};
  Json low, high;
  for (int k = 0; k < 3; ++k) {
    low.push_back(length(at[k] - size));
    high.push_back(length(at[k] + size));
  }
  return {{"kind", name}, {"low", low}, {"high", high}};
}

Json ZoomDrawing::draw_cells() {
  std::vector<std::uint64_t> followed;
  const int n = 1 + static_cast<int>(random_.index(3));
  for (int k = 0; k < n; ++k)
    followed.push_back(random_.index(static_cast<std::uint64_t>(setting_.cells)));
  sort_unique(followed);
  return {{"kind", "cells"},
          {"cells", followed},
          {"offspring", chance(0.6)},
          {"max_distance", length(setting_.radius * random_.uniform(0.5, 4))}};
}

Json ZoomDrawing::draw_region() {
  const double kind = random_.uniform(), part = random_.uniform();
  const double above = setting_.wide ? decades(1, 2000) : decades(10, 300);
  const double below = above * random_.uniform(0.1, 0.8);
  if (setting_.lobule && kind < 0.5)
    return {{"kind", "front"}, {"max_distance", length(setting_.radius * (1 + 4 * part))}};
  if (setting_.vessels && kind < 0.6)
    return {{"kind", "vessel"}, {"max_distance", length(setting_.radius * (0.5 + 2 * part))}};
  if (kind < 0.3) return {{"kind", "pressure"}, {"above", stress(above)}, {"below", stress(below)}};
  if (kind < 0.6) return draw_cells();
  return draw_place(kind < 0.75 ? "sphere" : kind < 0.9 ? "half_space" : "box");
}

Json ZoomDrawing::draw_moving() {
  const bool wide = setting_.wide;
  Json moving;
  moving["every"] = time(setting_.end * (wide ? decades(0.005, 0.5) : random_.uniform(0.02, 0.2)));
  moving["margin"] = length(2 * setting_.radius * (1.001 + random_.uniform(0, 0.5)));
  moving["stay"] = time(setting_.end * (chance(0.3) ? 0 : random_.uniform(0, 0.2)));
  moving["fade"] = time(setting_.end * (wide ? decades(1e-3, 1) : random_.uniform(0.05, 0.3)));
  moving["at_once"] = 1 + random_.index(16);
  const bool limited = chance(0.3);
  const std::uint64_t most = 1 + random_.index(static_cast<std::uint64_t>(setting_.cells));
  if (limited) moving["most_deformable"] = most;
  return moving;
}

std::string ZoomDrawing::draw() {
  Json scene;
  if (!chance(0.7)) return "{}";
  scene["cells"]["model"] = "zoom";
  scene["zoom"] = Json::array({draw_region()});
  if (chance(0.3)) scene["zoom"].push_back(draw_region());
  scene["moving_zoom"] = draw_moving();
  return scene.dump();
}

}  // namespace

std::string draw_zoom(const ZoomSetting& setting) { return ZoomDrawing(setting).draw(); }

}  // namespace acinus::bench
