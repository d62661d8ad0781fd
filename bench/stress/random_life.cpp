#include "bench/stress/random_life.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/stress/random_streams.hpp"
#include "core/numbers/random.hpp"

namespace acinus::bench {
namespace {

using Json = nlohmann::ordered_json;

/// Shortest cycle of a nominal scene, s: a fiftieth of a real cell's day.
constexpr double kShortestCycle = 1800;

/// Generator of the life blocks of one scene, drawn in a fixed order.
class LifeDrawing {
 public:
  explicit LifeDrawing(const LifeSetting& setting)
      : setting_(setting), random_(setting.seed, Purpose::kSampling, kLifeStream) {}
  std::string draw();

 private:
  bool chance(double p) { return random_.uniform() < p; }
  double decades(double low, double high) { return low * std::pow(high / low, random_.uniform()); }
  std::string seconds(double value) const { return fmt::format("{:.5g} s", value); }
  Json direction();
  Json draw_cycle();
  Json draw_inhibition();
  Json draw_death();
  Json draw_region();
  Json draw_rule(bool die);

  LifeSetting setting_;
  UniformStream random_;
};

Json LifeDrawing::direction() {
  const Vec3 v = random_.unit_vector();
  return {v.x(), v.y(), v.z()};
}

Json LifeDrawing::draw_cycle() {
  const double time = setting_.wide
                          ? setting_.end * decades(0.1, 1.5)
                          : std::max(setting_.end * random_.uniform(0.3, 1.5), kShortestCycle);
  const double spread = setting_.wide ? random_.uniform(0, 0.3) : 0.1;
  const double longest = 1 - 3 * spread;  // mitosis is part of the shortest cycle
  const double mitosis =
      setting_.wide ? std::min(decades(1e-4, 1), 0.99 * longest) : random_.uniform(0.02, 0.2);
  const double axis = random_.uniform();
  Json cycle;
  cycle["time"] = seconds(time);
  cycle["spread"] = spread;
  cycle["mitosis"] = seconds(std::max(mitosis, 1e-6) * time);
  cycle["force_ramp"] = setting_.wide ? decades(1e-3, 1) : random_.uniform(0.05, 0.3);
  const Json given = direction();
  cycle["axis"] = axis < 0.4                        ? "random"
                  : axis < 0.6                      ? "plane"
                  : axis < 0.8 || !setting_.vessels ? "given"
                                                    : "vessel";
  if (cycle["axis"] == "given") cycle["direction"] = given;
  // Cells that do not live through a whole cycle divide only if they are old at the start. In a
  // closed space cells that all double would be crushed: half of the growth is done already.
  const bool anywhere = chance(0.6) || (setting_.confined && !setting_.wide);
  cycle["start"] = anywhere || time > 0.6 * setting_.end ? "random" : "birth";
  return cycle;
}

Json LifeDrawing::draw_inhibition() {
  const double by = random_.uniform(), threshold = random_.uniform(), power = random_.uniform();
  Json inhibition;
  const bool tissue = setting_.confined && !setting_.wide;  // that fills the available volume
  if (by < 0.5 && !tissue) return inhibition;
  if (by < 0.75) {
    const double low = setting_.wide ? 1 : 50, high = setting_.wide ? 5000 : 500;
    inhibition["by"] = "pressure";
    inhibition["pressure_threshold"] =
        fmt::format("{:.5g} Pa", low * std::pow(high / low, threshold));
  } else {
    inhibition["by"] = "volume";
    inhibition["volume_threshold"] = setting_.wide ? 0.3 + 0.7 * threshold : 0.8 + 0.2 * threshold;
  }
  if (setting_.wide) inhibition["power"] = 0.5 * std::pow(100, power);
  return inhibition;
}

Json LifeDrawing::draw_death() {
  const bool lysis = chance(0.5), soft = chance(0.5);
  const double duration = setting_.wide ? decades(1e-3, 1) : random_.uniform(0.1, 0.5);
  const double left = setting_.wide ? decades(0.02, 0.9) : random_.uniform(0.15, 0.4);
  const double softening = setting_.wide ? decades(0.01, 1) : random_.uniform(0.05, 0.3);
  Json death;
  death["mode"] = lysis ? "lysis" : "removal";
  if (!lysis) return death;
  death["duration"] = seconds(duration * setting_.end);
  death["final_volume"] = left;
  if (soft) death["softening"] = softening;
  return death;
}

Json LifeDrawing::draw_region() {
  const double kind = random_.uniform(), part = random_.uniform();
  const Json normal = direction();
  if (kind < 0.6) return nullptr;
  const double reach = setting_.radius * std::cbrt(static_cast<double>(setting_.cells));
  const Json origin = {"0 um", "0 um", "0 um"};
  if (kind < 0.8) return {{"kind", "half_space"}, {"point", origin}, {"normal", normal}};
  return {{"kind", "sphere"}, {"radius", fmt::format("{:.5g} um", (0.2 + part) * reach)}};
}

Json LifeDrawing::draw_rule(bool die) {
  const bool everybody = chance(0.1), named = chance(0.2), descendants = chance(0.5);
  const double share = setting_.wide ? decades(0.05, 1) : random_.uniform(0.05, 0.4);
  const double from = chance(0.2) ? 0 : random_.uniform(0, 0.8) * setting_.end;
  const double lasts = random_.uniform(0.05, 0.6) * setting_.end;
  const Json region = draw_region();
  Json rule;
  rule["do"] = die ? "die" : "rest";
  rule["from"] = seconds(from);
  if (setting_.wide && everybody) return rule;
  rule["until"] = seconds(from + lasts);
  rule["share"] = die ? share : std::sqrt(share);
  if (!region.is_null()) rule["region"] = region;
  if (!named) return rule;
  rule["cells"] = Json::array();
  for (int k = 0; k < 3; ++k)
    rule["cells"].push_back(random_.index(static_cast<std::uint64_t>(setting_.cells)));
  rule["descendants"] = descendants;
  return rule;
}

std::string LifeDrawing::draw() {
  Json type, life, scene;
  const bool grows = chance(0.92);
  const Json cycle = draw_cycle(), inhibition = draw_inhibition();
  if (grows) type["cycle"] = cycle;
  if (!inhibition.is_null()) type["inhibition"] = inhibition;
  type["death"] = draw_death();
  life["grid"] =
      seconds(setting_.end * (setting_.wide ? decades(0.005, 0.5) : random_.uniform(0.02, 0.2)));
  Json rules = Json::array();
  if (chance(0.7)) rules.push_back(draw_rule(true));
  if (chance(0.3)) rules.push_back(draw_rule(false));
  if (!rules.empty()) life["rules"] = rules;
  const double traction = setting_.wide ? decades(0.1, 100) : 1;
  if (chance(0.33)) {
    life["sleep"] = true;
    life["sleep_traction"] = fmt::format("{:.5g} Pa", traction);
  }
  if (!chance(0.9)) life["remesh"] = false;
  // Two generations cost four times as much: the run ends before.
  const double most = random_.uniform(1.5, setting_.wide ? 4 : 2.5);
  scene["time"]["until_cells"] =
      std::max(setting_.cells + 2, static_cast<int>(std::lround(most * setting_.cells)));
  // The other integrators cannot follow cells that come and go. (null takes a key away)
  scene["time"]["integrator"] = nullptr;
  scene["cell_types"]["cell"] = type;
  scene["life"] = life;
  return scene.dump();
}

}  // namespace

std::string draw_life(const LifeSetting& setting) { return LifeDrawing(setting).draw(); }

}  // namespace acinus::bench
