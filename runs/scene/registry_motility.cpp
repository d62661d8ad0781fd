#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {

void describe_motility(Visitor& v, MotilityBlock& b) {
  v.flag({.name = "random", .meaning = "random motion of the cells"}, b.random);
  choice(v,
         {.name = "directions",
          .meaning = "random motion in space, or in the horizontal plane as on a substrate",
          .choices = "space|plane"},
         b.in_plane);
  v.real({.name = "grid",
          .meaning = "time over which a random force stays constant",
          .dimension = kTime,
          .unit = "s",
          .range = kPositive},
         b.grid);
  v.real({.name = "leader_force",
          .meaning = "force of the leading cells toward the vein axis",
          .dimension = kForce,
          .unit = "nN",
          .range = kNotNegative,
          .symbol = "F_mor"},
         b.leader_force);
  v.text({.name = "leader_signal",
          .meaning = "substance whose gradient that force follows upward; \"\" = it points toward "
                     "the vein axis"},
         b.leader_signal);
  v.real({.name = "leader_grid",
          .meaning = "time between two choices of the leading cells",
          .dimension = kTime,
          .unit = "min",
          .range = kPositive},
         b.leader_grid);
  choice(v,
         {.name = "leaders",
          .meaning = "which cells lead. foremost: those with no other cell nearer the vein within "
                     "one diameter in arc and height; front: all with a clear straight way to the "
                     "vein; border: all with a clear way into the lesion, two cell diameters long, "
                     "within 45 degrees of that to the vein; sector: the nearest of every sector "
                     "of the circle and slice of height; "
                     "nearest: the leader_count nearest"},
         b.leaders);
  v.when(b.leaders == coupling::Leaders::kSector || b.leaders == coupling::Leaders::kNearest,
         "leaders = sector, nearest", [&b](Visitor& w) {
           w.integer({.name = "leader_count",
                      .meaning = "nearest: number of leaders; sector: sectors of the whole circle",
                      .range = {.low = 1, .high = 1e6}},
                     b.leader_count);
         });
  v.when(b.leaders == coupling::Leaders::kSector, "leaders = sector", [&b](Visitor& w) {
    real_or_auto(w,
                 {.name = "leader_slice",
                  .meaning = "height of a slice",
                  .dimension = kLength,
                  .unit = "um",
                  .range = kPositive,
                  .automatic = "the cell diameter"},
                 b.leader_slice);
  });
}

}  // namespace acinus::runs
