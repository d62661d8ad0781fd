#include "runs/physicell/convert_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.hpp"
#include "core/spelling.hpp"
#include "io/disk.hpp"
#include "runs/physicell/counterparts.hpp"
#include "runs/scene/key_reader.hpp"

namespace acinus::runs {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

/// A name that a scene takes: other characters become _.
std::string name_of(std::string text) {
  for (char& c : text)
    if (!is_name(std::string(1, c))) c = '_';
  return text;
}

std::string in_words(const PhysiCellRule& r) {
  return fmt::format("{}: {} {} {}", r.cell_type, r.signal, r.decreases ? "decreases" : "increases",
                     r.behaviour);
}

std::string per_minute(double rate) { return fmt::format("{:.9g} 1/min", rate); }

/// Signal of a rule as a scene has it.
struct SceneSignal {
  std::string name;
  OrderedJson half_max;
  std::string substance;       ///< as in the table; empty: none
  std::string neighbour_type;  ///< as in the table; empty: all
  std::string note;
};

constexpr const char* kContact = "contact with ";

/// @param unit_pressure  kPa that PhysiCell's pressure 1 stands for; 0: unknown
SceneSignal signal_of(const PhysiCellRule& r, double unit_pressure) {
  if (r.signal == "pressure")
    return {"pressure", fmt::format("{:.6g} Pa", 1e3 * unit_pressure * r.half_max), "", "", ""};
  if (r.signal == "volume") return {"volume", fmt::format("{:.6g} um^3", r.half_max), "", "", ""};
  if (r.signal.starts_with(kContact)) {
    const std::string whom = r.signal.substr(std::string(kContact).size());
    const bool all = whom == "live cell" || whom == "live cells";
    return {"neighbours", r.half_max, "", all ? "" : whom,
            "; PhysiCell counts cells within reach of adhesion, here those that touch count"};
  }
  return {name_of(r.signal), r.half_max, r.signal, "", ""};
}

/// Scene under construction.
struct Draft {
  double unit_pressure = 0;
  OrderedJson types = OrderedJson::object(), rules = OrderedJson::array();
  std::vector<std::string> substances;            ///< as in the table, in order of use
  std::map<std::string, std::vector<int>> lines;  ///< converted, by cell type and behaviour

