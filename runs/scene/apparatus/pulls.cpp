#include <fmt/format.h>

#include <utility>

#include "coupling/apparatus/pull/pull.hpp"
#include "runs/scene/apparatus/device_block.hpp"
#include "runs/scene/registry_blocks.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

constexpr Key kForceThen{
    .name = "force", .meaning = "force then", .dimension = kForce, .unit = "nN", .required = true};

constexpr Key kDisplacementThen{.name = "displacement",
                                .meaning = "how far it has moved then",
                                .dimension = kLength,
                                .unit = "um",
                                .required = true};

void describe_pull(Visitor& v, PullEntry& b) {
  v.integer({.name = "cell",
             .meaning = "which cell of cells.list, from 0; the pull ends when it divides or dies",
             .range = kNotNegative},
            b.cell);
  v.vector({.name = "direction", .meaning = "direction of the force and of the displacement"},
           b.direction);
  choice(v,
         {.name = "by",
          .meaning = "force: a prescribed one, spread over the cell; spring: one that holds the "
                     "cell's centre along the direction and whose far end moves"},
         b.by);
  v.when(b.by == PullBy::kForce, "by = force", [&b](Visitor& w) {
    blocks(w, {.name = "force", .meaning = "force over time", .item = "force"}, b.force.entry,
           describe_course_point<kForceThen>);
  });
  v.when(b.by == PullBy::kSpring, "by = spring", [&b](Visitor& w) {
    w.real({.name = "stiffness",
            .meaning = "stiffness of the spring",
            .dimension = kTension,
            .unit = "N/m",
            .range = kPositive,
            .required = true},
           b.stiffness);
    blocks(w,
           {.name = "displacement",
            .meaning = "displacement of the far end over time, from where the cell's position in "
                       "cells.list is; none = it stays there",
            .item = "displacement"},
           b.displacement.entry, describe_course_point<kDisplacementThen>);
  });
}

void describe_pulls_block(Visitor& v, Scene& s) {
  blocks(v,
         {.name = "pulls",
          .meaning = "forces on single cells over time, or springs that hold them",
          .item = "pull"},
         s.pulls, describe_pull);
}

void check_pull(const Scene& scene, const PullEntry& p, const std::string& pointer,
                Report& report) {
  const auto n = static_cast<int>(scene.cells.list.size());
  if (p.cell >= n) {
    report.add_relation({pointer + "/cell", "/cells/list"}, fmt::format("{}", p.cell),
                        fmt::format("there are {} cells in /cells/list, the first is 0", n));
    return;
  }
  if (!(p.direction.norm() > 0))
    report.add_relation({pointer + "/direction"}, "[0, 0, 0]", "has no direction");
  check_course(p.force, pointer + "/force", report);
  check_course(p.displacement, pointer + "/displacement", report);
  if (p.by == PullBy::kForce && p.force.entry.empty())
    report.add_relation({pointer + "/force", pointer}, "",
                        "needs an entry: {\"time\": \"0 s\", \"force\": \"1 nN\"}");
  if (p.by == PullBy::kSpring && model_of(scene, scene.cells.list[p.cell]) != CellModel::kDcm)
    report.add_relation({pointer + "/by", "/cells/model"}, "\"spring\"",
                        "is for deformable cells: set /cells/model to \"dcm\"");
}

void check_pulls(const Scene& scene, Report& report) {
  if (scene.pulls.empty()) return;
  if (scene.cells.source != CellSource::kList) {
    report.add_relation({"/pulls", "/cells/source"}, "", "is for cells that are listed one by one");
    return;
  }
  for (std::size_t k = 0; k < scene.pulls.size(); ++k)
    check_pull(scene, scene.pulls[k], fmt::format("/pulls/{}", k), report);
  if (scene.life.sleep)
    report.add_relation({"/pulls", "/life/sleep"}, "",
                        "is not for cells that may sleep. Set /life/sleep to false");
}

void add_pulls(const Scene& scene, coupling::Params& params) {
  if (scene.pulls.empty()) return;
  coupling::Pulls pulls;
  for (const PullEntry& entry : scene.pulls) {
    coupling::Pull pull = entry;
    pull.direction.normalize();
    pull.anchor = scene.cells.list[pull.cell].position.dot(pull.direction);
    pulls.pull.push_back(std::move(pull));
  }
  params.apparatus.add(std::move(pulls));
}

}  // namespace

CellModel model_of(const Scene& scene, const CellEntry& cell) {
  return cell.model.value_or(model_of(scene));
}

const DeviceBlock kPullsBlock{"pulls", describe_pulls_block, check_pulls, add_pulls};

}  // namespace acinus::runs
