#include "bench/stress/random_substance.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/stress/random_streams.hpp"
#include "core/numbers/random.hpp"

namespace acinus::bench {
namespace {

using Json = nlohmann::ordered_json;

/// Share of the scenes that have substances; of the others, share that may have rules without.
constexpr double kShare = 0.4;

/// Generator of the substances of one scene, drawn in a fixed order.
class SubstanceDrawing {
 public:
  explicit SubstanceDrawing(const SubstanceSetting& setting)
      : setting_(setting), random_(setting.seed, Purpose::kSampling, kSubstanceStream) {}
  std::string draw();

 private:
  bool chance(double p) { return random_.uniform() < p; }
  double decades(double low, double high) { return low * std::pow(high / low, random_.uniform()); }
  /// A common value, in wide scenes up to a thousand times smaller or larger.
  double near(double value) {
    const double size = random_.uniform(-1, 1);
    return value * std::pow(setting_.wide ? 1000 : 3, size);
  }
  std::string per_second(double rate) const { return fmt::format("{:.5g} 1/s", rate); }
  Json draw_face();
  Json draw_substance(int number);
  Json draw_exchange(int number);
  Json draw_rule(int number);
  void add_rules_of_exchange(const Json& exchange, int n_substance, Json& rules);
  void draw_signal(Json& rule);
  void add_rules_of_cells(int n_substance, Json& rules);

