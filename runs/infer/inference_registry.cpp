#include "runs/infer/inference_registry.hpp"

#include "runs/scene/registry_blocks.hpp"
#include "runs/scene/schema.hpp"

namespace acinus::runs {
namespace {

constexpr const char* kExtends =
    "inference file this one changes, relative to this file: blocks are merged";

void describe_parameter(Visitor& v, InferredKey& b) {
  v.text({.name = "key", .meaning = "scene key with one number", .required = true}, b.key);
  choice(v,
         {.name = "prior",
          .meaning = "density before the data: uniform between the bounds, uniform in the "
                     "logarithm, or normal, cut off at the bounds"},
         b.prior);
  v.value({.name = "low", .meaning = "lower bound; required unless the prior is normal"}, b.low);
  v.value({.name = "high", .meaning = "upper bound; required unless the prior is normal"}, b.high);
  v.when(b.prior == PriorKind::kNormal, "prior = normal", [&b](Visitor& w) {
    w.value({.name = "mean", .meaning = "of the prior", .required = true}, b.mean);
    w.value({.name = "sd", .meaning = "standard deviation of the prior", .required = true}, b.sd);
  });
}

void describe_abc(Visitor& v, AbcSettings& b) {
  v.integer({.name = "particles",
             .meaning = "accepted simulations of each population",
             .range = {.low = 5, .high = 20000}},
            b.particles);
  v.integer({.name = "populations", .meaning = "at most so many", .range = {.low = 1, .high = 50}},
            b.populations);
  v.real({.name = "quantile",
          .meaning = "share of the distances of a population that is within the next tolerance",
          .range = {.low = 0, .high = 1, .low_open = true, .high_open = true}},
         b.quantile);
  v.real({.name = "tolerance",
          .meaning = "ends with the population that has this distance, in standard errors, as its "
                     "tolerance",
          .range = {.low = 0}},
         b.tolerance);
  v.real({.name = "least_acceptance",
          .meaning = "ends before a population that accepts a smaller share of its simulations",
          .range = {.low = 1e-4, .high = 1}},
         b.least_acceptance);
}

}  // namespace

void describe(Visitor& v, Inference& b) {
  v.text({.name = "name",
          .meaning = "of the folder",
          .automatic = "that of the file",
          .is_name = true},
         b.name);
  v.text({.name = "scene",
          .meaning = "scene of every simulation: a file beside this one or a shipped scene",
          .required = true},
         b.scene);
  v.settings({.name = "set",
              .meaning = "changes in every run: \"path.of.key\" and the value as in a scene"},
             b.set);
  blocks(v, {.name = "parameters", .meaning = "scene keys to infer", .item = "parameter"},
         b.parameters, describe_parameter);
  v.text({.name = "target",
          .meaning = "table of measured values (CSV): time, observable, value, sd",
          .required = true,
          .is_file = true},
         b.target);
  choice(v,
         {.name = "method",
          .meaning = "abc: approximate Bayesian computation in populations; scan: a grid"},
         b.method);
  v.seed({.name = "seed", .meaning = "of all random numbers"}, b.abc.seed);
  v.when(b.method == InferenceMethod::kAbc, "method = abc",
         [&b](Visitor& w) { describe_abc(w, b.abc); });
  v.when(b.method == InferenceMethod::kScan, "method = scan", [&b](Visitor& w) {
    w.integer({.name = "steps",
               .meaning = "points along each parameter, bounds included",
               .range = {.low = 2, .high = 1000}},
              b.steps);
  });
}

const std::vector<Entry>& inference_entries() {
  static const std::vector<Entry> entries = [] {
    Inference inference;
    return collect_entries(
        kExtends, [&](Visitor& visitor) { describe(visitor, inference); }, "inference.");
  }();
  return entries;
}

std::string inference_schema() {
  Inference inference;
  return make_schema("acinus inference", kExtends,
                     [&inference](Visitor& visitor) { describe(visitor, inference); });
}

}  // namespace acinus::runs
