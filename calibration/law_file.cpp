#include "calibration/law_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/json_size.hpp"
#include "io/disk.hpp"

namespace acinus::calibration {
namespace {

using Json = nlohmann::ordered_json;

/// Hashed content of a law: everything but the hash itself, warnings and provenance.
Json numbers_of(const Law& law) {
  Json j;
  j["schema_version"] = kLawSchema;
  j["a0_kPa"] = law.a0;
  j["a1_kPa"] = law.a1;
  j["power"] = law.power;
  j["table"] = Json::array();
  for (const TableEntry& e : law.table)
    j["table"].push_back({{"overlap", e.overlap}, {"modulus_kPa", e.modulus}});
  j["a1_interval_kPa"] = law.a1_interval;
  j["overlap_range"] = law.overlap_range;
  j["wall_recess"] = law.wall_recess;
  j["friction_share"] = law.friction_share;
  // Younger than the schema: files of older versions do without.
  if (law.pull_off_ratio > 0) j["pull_off_ratio"] = law.pull_off_ratio;
  j["r_squared"] = law.r_squared;
  j["rms_relative"] = law.rms_relative;
  j["jkr_underestimation"] = law.jkr_underestimation;
  j["dcm"] = law.dcm;
  j["cbm"] = law.cbm;
  return j;
}

std::string hash_of(const Json& numbers) {
  const std::string text = numbers.dump();
  return fmt::format("{:016x}", XXH64(text.data(), text.size(), 0));
}

/// Path of the first number that is not finite; empty: all are.
std::string find_not_finite(const Json& j, const std::string& path = "") {
  if (j.is_number_float() && !std::isfinite(j.get<double>())) return path.empty() ? "/" : path;
  if (!j.is_structured()) return "";
  for (const auto& [key, value] : j.items())
    if (const std::string at = find_not_finite(value, path + "/" + key); !at.empty()) return at;
  return "";
}

/// Reader of the keys of one object, with errors for the user.
class Reader {
 public:
  Reader(const Json& json, std::string where) : json_(json), where_(std::move(where)) {
    check(json_.is_object(), where_ + ": expected an object {...}");
  }

  const Json& at(const char* key) const {
    check(json_.contains(key),
          fmt::format("{}: \"{}\" is missing. `acinus calibrate` writes whole law files", where_,
                      key));
    return json_.at(key);
  }
  double number(const char* key, double low, double high = kAny) const {
    return number(at(key), fmt::format("{}/{}", where_, key), low, high);
  }
  std::array<double, 2> interval(const char* key, double low, double high = kAny) const {
    const Json& v = at(key);
    const std::string where = fmt::format("{}/{}", where_, key);
    check(v.is_array() && v.size() == 2, where + ": expected two numbers [low, high]");
    const std::array<double, 2> out{number(v[0], where + "/0", low, high),
                                    number(v[1], where + "/1", low, high)};
    check(out[0] <= out[1], fmt::format("{}: {} is above {}", where, out[0], out[1]));
    return out;
  }
  Parameters parameters(const char* key) const {
    const Json& v = at(key);
    const std::string where = fmt::format("{}/{}", where_, key);
    check(v.is_object(), where + ": expected an object of numbers");
    Parameters p;
    for (const auto& [name, value] : v.items())
      p[name] = number(value, where + "/" + name, -kAny, kAny);
    return p;
  }
  /// Throws Error at an unknown key: a typing error, or a key of another program.
  void has_only(const std::vector<std::string>& known) const {
    for (const auto& [name, unused] : json_.items())
      check(std::ranges::find(known, name) != known.end(),
            fmt::format("{}: has an unknown key \"{}\"; known are {}. Calibrate again", where_,
                        name, fmt::join(known, ", ")));
  }
  static double number(const Json& v, const std::string& where, double low, double high) {
    check(v.is_number(), fmt::format("{}: expected a number, found {}", where, v.dump()));
    const double x = v.get<double>();
    check(std::isfinite(x) && x >= low && x <= high,
          fmt::format("{}: {:.6g} is not allowed, only {:.6g} to {:.6g}", where, x, low, high));
    return x;
  }

  static constexpr double kAny = 1e300;