  SubstanceSetting setting_;
  UniformStream random_;
};

Json SubstanceDrawing::draw_face() {
  const double kind = random_.uniform(), value = near(10), coefficient = near(1);
  if (kind < 0.3) return {{"kind", "no_flux"}};
  if (kind < 0.8) return {{"kind", "fixed"}, {"value", value}};
  return {{"kind", "exchange"},
          {"value", value},
          {"coefficient", fmt::format("{:.5g} um/s", coefficient)}};
}

Json SubstanceDrawing::draw_substance(int number) {
  Json s;
  s["name"] = fmt::format("substance_{}", number);
  const double diffusion = decades(1, 3000), decay = near(1e-3), initial = near(10);
  s["diffusion"] = fmt::format("{:.5g} um^2/s", setting_.wide && chance(0.05) ? 0 : diffusion);
  if (chance(0.4)) s["decay"] = per_second(decay);
  s["initial"] = chance(0.2) ? 0 : initial;
  s["boundary"] = draw_face();
  const Json face = draw_face();
  if (chance(0.2)) s["faces"] = Json::array({Json::object({{"side", "y_high"}})});
  if (s.contains("faces")) s["faces"][0].update(face);
  const double concentration = near(10), permeability = near(1);
  if (setting_.vessels && chance(0.6))
    s["vessels"] = {{"concentration", concentration},
                    {"permeability", fmt::format("{:.5g} um/s", permeability)}};
  if (const double way = random_.uniform(); way < 0.2) {
    s["cells"] = "membrane";
    s["permeability"] = fmt::format("{:.5g} um/s", permeability);
  } else if (way < 0.5) {
    s["cells"] = "keep_out";
  }
  if (chance(0.3)) s["obstacles"] = "keep_out";
  if (chance(0.2))
    s["course"] = {{{"time", "0 s"}, {"factor", 1}},
                   {{"time", fmt::format("{:.5g} s", 0.4 * setting_.end)}, {"factor", 1}},
                   {{"time", fmt::format("{:.5g} s", 0.4 * setting_.end)}, {"factor", 0}}};
  return s;
}

Json SubstanceDrawing::draw_exchange(int number) {
  Json e;
  e["substance"] = fmt::format("substance_{}", number);
  const double secretion = near(0.01), saturation = near(20), uptake = near(0.01), most = near(0.1),
               half = near(2), area = near(0.01);
  if (chance(0.5)) e["secretion"] = per_second(secretion);
  if (e.contains("secretion") && chance(0.5)) e["saturation"] = saturation;
  if (chance(0.4)) e["uptake"] = per_second(uptake);
  if (chance(0.5)) {
    e["uptake_max"] = per_second(most);
    e["half_max"] = half;
  }
  if (chance(0.2)) e["uptake_per_area"] = fmt::format("{:.5g} um/s", area);
  return e;
}

Json SubstanceDrawing::draw_rule(int number) {
  const double kind = random_.uniform(), half = near(10), power = decades(0.5, 20);
  const double rate = random_.uniform(0.05, 0.5), force = random_.uniform(-0.1, 0.1);
  Json r;
  r["signal"] = fmt::format("substance_{}", number);
  r["behaviour"] = setting_.life && kind < 0.35  ? "growth"
                   : setting_.life && kind < 0.6 ? "death"
                   : kind < 0.8                  ? "motility"
                                                 : "chemotaxis";
  if (chance(0.4)) r["direction"] = "decreases";
  r["half_max"] = half;
  r["power"] = power;
  if (r["behaviour"] == "death")
    r["rate"] = fmt::format("{:.5g} 1/h", rate / (setting_.end / 3600));
  if (r["behaviour"] == "chemotaxis") r["force"] = fmt::format("{:.5g} nN", force);
  return r;
}

/// Rules of secretion and uptake, drawn last.
void SubstanceDrawing::add_rules_of_exchange(const Json& exchange, int n_substance, Json& rules) {
  for (const Json& e : exchange)
    for (const char* behaviour : {"secretion", "uptake"}) {
      const bool wanted = chance(0.3);
      const int signal = chance(0.5) ? 0 : n_substance - 1;
      const double half = near(10), power = decades(0.5, 20);
      if (!wanted || !e.contains(behaviour)) continue;
      Json r = {{"signal", fmt::format("substance_{}", signal)},
                {"behaviour", behaviour},
                {"of", e["substance"]},
                {"half_max", half},
                {"power", power}};
      if (chance(0.5)) r["direction"] = "decreases";
      rules.push_back(r);
    }
}

/// Signal of the cell itself with its half-maximum.
void SubstanceDrawing::draw_signal(Json& rule) {
  const double kind = random_.uniform(), r = setting_.radius;
  const double pressure = near(50), volume = near(4.0 / 3 * kPi * r * r * r),
               area = near(kPi * r * r), number = random_.uniform(0.5, 8),
               age = near(0.3 * setting_.end);
  if (kind < 0.25) {
    rule["signal"] = "pressure";
    rule["half_max"] = fmt::format("{:.5g} Pa", pressure);
  } else if (kind < 0.4) {
    rule["signal"] = "volume";
    rule["half_max"] = fmt::format("{:.5g} um^3", volume);
  } else if (kind < 0.6) {
    rule["signal"] = "contact_area";
    rule["half_max"] = fmt::format("{:.5g} um^2", area);
  } else if (kind < 0.8) {
    rule["signal"] = "neighbours";
    rule["half_max"] = number;
  } else if (kind < 0.9) {
    rule["signal"] = "layer";
    rule["half_max"] = number;
  } else {
    rule["signal"] = "age";
    rule["half_max"] = fmt::format("{:.5g} s", age);
  }
}

/// Rules of signals of the cell itself.
void SubstanceDrawing::add_rules_of_cells(int n_substance, Json& rules) {
  while (chance(0.5)) {
    const double kind = random_.uniform(), power = decades(0.5, 20);
    const double rate = random_.uniform(0.05, 0.5), force = random_.uniform(-0.1, 0.1);
    const bool falls = chance(0.5);
    Json r;
    draw_signal(r);
    r["behaviour"] = setting_.life && kind < 0.25    ? "growth"
                     : setting_.life && kind < 0.4   ? "death"
                     : n_substance > 0 && kind < 0.5 ? "chemotaxis"
                     : kind < 0.7                    ? "motility"
                                                     : "adhesion";
    r["power"] = power;
    if (falls) r["direction"] = "decreases";
    if (r["behaviour"] == "death")
      r["rate"] = fmt::format("{:.5g} 1/h", rate / (setting_.end / 3600));
    if (r["behaviour"] == "chemotaxis") {
      r["of"] = "substance_0";
      r["force"] = fmt::format("{:.5g} nN", force);
    }
    rules.push_back(r);
  }
}

std::string SubstanceDrawing::draw() {
  Json scene;
  if (!chance(kShare)) {
    Json rules = Json::array();
    if (chance(kShare)) add_rules_of_cells(0, rules);
    if (!rules.empty()) scene["rules"] = rules;
    return rules.empty() ? "{}" : scene.dump();
  }
  const int n = chance(0.3) ? 2 : 1;
  Json substances = Json::array(), exchange = Json::array(), rules = Json::array();
  for (int k = 0; k < n; ++k) {
    substances.push_back(draw_substance(k));
    if (chance(0.8)) exchange.push_back(draw_exchange(k));
    while (chance(0.5)) rules.push_back(draw_rule(k));
  }
  scene["substances"] = substances;
  if (!exchange.empty()) scene["cell_types"]["cell"]["exchange"] = exchange;
  scene["substance_grid"] = {
      {"spacing", fmt::format("{:.5g} um", setting_.radius * random_.uniform(0.6, 1.4))},
      {"margin", fmt::format("{:.5g} um", setting_.radius * random_.uniform(2, 6))}};
  if (chance(0.3))
    scene["substance_grid"]["step"] =
        fmt::format("{:.5g} s", setting_.end * random_.uniform(0.002, 0.02));
  add_rules_of_exchange(exchange, n, rules);
  add_rules_of_cells(n, rules);
  if (!rules.empty()) scene["rules"] = rules;
  return scene.dump();
}

}  // namespace

std::string draw_substances(const SubstanceSetting& setting) {
  return SubstanceDrawing(setting).draw();
}

}  // namespace acinus::bench
