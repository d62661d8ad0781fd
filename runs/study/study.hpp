#pragma once
/// A study as its file says it: plain data. A key's default is its initialiser here;
/// study_registry.hpp adds unit, range and meaning.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runs/scene/json_text.hpp"

namespace acinus::runs {

/// A named set of changes to the scene.
struct StudyVariant {
  std::string title;
  std::string extends;              ///< variant whose changes come first; "" = none
  std::vector<JsonMember> set;      ///< scene key -> value
  std::vector<std::int64_t> seeds;  ///< empty = those of the study
  std::string start;                ///< variant whose state at t = 0 is taken; "" = none
};

/// One more variant per value of a key.
struct StudySweep {
  std::vector<std::string> of;  ///< variants
  std::string key;              ///< of the scene
  std::string label;            ///< in the names; "" = the last part of the key
  std::vector<Node> values;
};

/// Points from elsewhere to plot beside the curves.
struct StudyReference {
  std::string name;
  std::vector<Node> x, y;
  std::vector<Node> low, high;  ///< bars; empty = none
};

struct StudyPlot {
  std::string name, title, observable;
  std::vector<std::string> beside;    ///< observables of further panels, in the unit of the first
  std::vector<std::string> variants;  ///< empty = all
  std::string x_label, y_label;
  bool log_y = false;
  std::string over;          ///< scene key on the x axis instead of time; "" = time
  std::optional<double> at;  ///< s, with `over`: when; empty = the end
  std::vector<StudyReference> reference;
};

/// Plots of the study in one file, side by side and below each other, numbered a, b, c ...
struct StudyFigure {
  std::string name;
  std::vector<std::string> plots;  ///< names; the first panel of each
  int columns = 2;
};

struct StudyMeasure {
  std::string kind = "value";
  std::string observable, variant;
  std::string other;                  ///< distance, outside, p_value: the second variant
  std::string another;                ///< outside: the third
  std::optional<double> at;           ///< s; empty = the end
  std::optional<double> from, until;  ///< s, window; empty = the whole run
  std::optional<Node> level;          ///< first_below, first_above
};

inline bool needs_other(const StudyMeasure& m) {
  return m.kind == "distance" || m.kind == "outside" || m.kind == "p_value";
}

/// Heat map of a claim over two scene keys: share of the seeds for which a measure is within
/// bounds.
struct StudyMap {
  std::string name, title;
  std::vector<std::string> variants;  ///< one field each
  std::string x, y;                   ///< scene keys
  StudyMeasure measure;               ///< of every variant; kinds with a value per seed only
  std::optional<Node> low, high;
};

/// A claim: what is measured and what is expected of it.
struct StudyExpectation {
  std::string id, claim;
  std::string each;  ///< label of a sweep: judged for each of its values, too; "" = none
  StudyMeasure measure;
  std::optional<StudyMeasure> minus, over;
  std::optional<Node> low, high;
  bool every_seed = false;
  int least_seeds = 0;  ///< so many seeds must lie within the bounds; 0 = their mean
};

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
