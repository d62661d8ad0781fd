#include "runs/physicell/counterparts.hpp"

namespace acinus::runs {
namespace {

/// Signal or behaviour of PhysiCell without counterpart: its name or the start of it, and what
/// there is instead.
struct NoCounterpart {
  const char* name;
  const char* instead;
};
constexpr NoCounterpart kSignals[] = {
    {"contact with dead cell", "dead cells are no neighbours"},
    {"contact with dead cells", "dead cells are no neighbours"},
    {"contact with apoptotic cell", "dead cells are no neighbours"},
    {"contact with necrotic cell", "dead cells are no neighbours"},
    {"contact with other dead cell", "dead cells are no neighbours"},
    {"contact with BM", "contact with walls is no signal"},
    {"contact with basement membrane", "contact with walls is no signal"},
    {"damage", "cells have no damage"},
    {"damage delivered", "cells have no damage"},
    {"total damage delivered", "cells have no damage"},
    {"attacking", "cells do not attack"},
    {"is attacking", "cells do not attack"},
    {"total attack time", "cells do not attack"},
    {"dead", "dead cells follow cell_types.<name>.death"},
    {"is dead", "dead cells follow cell_types.<name>.death"},
    {"apoptotic", "dead cells follow cell_types.<name>.death"},
    {"is_apoptotic", "dead cells follow cell_types.<name>.death"},
    {"necrotic", "dead cells follow cell_types.<name>.death"},
    {"is_necrotic", "dead cells follow cell_types.<name>.death"},
    {"time", "a course over time belongs to a substance or to the proliferation of a type"},
    {"current time", "a course over time belongs to a substance"},
    {"global time", "a course over time belongs to a substance"}};
constexpr NoCounterpart kSignalStarts[] = {{"intracellular ", "there is no chemistry inside cells"},
                                           {"custom:", "there are no custom signals"},
                                           {"custom ", "there are no custom signals"}};
constexpr NoCounterpart kBehaviours[] = {
    {"chemotactic", "rules.behaviour = chemotaxis takes a force in nN, which the table has not"},
    {"migration bias", "rules.behaviour = chemotaxis takes a force in nN"},
    {"migration persistence", "random motion is that of cell.diffusion, without persistence"},
    {"exit from cycle phase", "the cycle has one phase"},
    {"transform", "cell types are fixed"},
    {"transition", "cell types are fixed"},
    {"phagocytos", "cells do not eat others"},
    {"attack", "cells do not attack"},
    {"damage", "cells have no damage"},
    {"immunogenicity", "cells do not attack"},
    {"fuse", "cells do not fuse"},
    {"cell-", "only cell-cell adhesion responds"},
    {"adhesive affinity", "adhesion_with is a constant of two types; adhesion responds for all"},
    {"relative maximum adhesion", "adhesion is a constant of a type"},
    {"cell attachment", "there are no springs between cells"},
    {"cell detachment", "there are no springs between cells"},
    {"maximum number of cell attachments", "there are no springs between cells"},
    {"is_movable", "all cells move"},
    {"is movable", "all cells move"},
    {"movable", "all cells move"},
    {"asymmetric division", "a daughter has the type of its mother"},
    {"custom", "there are no custom behaviours"}};

}  // namespace

const char* missing_signal(const std::string& name) {
  for (const NoCounterpart& n : kSignals)
    if (name == n.name) return n.instead;
  for (const NoCounterpart& n : kSignalStarts)
    if (name.starts_with(n.name)) return n.instead;
  return nullptr;
}

const char* missing_behaviour(const std::string& name) {
  for (const NoCounterpart& n : kBehaviours)
    if (name.starts_with(n.name)) return n.instead;
  return nullptr;
}

}  // namespace acinus::runs