 private:
  const Json& json_;
  std::string where_;
};

std::vector<TableEntry> read_table(const Json& json, const std::string& where) {
  check(json.is_array() && json.size() != 1, where + ": expected a list of two or more, or none");
  std::vector<TableEntry> table;
  for (std::size_t k = 0; k < json.size(); ++k) {
    const Reader entry(json[k], fmt::format("{}/{}", where, k));
    entry.has_only({"overlap", "modulus_kPa"});
    table.push_back({entry.number("overlap", 0, 0.5), entry.number("modulus_kPa", 1e-12)});
    check(k == 0 || table[k - 1].overlap < table[k].overlap,
          fmt::format("{}/{}: overlaps must rise from one entry to the next", where, k));
  }
  return table;
}

Json parse(const std::string& path) {
  const std::string text = io::read_text_file(path);
  const std::string fault = fault_of_json_size(text);
  check(fault.empty(), fmt::format("{}: {}: no law file. Calibrate again", path, fault));
  try {
    return Json::parse(text, nullptr, true, true);
  } catch (const Json::parse_error& e) {
    const auto end = static_cast<std::ptrdiff_t>(std::min<std::size_t>(text.size(), e.byte));
    const auto line = 1 + std::count(text.begin(), text.begin() + end, '\n');
    throw Error(fmt::format(
        "{}:{}: not JSON (NaN and infinity are not numbers there). Calibrate again", path, line));
  } catch (const Json::out_of_range&) {
    throw Error(path + ": has a number too large for this machine. Calibrate again");
  }
}

}  // namespace

std::string law_text(const Law& law) {
  Json j = numbers_of(law);
  const std::string bad = find_not_finite(j);
  check(bad.empty(), "the law has a number that is not finite at " + bad + " and is not written",
        Exit::kCannotContinue);
  j["hash"] = hash_of(j);
  j["warnings"] = law.warnings;
  j["provenance"] = law.provenance;
  return j.dump(2) + "\n";
}

void write_law(const Law& law, const std::string& path) {
  io::write_text_file(path, law_text(law));
}

Law read_law(const std::string& path) {
  const Json j = parse(path);
  const Reader r(j, path);
  const double schema = r.number("schema_version", 0);
  check(
      schema == kLawSchema,
      fmt::format("{}: schema_version {} is that of another version of acinus, this one reads {}. "
                  "Calibrate again",
                  path, schema, kLawSchema));
  Law law;
  law.a0 = r.number("a0_kPa", 1e-12);
  law.a1 = r.number("a1_kPa", 0);
  law.power = r.number("power", 1.000001, 20);
  law.table = read_table(r.at("table"), path + "/table");
  law.a1_interval = r.interval("a1_interval_kPa", -Reader::kAny);
  law.overlap_range = r.interval("overlap_range", 0, 0.5);
  check(law.overlap_range[1] > 0, path + "/overlap_range: the fit covers nothing");
  check(law.table.empty() || law.overlap_range[1] == law.table.back().overlap,
        path + "/overlap_range: the table ends elsewhere");
  law.wall_recess = r.number("wall_recess", 0, cbm::kLargestRecess);
  law.friction_share = r.number("friction_share", 0, kLargestFrictionShare);
  if (j.contains("pull_off_ratio")) law.pull_off_ratio = r.number("pull_off_ratio", 1e-12);
  law.r_squared = r.number("r_squared", -Reader::kAny, 1);
  law.rms_relative = r.number("rms_relative", 0);
  law.jkr_underestimation = r.number("jkr_underestimation", 0);
  law.dcm = r.parameters("dcm");
  law.cbm = r.parameters("cbm");
  const Json numbers = numbers_of(law);
  std::vector<std::string> known{"hash", "warnings", "provenance"};
  for (const auto& [name, unused] : numbers.items()) known.push_back(name);
  r.has_only(known);
  check(r.at("hash") == hash_of(numbers),
        path +
            "/hash: does not belong to these numbers: the file was changed by hand or damaged. "
            "Calibrate again");
  const cbm::StiffnessLaw whole = stiffness_law(law);
  for (int k = 0; k <= 100; ++k) {
    const double d = whole.range * cbm::kLawCap * k / 100;
    check(cbm::corrected_modulus(whole, law.a0, d).value > 0,
          fmt::format("{}: the modulus is not positive at d = {:.3g}", path, d));
  }
  if (j.contains("warnings") && j["warnings"].is_array())
    for (const Json& text : j["warnings"])
      if (text.is_string()) law.warnings.push_back(text.get<std::string>());
  if (j.contains("provenance") && j["provenance"].is_object())
    for (const auto& [name, value] : j["provenance"].items())
      if (value.is_string()) law.provenance[name] = value.get<std::string>();
  return law;
}

}  // namespace acinus::calibration
