#pragma once
/// Keys of a study as plain data. Defaults are the initialisers here; study_registry.hpp adds unit,
/// range and meaning.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runs/scene/choices.hpp"
#include "runs/scene/json_text.hpp"

namespace acinus::runs {

/// Named set of changes to the scene.
struct StudyVariant {
  std::string title;
  std::string extends;              ///< variant whose changes are applied first; "" = none
  std::vector<JsonMember> set;      ///< scene key -> value
  std::vector<std::int64_t> seeds;  ///< empty = those of the study
  std::string start;                ///< variant whose state at t = 0 is taken; "" = none
};

/// Sweep over a scene key: derives one variant per value.
struct StudySweep {
  std::vector<std::string> of;  ///< variants to derive from
  std::string key;              ///< scene key
  std::string label;            ///< in derived names; "" = last part of the key
  std::vector<Node> values;
};

/// Reference data from elsewhere, plotted beside the curves.
struct StudyReference {
  std::string name;
  std::vector<Node> x, y;
  std::vector<Node> low, high;  ///< error bars; empty = none
};

/// Plot of an observable over time or over a scene key.
struct StudyPlot {
  std::string name, title, observable;
  std::vector<std::string> beside;    ///< observables of further panels, in the unit of the first
  std::vector<std::string> variants;  ///< empty = all
  std::string x_label, y_label;
  bool log_y = false;
  std::string over;          ///< scene key on the x axis; "" = time
  std::optional<double> at;  ///< time of the values with `over`, s; empty = the end
  std::vector<StudyReference> reference;
};

/// Figure of several plots in a grid, with panels numbered a, b, c ...
struct StudyFigure {
  std::string name;
  std::vector<std::string> plots;  ///< names; the first panel of each
  int columns = 2;
};

/// Kind of a measure of one variant up to kMax; kDistance to kPValue compare several runs or
/// variants.
enum class MeasureKind {
  kValue,
  kFirstBelow,
  kFirstAbove,
  kMean,
  kMin,
  kMax,
  kDistance,
  kOutside,
  kBand,
  kPValue
};
template <>
inline constexpr const char* kChoices<MeasureKind> =
    "value|first_below|first_above|mean|min|max|distance|outside|band|p_value";

/// Measure: one number from the curves of an observable.
struct StudyMeasure {
  MeasureKind kind = MeasureKind::kValue;
  std::string observable, variant;
  std::string other;         ///< second variant, for the kinds distance, outside and p_value
  std::string another;       ///< third variant, for the kind outside
  std::optional<double> at;  ///< s; empty = the end
  std::optional<double> from, until;  ///< time window, s; empty = the whole run
  std::optional<Node> level;          ///< for first_below and first_above
};

/// True if the measure compares two variants.
inline bool needs_other(const StudyMeasure& m) {
  return m.kind == MeasureKind::kDistance || m.kind == MeasureKind::kOutside ||
         m.kind == MeasureKind::kPValue;
}
/// True if the measure is the time of a first passage.
inline bool is_passage(const StudyMeasure& m) {
  return m.kind == MeasureKind::kFirstBelow || m.kind == MeasureKind::kFirstAbove;
}

/// Heat map of a claim over two scene keys: share of the seeds whose measure lies within the
/// bounds.
struct StudyMap {
  std::string name, title;
  std::vector<std::string> variants;  ///< one field each
  std::string x, y;                   ///< scene keys
  StudyMeasure measure;               ///< of every variant; only kinds with a value per seed
  std::optional<Node> low, high;
};

/// Claim of a study: a measure and its expected range.
struct StudyExpectation {
  std::string id, claim;
  std::string each;  ///< label of a sweep over whose values the claim is repeated; "" = none
  StudyMeasure measure;
  std::optional<StudyMeasure> minus, over;
  std::optional<Node> low, high;
  bool every_seed = false;
  int least_seeds = 0;  ///< least number of seeds within the bounds; 0 = their mean must be
};

/// All keys of a study file.
struct Study {
  std::string file;  ///< path it was read from
  std::string name, description;
  std::string scene;
  std::vector<JsonMember> set;
  std::vector<std::int64_t> seeds{1};
  std::map<std::string, StudyVariant> variants;
  std::vector<StudySweep> sweeps;
  std::vector<std::string> observables;  ///< empty = all
  std::vector<StudyPlot> plots;
  std::vector<StudyFigure> figures;
  std::vector<StudyMap> maps;
  std::vector<StudyExpectation> expectations;
};

}  // namespace acinus::runs