  void add_rule(const PhysiCellRule& r, const char* behaviour, double rate = 0,
                const std::string& exchanged = "") {
    const SceneSignal signal = signal_of(r, unit_pressure);
    OrderedJson rule = {{"signal", signal.name}, {"behaviour", behaviour}};
    if (!signal.neighbour_type.empty()) {
      rule["neighbour_type"] = name_of(signal.neighbour_type);
      types[name_of(signal.neighbour_type)];
    }
    if (!exchanged.empty()) rule["of"] = name_of(exchanged);
    if (r.decreases) rule["direction"] = "decreases";
    rule["cell_type"] = name_of(r.cell_type);
    rule["half_max"] = signal.half_max;
    rule["power"] = r.power;
    if (rate > 0) rule["rate"] = per_minute(rate);
    rules.push_back(rule);
    if (!signal.substance.empty()) use(signal.substance);
    if (!exchanged.empty()) use(exchanged);
  }
  void use(const std::string& substance) {
    if (std::ranges::find(substances, substance) == substances.end())
      substances.push_back(substance);
  }
  /// Entry of cell_types.<name>.exchange.
  OrderedJson& exchange(const PhysiCellRule& r, const std::string& substance) {
    OrderedJson& all = type(r)["exchange"];
    for (OrderedJson& e : all)
      if (e["substance"] == name_of(substance)) return e;
    all.push_back({{"substance", name_of(substance)}});
    return all.back();
  }
  OrderedJson& type(const PhysiCellRule& r) { return types[name_of(r.cell_type)]; }
};

/// RuleOutcome of a rule: a note if it was converted, the reason if it was not.
struct RuleOutcome {
  bool converted;
  std::string text;
};
RuleOutcome left(const std::string& why) { return {false, why}; }

/// Range of a behaviour's value that a response between 0 and 1 gives: one end must be 0.
std::optional<RuleOutcome> refuse_range(const PhysiCellRule& r, std::optional<double> base) {
  if (r.decreases && r.extreme > 0)
    return left(fmt::format("falls to {:.4g}, not to 0: a response here falls to 0", r.extreme));
  if (!r.decreases && base.value_or(0) > 0)
    return left(fmt::format("rises from {:.4g}, not from 0: a response here rises from 0", *base));
  if (!r.decreases && !(r.extreme > 0)) return left("rises to 0, so it does nothing");
  return {};
}

const char* assumed_base(const PhysiCellRule& r, std::optional<double> base) {
  return r.decreases || base ? "" : "; base value taken as 0, not in the table";
}

RuleOutcome convert_growth(const PhysiCellRule& r, std::optional<double> base, Draft& draft) {
  if (const auto refused = refuse_range(r, base)) return *refused;
  draft.add_rule(r, "growth");
  const double rate = r.decreases ? base.value_or(0) : r.extreme;
  OrderedJson& cycle = draft.type(r)["cycle"];
  std::string note = "growth";
  if (rate > 0 && !cycle.contains("time")) {
    cycle["time"] = fmt::format("{:.6g} min", 1 / rate);
    note += fmt::format(", cycle.time = 1 / rate = {:.4g} h", 1 / rate / 60);
  }
  return {true, note + assumed_base(r, base)};
}

/// Largest rate of a rule, 1/min.   @pre not refuse_rate
double full_rate(const PhysiCellRule& r, std::optional<double> base) {
  return r.decreases ? *base : r.extreme;
}

/// Reasons against a rule whose largest rate must be known and above 0.
std::optional<RuleOutcome> refuse_rate(const PhysiCellRule& r, std::optional<double> base) {
  if (r.decreases && !base)
    return left(
        fmt::format("the rate without the signal is not in the table: give it in 1/min, "
                    "as --base \"{}:{}=0.001\"",
                    r.cell_type, r.behaviour));
  if (const auto refused = refuse_range(r, base)) return refused;
  if (!(full_rate(r, base) > 0)) return left("base value 0, so it does nothing");
  return {};
}

RuleOutcome convert_death(const PhysiCellRule& r, std::optional<double> base, Draft& draft) {
  if (const auto refused = refuse_rate(r, base)) return *refused;
  const double rate = full_rate(r, base);
  draft.add_rule(r, "death", rate);
  return {true, fmt::format("death at {}{}", per_minute(rate), assumed_base(r, base))};
}

RuleOutcome convert_speed(const PhysiCellRule& r, std::optional<double> base, Draft& draft) {
  if (const auto refused = refuse_range(r, base)) return *refused;
  draft.add_rule(r, "motility");
  draft.add_rule(r, "motility");
  return {true, fmt::format("motility, twice, since diffusion goes with the square of speed; set "
                            "cell_types.{}.diffusion to speed^2 x persistence time / 3{}",
                            name_of(r.cell_type), assumed_base(r, base))};
}

RuleOutcome convert_adhesion(const PhysiCellRule& r, std::optional<double> base, Draft& draft) {
  if (const auto refused = refuse_range(r, base)) return *refused;
  draft.add_rule(r, "adhesion");
  return {true, fmt::format("adhesion; cell_types.{}.adhesion is that at full response{}",
                            name_of(r.cell_type), assumed_base(r, base))};
}

/// Rates of exchange: "VEGF secretion", "oxygen uptake".
RuleOutcome convert_exchange(const PhysiCellRule& r, std::optional<double> base, bool secretes,
                             Draft& draft) {
  const std::string behaviour = secretes ? "secretion" : "uptake";
  const std::string substance = r.behaviour.substr(0, r.behaviour.size() - behaviour.size() - 1);
  if (const auto refused = refuse_rate(r, base)) return *refused;
  const double rate = full_rate(r, base);
  draft.add_rule(r, behaviour.c_str(), 0, substance);
  OrderedJson& e = draft.exchange(r, substance);
  e[behaviour] = per_minute(rate);
  if (secretes) e["saturation"] = 1;
  return {true, fmt::format("{} of {} at {}{}{}", behaviour, substance, per_minute(rate),
                            secretes ? "; secretion target taken as 1, not in the table" : "",
                            assumed_base(r, base))};
}

RuleOutcome convert(const PhysiCellRule& r, std::optional<double> base, Draft& draft) {
  if (r.signal.ends_with(" gradient"))
    return left("signal: rules.behaviour = chemotaxis follows gradients");
  if (const char* instead = missing_signal(r.signal))
    return left(fmt::format("signal: {}", instead));
  if (r.signal == "pressure" && !(draft.unit_pressure > 0))
    return left(
        "signal: PhysiCell's pressure has no unit, here it is in Pa: give what its 1 stands for, "
        "as --pressure \"100 Pa\"");
  if (r.behaviour == "cycle entry" || r.behaviour == "exit from cycle phase 0")
    return convert_growth(r, base, draft);
  if (r.behaviour == "apoptosis" || r.behaviour == "necrosis") return convert_death(r, base, draft);
  if (r.behaviour == "cell-cell adhesion") return convert_adhesion(r, base, draft);
  if (r.behaviour == "migration speed") return convert_speed(r, base, draft);
  if (r.behaviour.ends_with(" secretion")) return convert_exchange(r, base, true, draft);
  if (r.behaviour.ends_with(" uptake")) return convert_exchange(r, base, false, draft);
  for (const char* ending : {" export", " secretion target", " secretion saturation density"})
    if (r.behaviour.ends_with(ending))
      return left("behaviour: only secretion and uptake of cell_types.<name>.exchange respond");
  if (const char* instead = missing_behaviour(r.behaviour))
    return left(fmt::format("behaviour: {}", instead));
  return left(
      "behaviour: unknown. Known: cycle entry, apoptosis, necrosis, migration speed, cell-cell "
      "adhesion, <substance> secretion, <substance> uptake");
}

std::optional<double> base_of(const PhysiCellRule& r, const BaseValues& base) {
  for (const std::string& key : {r.cell_type + ":" + r.behaviour, r.behaviour})
    if (const auto found = base.find(key); found != base.end()) return found->second;
  return r.base;
}

OrderedJson make_substance(const std::string& signal) {
  const bool oxygen = signal == "oxygen";
  OrderedJson s = {{"name", name_of(signal)},
                   {"unit", oxygen ? "mmHg" : "1"},
                   {"diffusion", "100000 um^2/min"},
                   {"initial", oxygen ? 38 : 0}};
  if (oxygen) s["boundary"] = {{"kind", "fixed"}, {"value", 38}};
  return s;
}

std::string scene_text(const Draft& draft, const std::string& name, const std::string& source,
                       const std::vector<RuleRemark>& remarks) {
  OrderedJson scene = {{"name", name_of(name)},
                       {"description", "rules of PhysiCell in " + source},
                       {"model", "cbm"},
                       {"time", {{"end", "24 h"}, {"step", "300 s"}}}};
  OrderedJson types = draft.types, shares = OrderedJson::array();
  for (auto& [type, block] : types.items()) {
    block["radius"] = "8.413 um";
    if (block.contains("cycle")) {
      if (!block["cycle"].contains("time")) block["cycle"]["time"] = "24 h";
      block["cycle"]["start"] = "random";
    }
    shares.push_back({{"type", type}});
  }
  scene["cell_types"] = types;
  scene["cells"] = {{"source", "clump"}, {"count", 200}};
  if (shares.size() > 1) scene["cells"]["types"] = shares;
  if (!draft.substances.empty()) scene["substances"] = OrderedJson::array();
  for (const std::string& s : draft.substances) scene["substances"].push_back(make_substance(s));
  if (!draft.rules.empty()) scene["rules"] = draft.rules;
  std::string comments =
      "// Made from a table of rules, which has no cells, substances or constants: number, radius "
      "and cycle of the\n// cells, and diffusion, concentrations and boundary of the substances "
      "are PhysiCell's defaults. Put in yours.\n";
  for (const RuleRemark& r : remarks)
    comments += fmt::format("// line {}, {}{}\n", r.line, r.converted ? "" : "left out: ", r.text);
  return comments + scene.dump(2) + "\n";
}

/// Notes where several signals act on one behaviour, which the programs join in different ways.
void note_joint_rules(const Draft& draft, std::vector<RuleRemark>& remarks) {
  for (const auto& [what, lines] : draft.lines) {
    if (lines.size() < 2) continue;
    for (RuleRemark& r : remarks)
      if (r.line == lines.back())
        r.text += fmt::format(
            "; {} rules act on this behaviour: PhysiCell joins them in one "
            "response, here rates of death add and all others multiply",
            lines.size());
  }
}

void check_base_names(const std::vector<PhysiCellRule>& rules, const BaseValues& base) {
  std::vector<std::string> known;
  for (const PhysiCellRule& r : rules) {
    known.push_back(r.behaviour);
    known.push_back(r.cell_type + ":" + r.behaviour);
  }
  for (const auto& [name, value] : base)
    check(std::ranges::find(known, name) != known.end(),
          fmt::format("--base {}: the table has no such behaviour. {}", name,
                      did_you_mean(nearest_name(name, known),
                                   "Write BEHAVIOUR=VALUE or CELL TYPE:BEHAVIOUR=VALUE.")));
}

}  // namespace

