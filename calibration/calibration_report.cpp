#include "calibration/calibration_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "calibration/recovery.hpp"
#include "io/disk.hpp"
#include "io/plot.hpp"

namespace acinus::calibration {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kPa_in_Pa = 1e3;

io::PlotLine line(const std::string& name, const std::vector<double>& x,
                  const std::vector<double>& y, double x_unit = 1) {
  io::PlotLine out{name, {}, false, true};
  for (std::size_t k = 0; k < x.size(); ++k) out.point.emplace_back(x[k] / x_unit, y[k]);
  return out;
}

Json json_of(const ForceCurve& c) { return {{"overlap", c.overlap}, {"force_nN", c.force}}; }

Json json_of(const Slide& s) { return {{"time_s", s.time}, {"slid_um", s.slid}}; }

Json json_of(const Relaxation& r) {
  const Recovery back = measure_recovery(r.time, r.overlap);
  return {{"time_s", r.time},
          {"overlap", r.overlap},
          {"back_10s", back.sprung},
          {"efold_h", back.efold / 3600},  // JSON has null where there is no number
          {"return_h", back.time / 3600},
          {"relaxation_time_h", r.decay.time / 3600},
          {"misfit", r.decay.rms}};
}

/// Relaxation with another cell-cell friction: the one that was asked for, else the fitted one.
const FrictionFit& other_friction(const Calibration& c) {
  return c.checked.friction > 0 ? c.checked : c.friction;
}

std::string row(const std::string& name, const std::string& value) {
  return fmt::format("  {:44} {}\n", name, value);
}

}  // namespace

std::string calibration_table(const Calibration& c) {
  const FitAttempt &first = c.attempts.front(), &last = c.attempts.back();
  std::string t = fmt::format(
      "{} cells of {:.0f} nodes, seed {}; means over {} that are not at the capsule\n",
      c.law.provenance.at("cells"), c.law.dcm.at("nodes"), c.law.provenance.at("seed"), c.inner);
  t += row("contacts of the central cell", fmt::format("{:.0f} at the start, {:.0f} compressed",
                                                       c.contacts_first, c.contacts_last));
  t += row("d of the central cell while nothing presses", fmt::format("{:.3f}", c.overlap_at_rest));
  if (c.pair_overlap > 0)
    t += row("overlap of two cells by themselves", fmt::format("{:.3f}", c.pair_overlap));
  for (const FitAttempt& a : c.attempts)
    t += row(fmt::format("error of {}", a.form),
             fmt::format("{:.1f} % rms of the force, {:.0f} % point by point",
                         100 * a.law.rms_relative, 100 * a.pointwise));
  t += row("a0", fmt::format("{:.4g} Pa", kPa_in_Pa * first.law.a0));
  t += row("a1", fmt::format("{:.3g} Pa, 95 % interval {:.3g} to {:.3g} Pa, power {:.3g}",
                             kPa_in_Pa * first.law.a1, kPa_in_Pa * first.law.a1_interval[0],
                             kPa_in_Pa * first.law.a1_interval[1], first.law.power));
  if (!last.law.table.empty())
    t += row("moduli of the table",
             fmt::format("{:.3g} Pa at d = {:.3f} to {:.3g} Pa at d = {:.3f}",
                         kPa_in_Pa * last.law.table.front().modulus, last.law.table.front().overlap,
                         kPa_in_Pa * last.law.table.back().modulus, last.law.table.back().overlap));
  t += row("range of d",
           fmt::format("{:.3f} to {:.3f}", first.law.overlap_range[0], first.law.overlap_range[1]));
  t += row("deformable cells over plain spheres",
           fmt::format("{:.1f} times the force at d = {:.2f}", last.law.jkr_underestimation,
                       last.law.overlap_range[1]));
  t += row("plain spheres compressed by themselves",
           fmt::format("{:.0f} % rms off the deformable cells' force at the same d",
                       100 * c.error_plain));
  t += row("corrected spheres compressed by themselves",
           fmt::format("{:.1f} %", 100 * c.error_corrected));
  if (c.law.friction_share > 0)
    t += row("friction per area between spheres",
             fmt::format("{:.3f} of that of deformable cells: two layers then slide {:.2f} um, "
                         "where those slide {:.2f} um",
                         c.law.friction_share, steady_slide(c.slid_corrected),
                         steady_slide(c.slid_dcm)));
  if (c.law.pull_off_ratio > 0)
    t += row("pull-off of two cells, out of sample",
             fmt::format("{:.2f} nN, of two spheres {:.2f} nN: {:.0f} % too little",
                         c.law.pull_off_ratio * c.pull_off_cbm, c.pull_off_cbm,
                         100 * (1 - 1 / c.law.pull_off_ratio)));
  t += row("fit for other scenes", c.law.warnings.empty() ? "yes" : "no, see the warnings");
  t += row(
      "at walls they leave out",
      fmt::format("{:.3f} of their radius; for the same force the capsule is then {:.2f} um wider",
                  c.law.wall_recess, c.capsule_excess));
  if (!c.relaxation.empty()) {
    const double t1 = c.relaxation[0].decay.time, t5 = c.relaxation[1].decay.time;
    const Recovery back = measure_recovery(c.relaxation[0].time, c.relaxation[0].overlap);
    t += row("relaxation after release",
             fmt::format("{:.0f} % of the way in 10 s, e-fold of the rest {:.3g} h, within 1 % of "
                         "the end after {:.3g} h",
                         100 * back.sprung, back.efold / 3600, back.time / 3600));
    t += row("one exponential for all of it",
             fmt::format("{:.3g} h (misfit {:.0f} %)", t1 / 3600, 100 * c.relaxation[0].decay.rms));
    t += row("with all friction x 5", fmt::format("{:.3f} times as long", t5 / t1));
    const FrictionFit& f = other_friction(c);
    if (f.friction == 0) return t;
    t += row(fmt::format("cell-cell friction {} {:.3g} h", c.checked.friction > 0 ? "gives" : "for",
                         f.relaxation.decay.time / 3600),
             fmt::format("{:.3g} N s/m^3, {:.3g} times the scene's", 1e9 * f.friction,
                         f.friction / c.friction_before));
  }
  return t;
}

