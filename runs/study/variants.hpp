#pragma once
/// Variants of a study: named ones and those derived by sweeps.

#include <cstdint>
#include <string>
#include <vector>

#include "runs/scene/fault_report.hpp"
#include "runs/study/study.hpp"

namespace acinus::runs {

/// Change of one scene key, with its position in the study file.
struct Setting {
  JsonMember value;     ///< name: the scene key
  std::string pointer;  ///< "/variants/III/set/time.end"
};

/// Variant with all its settings.
struct Variant {
  std::string name;  ///< "III", or "III/leader_force=0.3 nN"
  std::string title;
  std::string folder;        ///< name with unsafe characters replaced
  std::string pointer;       ///< position in the study file
  std::vector<Setting> set;  ///< in the order of application
  std::vector<std::int64_t> seeds;
  std::string start;  ///< variant whose state at t = 0 is taken; "" = its own start
};

/// Part of a variant's name for a value of a sweep: "leader_force=0.3 nN".
std::string name_of_value(const StudySweep& sweep, const Node& value);

/// Makes all variants, named ones by name, each sweep's after those it derives from. Unknown names,
/// cycles, duplicate names and duplicate seeds are added to the report.
std::vector<Variant> make_variants(const Study& study, Report& report);

/// Variants that a name stands for: the variant itself, or with * at the end all with that prefix.
/// @return indices into `variants`; none if there is no such variant
std::vector<std::size_t> find_variants(const std::vector<Variant>& variants,
                                       const std::string& name);

/// Message for a name without a variant.
std::string unknown_variant(const std::vector<Variant>& variants, const std::string& name);

}  // namespace acinus::runs