ConvertedRules convert_physicell_rules(const std::vector<PhysiCellRule>& rules,
                                       const BaseValues& base, const std::string& name,
                                       const std::string& source, double unit_pressure) {
  check_base_names(rules, base);
  ConvertedRules result;
  Draft draft;
  draft.unit_pressure = unit_pressure;
  std::map<std::string, std::string> names;
  for (const PhysiCellRule& r : rules) {
    const auto [known, fresh] = names.emplace(name_of(r.cell_type), r.cell_type);
    check(fresh || known->second == r.cell_type,
          fmt::format("{}:{}: the cell types \"{}\" and \"{}\" would both be named {}. Rename one.",
                      source, r.line, known->second, r.cell_type, known->first));
    draft.type(r);
    const RuleOutcome outcome = convert(r, base_of(r, base), draft);
    if (outcome.converted) draft.lines[r.cell_type + "/" + r.behaviour].push_back(r.line);
    result.remark.push_back(
        {r.line, outcome.converted,
         fmt::format("{}: {}{}{}", in_words(r), outcome.text,
                     outcome.converted ? signal_of(r, unit_pressure).note : "",
                     outcome.converted && r.dead ? "; dead cells do not respond here" : "")});
    result.n_converted += outcome.converted ? 1 : 0;
  }
  for (auto& [type, block] : draft.types.items())
    if (block.is_null()) block = OrderedJson::object();
  note_joint_rules(draft, result.remark);
  result.scene = scene_text(draft, name, source, result.remark);
  return result;
}