void write_curves(const Calibration& c, const std::string& folder) {
  Json j;
  j["dcm"] = json_of(c.dcm);
  j["cbm"] = json_of(c.plain);
  j["cbm_corrected"] = json_of(c.corrected);
  j["error_plain"] = c.error_plain;  // JSON has null where there is no number
  j["error_corrected"] = c.error_corrected;
  j["contacts"] = {c.contacts_first, c.contacts_last};
  j["inner_cells"] = c.inner;
  j["warnings"] = c.law.warnings;
  j["wall_recess"] = c.law.wall_recess;
  j["capsule_excess_um"] = c.capsule_excess;
  if (c.law.friction_share > 0) {
    j["friction_share"] = c.law.friction_share;
    j["slid_dcm"] = json_of(c.slid_dcm);
    j["slid_cbm_equal_friction"] = json_of(c.slid_plain);
    j["slid_cbm_corrected"] = json_of(c.slid_corrected);
  }
  if (c.law.pull_off_ratio > 0) {
    j["pull_off_ratio"] = c.law.pull_off_ratio;
    j["pull_off_dcm_nN"] = c.pull_off_dcm;
    j["pull_off_cbm_nN"] = c.pull_off_cbm;
  }
  j["forms"] = Json::array();
  for (const FitAttempt& a : c.attempts)
    j["forms"].push_back({{"form", a.form},
                          {"a1_kPa", a.law.a1},
                          {"rms_relative", a.law.rms_relative},
                          {"pointwise", a.pointwise}});
  if (!c.relaxation.empty()) {
    j["relaxation"] = json_of(c.relaxation[0]);
    j["relaxation_friction_x5"] = json_of(c.relaxation[1]);
    const FrictionFit& other = other_friction(c);
    if (other.friction > 0) {
      j["relaxation_other_friction"] = json_of(other.relaxation);
      j["other_friction_N_s_per_m3"] = 1e9 * other.friction;
    }
  }
  io::write_text_file(folder + "/curves.json", j.dump(1) + "\n");
  io::write_plot(folder + "/force.svg",
                 {"Compressed clump, mean of the inner cells",
                  "relative overlap d",
                  "sum of normal forces, nN",
                  false,
                  false,
                  {line("deformable cells", c.dcm.overlap, c.dcm.force),
                   line("spheres, JKR", c.plain.overlap, c.plain.force),
                   line("spheres, corrected", c.corrected.overlap, c.corrected.force)}});
  if (c.law.friction_share > 0)
    io::write_plot(
        folder + "/sliding.svg",
        {"Two layers under shear",
         "time, h",
         "distance slid, um",
         false,
         false,
         {line("deformable cells", c.slid_dcm.time, c.slid_dcm.slid, 3600),
          line("spheres, same friction", c.slid_plain.time, c.slid_plain.slid, 3600),
          line("spheres, corrected", c.slid_corrected.time, c.slid_corrected.slid, 3600)}});
  if (c.relaxation.empty()) return;
  std::vector<io::PlotLine> lines{
      line("friction of the scene", c.relaxation[0].time, c.relaxation[0].overlap, 3600),
      line("all friction x 5", c.relaxation[1].time, c.relaxation[1].overlap, 3600)};
  if (const FrictionFit& other = other_friction(c); other.friction > 0)
    lines.push_back(
        line("other cell-cell friction", other.relaxation.time, other.relaxation.overlap, 3600));
  io::write_plot(folder + "/relaxation.svg",
                 {"Clump let go", "time, h", "overlap with the nearest 14", true, false, lines});
}

}  // namespace acinus::calibration
