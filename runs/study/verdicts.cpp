#include "runs/study/verdicts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/disk.hpp"
#include "runs/study/study_value.hpp"

namespace acinus::runs {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson number(const std::optional<double>& v) {
  return v && std::isfinite(*v) ? OrderedJson(*v) : OrderedJson(nullptr);
}

std::string describe_window(const StudyMeasure& m) {
  if (!m.from && !m.until) return {};
  if (!m.from) return fmt::format(" until {}", show_value(*m.until, "s"));
  return fmt::format(" from {} {}", show_value(*m.from, "s"),
                     m.until ? "to " + show_value(*m.until, "s") : "on");
}

std::string describe_measure(const StudyMeasure& m) {
  const std::string at = m.at ? "at " + show_value(*m.at, "s") : "at the end";
  const std::string what = fmt::format("`{}` of {}", m.observable, m.variant);
  if (m.kind == MeasureKind::kValue) return what + " " + at;
  if (m.kind == MeasureKind::kPValue)
    return fmt::format("p value of the t-test, `{}` of {} and {} {}", m.observable, m.variant,
                       m.other, at);
  const std::string in = describe_window(m);
  if (is_passage(m))
    return fmt::format("first time {} is {} {}{}", what,
                       m.kind == MeasureKind::kFirstBelow ? "at or below" : "at or above",
                       m.level ? shown(*m.level) : "", in);
  if (m.kind == MeasureKind::kDistance)
    return fmt::format("largest distance of the mean curves of {} and {}{}", what, m.other, in);
  if (m.kind == MeasureKind::kOutside)
    return fmt::format(
        "largest distance of the mean curve of {} from the space between {} and {}{}", what,
        m.other, m.another, in);
  if (m.kind == MeasureKind::kBand)
    return fmt::format("widest spread of {} over seeds{}", what, in);
  return fmt::format("{} of {}{}", name_of_choice(m.kind), what, in);
}

std::string describe_bounds(const Verdict& v) {
  const std::string& unit = v.measured.unit;
  std::string text;
  if (v.expected_low && v.expected_high) {
    text = fmt::format("from {} to {}", show_value(*v.expected_low, unit),
                       show_value(*v.expected_high, unit));
  } else if (v.expected_low) {
    text = "at least " + show_value(*v.expected_low, unit);
  } else if (v.expected_high) {
    text = "at most " + show_value(*v.expected_high, unit);
  }
  if (v.least_seeds > 0) return fmt::format("{}, at least {} seeds", text, v.least_seeds);
  return text + (v.every_seed ? ", every seed" : "");
}

/// Evaluates a claim. An event that did not happen within the runs counts as later than their end;
/// runs say nothing beyond it.
ClaimStatus check_claim(Verdict& v) {
  Measured& m = v.measured;
  if (!m.value) return ClaimStatus::kNotMeasured;
  const double low = v.every_seed ? m.low.value_or(*m.value) : *m.value;
  const double high = v.every_seed ? m.high.value_or(*m.value) : *m.value;
  if (std::isinf(high) && high > 0 && v.expected_low && m.unit == "s" &&
      *v.expected_low > m.known_until) {
    m.note = fmt::format("never before {}, which says nothing about {}",
                         show_value(m.known_until, "s"), show_value(*v.expected_low, "s"));
    if (!v.expected_high) return ClaimStatus::kNotMeasured;
  }
  if (std::isinf(low) && low < 0 && v.expected_high && -*v.expected_high > m.known_until) {
    m.note = fmt::format("known only to be below {}", show_value(-m.known_until, "s"));
    return ClaimStatus::kNotMeasured;
  }
  if (std::isinf(high) && high > 0 && m.note.empty())
    m.note = fmt::format("never before {}", show_value(m.known_until, "s"));
  if (v.least_seeds > 0)
    return seeds_within(m, v.expected_low, v.expected_high) >= v.least_seeds
               ? ClaimStatus::kHolds
               : ClaimStatus::kDoesNotHold;
  const bool above = !v.expected_low || low >= *v.expected_low;
  const bool below = !v.expected_high || high <= *v.expected_high;
  return above && below ? ClaimStatus::kHolds : ClaimStatus::kDoesNotHold;
}

}  // namespace

std::vector<Verdict> check_claims(const StudyPlan& plan, const StudyData& data) {
  std::vector<Verdict> verdicts;
  for (const StudyExpectation& e : plan.study.expectations) {
    Verdict v;
    v.id = e.id;
    v.claim = e.claim;
    v.every_seed = e.every_seed;
    v.least_seeds = e.least_seeds;
    v.how = describe_measure(e.measure);
    if (e.minus) v.how += ", minus " + describe_measure(*e.minus);
    if (e.over) v.how += ", over " + describe_measure(*e.over);
    v.measured = take_measure(plan, data, e);
    if (e.low) v.expected_low = number_in(*e.low, v.measured.unit);
    if (e.high) v.expected_high = number_in(*e.high, v.measured.unit);
    v.expected = describe_bounds(v);
    v.status = check_claim(v);
    verdicts.push_back(v);
  }
  return verdicts;
}

const char* name_of(ClaimStatus status) {
  switch (status) {
    case ClaimStatus::kHolds:
      return "holds";
    case ClaimStatus::kDoesNotHold:
      return "does not hold";
    case ClaimStatus::kNotMeasured:
      break;
  }
  return "not measured";
}

void write_verdicts(const std::vector<Verdict>& verdicts, const std::string& root) {
  OrderedJson all = OrderedJson::array();
  for (const Verdict& v : verdicts) {
    OrderedJson j;
    j["id"] = v.id;
    j["claim"] = v.claim;
    j["how"] = v.how;
    j["expected"] = v.expected;
    j["expected_low"] = number(v.expected_low);
    j["expected_high"] = number(v.expected_high);
    j["measured"] = number(v.measured.value);
    j["low"] = number(v.measured.low);
    j["high"] = number(v.measured.high);
    j["unit"] = v.measured.unit;
    j["pass"] = v.status == ClaimStatus::kNotMeasured
                    ? OrderedJson(nullptr)
                    : OrderedJson(v.status == ClaimStatus::kHolds);
    j["verdict"] = name_of(v.status);
    if (!v.measured.note.empty()) j["note"] = v.measured.note;
    all.push_back(j);
  }
  io::write_text_file(root + "/verdicts.json",
                      all.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n");
}

}  // namespace acinus::runs