BaseValues parse_base_values(const std::vector<std::string>& texts) {
  BaseValues base;
  for (const std::string& text : texts) {
    const std::size_t equal = text.rfind('=');
    double value = 0;
    const char* end = text.data() + text.size();
    const auto read = equal == std::string::npos
                          ? std::from_chars_result{end, std::errc::invalid_argument}
                          : std::from_chars(text.data() + equal + 1, end, value);
    check(read.ec == std::errc() && read.ptr == end && value >= 0,
          fmt::format("--base \"{}\": must be BEHAVIOUR=VALUE or CELL TYPE:BEHAVIOUR=VALUE, the "
                      "value a number >= 0 in 1/min or um/min.",
                      text));
    base[text.substr(0, equal)] = value;
  }
  return base;
}

ConvertedRules write_physicell_scene(const std::string& table, const std::string& folder,
                                     const BaseValues& base, double unit_pressure) {
  const fs::path source(table);
  const std::vector<PhysiCellRule> rules = parse_physicell_rules(io::read_text_file(table), table);
  ConvertedRules result = convert_physicell_rules(rules, base, source.stem().string(),
                                                  source.filename().string(), unit_pressure);
  const fs::path file = fs::path(folder) / (name_of(source.stem().string()) + ".json");
  check(!fs::exists(file), file.string() + ": exists already. Give another folder.",
        Exit::kFileError);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) io::fail_on_disk(folder, "be made", error.value());
  io::write_text_file(file.string(), result.scene);
  result.scene = file.string();
  return result;
}

}  // namespace acinus::runs
