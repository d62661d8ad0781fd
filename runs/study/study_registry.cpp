#include "runs/study/study_registry.hpp"

#include "runs/scene/registry_blocks.hpp"
#include "runs/scene/schema.hpp"

namespace acinus::runs {
namespace {

constexpr const char* kExtends =
    "study file this one changes, relative to this file: blocks are merged";
constexpr Range kSeed{.low = 0};

void describe_variant(Visitor& v, StudyVariant& b) {
  v.text({.name = "title", .meaning = "what plots and report call it", .automatic = "its name"},
         b.title);
  v.text({.name = "extends",
          .meaning =
              "another variant whose changes come first; its seeds and start are not taken over",
          .automatic = "none"},
         b.extends);
  v.settings({.name = "set",
              .meaning = "changes to the scene: \"path.of.key\" and the value as in a scene"},
             b.set);
  v.integers(
      {.name = "seeds", .meaning = "seeds of its own; [] = those of the study", .range = kSeed},
      b.seeds);
  v.text(
      {.name = "start",
       .meaning = "variant whose cells at t = 0 it takes, seed by seed, instead of a start-up of "
                  "its own (start_up.from of scenes)",
       .automatic = "none"},
      b.start);
}

void describe_sweep(Visitor& v, StudySweep& b) {
  v.texts({.name = "of",
           .meaning =
               "variants; NAME/* = all made from NAME by sweeps before; any name may end in * so"},
          b.of);
  v.text({.name = "key", .meaning = "scene key that is changed", .required = true}, b.key);
  v.text({.name = "label",
          .meaning = "stands for the key in the names, as in III/leader_force=0.3 nN",
          .automatic = "the last part of the key",
          .is_name = true},
         b.label);
  v.values({.name = "values", .meaning = "its values, one variant each", .required = true},
           b.values);
}

void describe_reference(Visitor& v, StudyReference& b) {
  v.text({.name = "name", .meaning = "in the legend, e.g. paper, Fig. 10a", .required = true},
         b.name);
  v.values({.name = "x", .meaning = "times, or values of the key in `over`", .required = true},
           b.x);
  v.values({.name = "y", .meaning = "values of the observable", .required = true}, b.y);
  v.values({.name = "low", .meaning = "lower ends of bars; [] = no bars"}, b.low);
  v.values({.name = "high", .meaning = "upper ends of bars"}, b.high);
}

void describe_plot(Visitor& v, StudyPlot& b) {
  v.text({.name = "name", .meaning = "of the file in plots/", .required = true, .is_name = true},
         b.name);
  v.text({.name = "title", .meaning = "above the plot", .automatic = "its name"}, b.title);
  v.text({.name = "observable", .meaning = "what is plotted", .required = true}, b.observable);
  v.texts({.name = "beside",
           .meaning = "observables of further panels at its side, in the same unit and range"},
          b.beside);
  v.texts({.name = "variants",
           .meaning = "one line each, mean and band over seeds; [] = all; NAME/* = all made from "
                      "NAME by sweeps"},
          b.variants);
  v.text({.name = "over",
          .meaning = "scene key on the x axis: one point per variant, at the time `at`",
          .automatic = "time is on the x axis"},
         b.over);
  v.optional_real({.name = "at",
                   .meaning = "with `over`: the time looked at",
                   .dimension = kTime,
                   .unit = "h",
                   .range = kNotNegative,
                   .automatic = "the end"},
                  b.at);
  v.text({.name = "x_label", .meaning = "of the x axis", .automatic = "time or key, with unit"},
         b.x_label);
  v.text({.name = "y_label", .meaning = "of the y axis", .automatic = "observable, with unit"},
         b.y_label);
  v.flag({.name = "log_y", .meaning = "logarithmic y axis"}, b.log_y);
  blocks(v, {.name = "reference", .meaning = "points from elsewhere", .item = "reference"},
         b.reference, describe_reference);
}

void describe_figure(Visitor& v, StudyFigure& b) {
  v.text({.name = "name", .meaning = "of the file in plots/", .required = true, .is_name = true},
         b.name);
  v.texts({.name = "plots", .meaning = "names of plots, of each the first panel", .required = true},
          b.plots);
  v.integer({.name = "columns", .meaning = "plots side by side", .range = {.low = 1, .high = 10}},
            b.columns);
}

/// Describes level, time and window of a measure, depending on its kind.
void describe_moment(Visitor& v, StudyMeasure& b) {
  v.when(is_passage(b), "kind = first_below or first_above", [&b](Visitor& w) {
    w.value({.name = "level",
             .meaning = "what the observable falls below or rises above",
             .required = true},
            b.level);
  });
  v.when(b.kind == MeasureKind::kValue || b.kind == MeasureKind::kPValue, "kind = value or p_value",
         [&b](Visitor& w) {
           w.optional_real({.name = "at",
                            .meaning = "time looked at",
                            .dimension = kTime,
                            .unit = "h",
                            .range = kNotNegative,
                            .automatic = "the end of the run"},
                           b.at);
         });
  v.when(b.kind != MeasureKind::kValue && b.kind != MeasureKind::kPValue,
         "kind other than value and p_value", [&b](Visitor& w) {
           w.optional_real({.name = "from",
                            .meaning = "beginning of the window",
                            .dimension = kTime,
                            .unit = "h",
                            .range = kNotNegative,
                            .automatic = "t = 0"},
                           b.from);
           w.optional_real({.name = "until",
                            .meaning = "end of the window",
                            .dimension = kTime,
                            .unit = "h",
                            .range = kNotNegative,
                            .automatic = "the end of the run"},
                           b.until);
         });
}

void describe_measure(Visitor& v, StudyMeasure& b) {
  choice(v,
         {.name = "kind",
          .meaning =
              "value at a time; first_below, first_above: when the level is first passed; mean, "
              "min, max over a window; distance: largest between the mean curves of two variants; "
              "outside: largest distance of the mean curve from the space between those of two "
              "others; band: widest spread over seeds; p_value: of the t-test between two "
              "variants, paired where both have the same seeds"},
         b.kind);
  v.text({.name = "observable", .meaning = "what is looked at", .required = true}, b.observable);
  v.text({.name = "variant", .meaning = "whose runs", .required = true}, b.variant);
  v.when(needs_other(b), "kind = distance, outside or p_value", [&b](Visitor& w) {
    w.text({.name = "other", .meaning = "the second variant", .required = true}, b.other);
  });
  v.when(b.kind == MeasureKind::kOutside, "kind = outside", [&b](Visitor& w) {
    w.text({.name = "another", .meaning = "the third variant", .required = true}, b.another);
  });
  describe_moment(v, b);
}

/// Describes the range of values for which a claim holds.
void describe_bounds(Visitor& v, std::optional<Node>& low, std::optional<Node>& high) {
  v.value({.name = "low", .meaning = "smallest value that bears the claim out", .automatic = "any"},
          low);
  v.value({.name = "high", .meaning = "largest value that bears it out", .automatic = "any"}, high);
}

void describe_map_measure(Visitor& v, StudyMeasure& b) {
  choice(v,
         {.name = "kind",
          .meaning = "value at a time; first_below, first_above: when the level is first passed; "
                     "mean, min, max over a window",
          .choices = "value|first_below|first_above|mean|min|max"},
         b.kind);
  v.text({.name = "observable", .meaning = "observable that is measured", .required = true},
         b.observable);
  describe_moment(v, b);
}

void describe_map(Visitor& v, StudyMap& b) {
  v.text({.name = "name", .meaning = "of the file in plots/", .required = true, .is_name = true},
         b.name);
  v.text({.name = "title", .meaning = "above the map", .automatic = "its name"}, b.title);
  v.texts({.name = "variants",
           .meaning = "one field each, at its values of both keys; NAME/* = all made from NAME by "
                      "sweeps; [] = all"},
          b.variants);
  v.text({.name = "x", .meaning = "scene key of the columns", .required = true}, b.x);
  v.text({.name = "y", .meaning = "scene key of the rows", .required = true}, b.y);
  block(v, {.name = "measure", .meaning = "measured in every run", .required = true}, b.measure,
        describe_map_measure);
  describe_bounds(v, b.low, b.high);
}

void describe_expectation(Visitor& v, StudyExpectation& b) {
  v.text({.name = "id", .meaning = "short name of the claim", .required = true, .is_name = true},
         b.id);
  v.text({.name = "claim", .meaning = "what is claimed, in a sentence", .required = true}, b.claim);
  v.text({.name = "each",
          .meaning = "label of a sweep: the claim is judged for each of its values, too, with the "
                     "variants that the sweep made of those named here",
          .automatic = "judged once",
          .is_name = true},
         b.each);
  block(v, {.name = "measure", .meaning = "what is measured", .required = true}, b.measure,
        describe_measure);
  optional_block(v, {.name = "minus", .meaning = "second measure, subtracted; null = none"},
                 b.minus, describe_measure);
  optional_block(v, {.name = "over", .meaning = "second measure, divided by; null = none"}, b.over,
                 describe_measure);
  describe_bounds(v, b.low, b.high);
  v.flag({.name = "every_seed",
          .meaning = "every seed must lie within low and high, not only their mean"},
         b.every_seed);
  v.integer({.name = "least_seeds",
             .meaning = "so many seeds must lie within low and high; 0: their mean must",
             .range = {.low = 0}},
            b.least_seeds);
}

}  // namespace

void describe(Visitor& v, Study& s) {
  v.text({.name = "name",
          .meaning = "name of the study and of its folder",
          .automatic = "the study file's name",
          .is_name = true},
         s.name);
  v.text({.name = "description", .meaning = "what the study asks, in a sentence"}, s.description);
  v.text(
      {.name = "scene",
       .meaning = "scene all runs are made from: a file, relative to the study's, or the name of "
                  "a shipped scene",
       .required = true},
      s.scene);
  v.settings(
      {.name = "set", .meaning = "changes to the scene in all runs: \"path.of.key\" and value"},
      s.set);
  v.integers({.name = "seeds", .meaning = "one run of every variant each", .range = kSeed},
             s.seeds);
  named_blocks(v,
               {.name = "variants",
                .meaning = "what is compared, by name; at least one",
                .required = true,
                .item = "variant"},
               s.variants, describe_variant);
  blocks(v, {.name = "sweeps", .meaning = "more variants, one per value of a key", .item = "sweep"},
         s.sweeps, describe_sweep);
  v.texts({.name = "observables", .meaning = "what goes into the table; [] = all there is"},
          s.observables);
  blocks(v, {.name = "plots", .meaning = "curves with mean and band over seeds", .item = "plot"},
         s.plots, describe_plot);
  blocks(v, {.name = "figures", .meaning = "several plots in one picture", .item = "figure"},
         s.figures, describe_figure);
  blocks(v,
         {.name = "maps",
          .meaning = "heat maps: share of the seeds that bear a claim out, over two scene keys",
          .item = "map"},
         s.maps, describe_map);
  blocks(v,
         {.name = "expectations",
          .meaning = "claims and what decides about them",
          .item = "expectation"},
         s.expectations, describe_expectation);
}

const std::vector<Entry>& study_entries() {
  static const std::vector<Entry> entries = [] {
    Study study;
    return collect_entries(
        kExtends, [&](Visitor& visitor) { describe(visitor, study); }, "study.");
  }();
  return entries;
}

std::string study_schema() {
  Study study;
  return make_schema("acinus study", kExtends,
                     [&study](Visitor& visitor) { describe(visitor, study); });
}

}  // namespace acinus::runs
