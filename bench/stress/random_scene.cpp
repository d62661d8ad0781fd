#include "bench/stress/random_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/stress/random_law.hpp"
#include "bench/stress/random_life.hpp"
#include "bench/stress/random_streams.hpp"
#include "bench/stress/random_substance.hpp"
#include "bench/stress/random_zoom.hpp"
#include "core/numbers/random.hpp"
#include "coupling/generate/packing.hpp"

namespace acinus::bench {
namespace {

using Json = nlohmann::ordered_json;

/// Budget of a scene in steps of a deformable 162-node cell, if step-size control does not
/// interfere: about two seconds.
constexpr double kMostCellSteps = 2500;
constexpr double kFewestSteps = 15, kMostSteps = 150;
/// Target packing fractions of a compression before cells are compressed. Coarse meshes leave the
/// corners of a box empty and would be compressed far more than asked.
constexpr double kFullPacking = 0.75, kTightPacking = 0.92;
/// Least volume of a compressed cell, relative to its start.
constexpr double kLeastCompressedVolume = 0.6;
constexpr double kStartGap = 0.2;           ///< between cells and walls at the start, um
constexpr double kFastestNominalWall = 20;  ///< fastest wall of a nominal scene, um/h
constexpr double kSinusoidRadius = 4.7;     ///< vessel radius, um

std::string quantity(double value, const char* unit) {
  return fmt::format("{:.5g} {}", value, unit);
}
Json place(const Vec3& x) {
  return {quantity(x.x(), "um"), quantity(x.y(), "um"), quantity(x.z(), "um")};
}

/// Generator of one scene. Members are drawn in a fixed order, so that the text depends on the seed
/// alone.
class Drawing {
 public:
  explicit Drawing(std::uint64_t seed)
      : seed_(seed),
        wide_(family_of(seed) == Family::kWide),
        random_(seed, Purpose::kSampling, kSceneStream) {}
  RandomScene draw(const SceneKind& kind);

 private:
  bool chance(double p) { return random_.uniform() < p; }
  double decades(double low, double high) { return low * std::pow(high / low, random_.uniform()); }
  /// Value of Table 1, in wide scenes up to ten times smaller or larger.
  double near(double value) { return wide_ ? value * std::pow(10, random_.uniform(-1, 1)) : value; }
  double range(double low, double high) { return near(decades(low, high)); }

  void draw_cell_type();
  void draw_share();
  void draw_motion();
  void draw_clump();
  void draw_list();
  void draw_box();
  void draw_fill();
  void draw_lobule();
  void add_capsule(double reach);
  void add_zoom(double half_width);
  void draw_time();
  void add_life();
  void add_moving_zoom();
  /// Volume of the cells after compression relative to their rest volume.
  double compressed_volume();
  double rest_volume() const { return count_ * 4.0 / 3 * kPi * std::pow(radius_, 3); }
  /// Limits speed (um/h) and travel (um) of a moving wall to the scene's duration.
  void limit_motion(double& travel, double& speed) const;

  std::uint64_t seed_;
  bool wide_;
  UniformStream random_;
  Json scene_;
  RandomScene result_;
  int count_ = 0, nodes_ = 162;
  double radius_ = 0, bulk_ = 0, spacing_ = 1, jitter_ = 0;
  double share_ = 1;  ///< of deformable cells
  double end_ = 0;    ///< s
};

void Drawing::draw_cell_type() {
  radius_ = wide_ ? decades(6, 24) : random_.uniform(8.8, 12);
  nodes_ = chance(0.45) ? 42 : chance(0.9) ? 162 : 642;
  const double adhesion = wide_ ? decades(1e-6, 1e-3) : decades(1e-5, 5e-5);
  bulk_ = range(750, 2500);
  Json dcm;
  dcm["nodes"] = nodes_;
  dcm["cortex_young"] = quantity(near(1000), "Pa");
  dcm["cortex_thickness"] = quantity(near(0.5), "um");
  dcm["cortex_poisson"] = wide_ ? random_.uniform(0, 0.5) : 0.5;
  dcm["area_modulus"] = quantity(near(8e-4), "N/m");
  dcm["bulk_modulus"] = quantity(bulk_, "Pa");
  dcm["nodal_friction"] = quantity(near(1e-4), "N s/m");
  dcm["ecm_friction"] = quantity(near(1e8), "N s/m^3");
  Json cbm;
  const double poisson = wide_ ? random_.uniform(0.3, 0.49) : 0.47;
  if (wide_) cbm["young"] = quantity(near(450), "Pa");
  cbm["poisson"] = poisson;
  cbm["ecm_friction"] = quantity(near(5e8), "N s/m^3");
  Json type;
  type["radius"] = quantity(radius_, "um");
  type["adhesion"] = quantity(adhesion, "J/m^2");
  type["diffusion"] = quantity(near(1e-16), "m^2/s");
  type["dcm"] = dcm;
  type["cbm"] = cbm;
  scene_["cell_types"]["cell"] = type;
}

void Drawing::draw_share() {
  const double kind = random_.uniform(), between = random_.uniform();
  share_ = kind < 0.2 ? 0 : kind < 0.6 ? 1 : between;
  count_ = static_cast<int>(std::lround(decades(2, 64)));
  if (nodes_ > 162 && share_ > 0) count_ = std::min(count_, 6);
  spacing_ = wide_ ? random_.uniform(0.6, 1.05) : random_.uniform(0.96, 1.05);
  jitter_ = wide_ ? random_.uniform(0, 0.15) : random_.uniform(0, 0.01);
}

void Drawing::draw_motion() {
  Json motility;
  motility["random"] = chance(0.6);
  const bool liquid = chance(0.1);
  // In liquid the force of a leader would carry a cell away by a diameter in milliseconds.
  if (chance(0.35) && !liquid) {
    motility["leader_force"] = quantity(wide_ ? decades(0.1, 10) : decades(0.1, 1), "nN");
    motility["leader_grid"] = quantity(wide_ ? decades(1, 30) : 10, "min");
  }
  scene_["motility"] = motility;
  Json friction;
  friction["dcm_dcm"] = quantity(near(5e10), "N s/m^3");
  friction["cbm_cbm"] = quantity(near(1e10), "N s/m^3");
  if (liquid) {
    friction["medium"] = "liquid";
    friction["viscosity"] = quantity(near(1e-3), "Pa s");
  }
  scene_["friction"] = friction;
  scene_["contact"]["quadrature"] = chance(0.6) ? "3-point" : "nodes";
}

void Drawing::draw_time() {
  const double adaptive_step = wide_ ? decades(1, 1800) : decades(5, 120);
  const bool adaptive = !wide_ || chance(0.7);
  Json time;
  const double cell = 0.0004 * std::pow(nodes_, 1.5);  // contacts of fine meshes cost more
  const double weight = count_ * (share_ * cell + (1 - share_) * 0.03);
  const double steps = std::clamp(kMostCellSteps / weight, kFewestSteps, kMostSteps);
  // A controlled step rarely becomes longer than some minutes.
  end_ = steps * (adaptive ? std::min(adaptive_step, 120.0) : adaptive_step);
  time["end"] = quantity(end_, "s");
  time["step"] = quantity(adaptive_step, "s");
  if (!adaptive) time["adaptive"] = false;
  const double tolerance = random_.uniform();
  if (tolerance > 0.5) time["tolerance"] = tolerance > 0.75 ? "0.3 um" : "0.1 um";
  const double method = random_.uniform();
  if (wide_ && method < 0.06) time["integrator"] = method < 0.03 ? "explicit-euler" : "newton";
  scene_["time"] = time;
  scene_["output"]["every"] = quantity(end_ / 4, "s");
}

double Drawing::compressed_volume() {
  const double pressure = wide_ ? decades(50, 1000) : decades(50, 300);  // Pa
  return std::max(std::exp(-pressure / bulk_), kLeastCompressedVolume) /
         (wide_ ? kTightPacking : kFullPacking);
}

void Drawing::limit_motion(double& travel, double& speed) const {
  const double duration = 0.6 * end_ / 3600;  // the rest of the time shows what comes after
  if (!wide_) travel = std::min(travel, kFastestNominalWall * duration);
  speed = travel / duration;
}

void Drawing::add_zoom(double half_width) {
  if (share_ <= 0 || share_ >= 1) {
    scene_["cells"]["model"] = share_ > 0 ? "dcm" : "cbm";
    return;
  }
  scene_["cells"]["model"] = "zoom";
  const Vec3 point((2 * share_ - 1) * half_width, 0, 0);
  scene_["zoom"] = Json::array(
      {Json::object({{"kind", "half_space"}, {"point", place(point)}, {"normal", {1, 0, 0}}})});
}

void Drawing::add_capsule(double reach) {
  const double radius = reach + radius_ + kStartGap;
  double travel = radius - std::cbrt(3 / (4 * kPi) * rest_volume() * compressed_volume());
  if (travel <= 0) return;
  double speed = 0;
  limit_motion(travel, speed);
  scene_["capsule"] = {{"radius", quantity(radius, "um")},
                       {"speed", quantity(speed, "um/h")},
                       {"min_radius", quantity(radius - travel, "um")}};
}

void Drawing::draw_clump() {
  const bool fcc = chance(0.7), in_capsule = chance(0.5);
  const double distance = 2 * radius_ * spacing_;
  scene_["cells"] = {{"source", "clump"},
                     {"count", count_},
                     {"lattice", fcc ? "fcc" : "bcc"},
                     {"spacing", spacing_},
                     {"jitter", jitter_}};
  double reach = 0;
  for (const Vec3& x : coupling::make_clump(
           {fcc ? coupling::Lattice::kFcc : coupling::Lattice::kBcc, count_, distance, 0}, {}))
    reach = std::max(reach, x.norm());
  add_zoom(reach);
  if (in_capsule) add_capsule(reach + 2 * radius_ * jitter_);
  if (chance(0.15)) {
    scene_["start_up"] = {{"enabled", true},
                          {"growth_time", quantity(decades(10, 60), "min")},
                          {"adhesion_ramp", quantity(decades(2, 15), "min")},
                          {"max_duration", quantity(decades(5, 30), "min")}};
  }
}

/// Draws a list of cells: fixed mesh orientation, random models, some cells pulled.
void Drawing::draw_list() {
  const bool pulled = chance(0.5) && !scene_["friction"].contains("medium");
  const coupling::Uniform uniform = [this] { return random_.uniform(); };
  const double diameter = 2 * radius_;
  Json list = Json::array();
  for (const Vec3& x :
       coupling::make_clump({chance(0.5) ? coupling::Lattice::kFcc : coupling::Lattice::kBcc,
                             count_, diameter * spacing_, diameter * jitter_},
                            uniform)) {
    Json cell;
    cell["position"] = place(x);
    cell["radius"] = quantity(radius_ * random_.uniform(wide_ ? 0.8 : 0.95, 1), "um");
    cell["model"] = chance(share_) ? "dcm" : "cbm";
    if (pulled && chance(0.3)) {
      const double force = wide_ ? decades(0.1, 10) : decades(0.1, 1);
      const Vec3 pull = force * random_.unit_vector();
      cell["pull"] = {quantity(pull.x(), "nN"), quantity(pull.y(), "nN"), quantity(pull.z(), "nN")};
    }
    list.push_back(cell);
  }
  scene_["cells"] = {{"source", "list"}, {"list", list}};
}

/// Draws a box of walls, one of them moving inwards.
void Drawing::draw_box() {
  std::array<int, 3> grid{};
  int left = count_;
  for (int& n : grid) {
    n = 1 + static_cast<int>(random_.index(static_cast<std::uint64_t>(std::min(left, 4))));
    left /= n;
  }
  count_ = grid[0] * grid[1] * grid[2];
  scene_["cells"] = {{"source", "box"}, {"grid", grid}, {"spacing", spacing_}, {"jitter", jitter_}};
  Vec3 half;
  for (int k = 0; k < 3; ++k)
    half[k] = radius_ * ((grid[k] - 1) * spacing_ + 1 + 2 * jitter_) + kStartGap;
  add_zoom(half.x());
  double travel = 2 * half.x() - rest_volume() * compressed_volume() / (4 * half.y() * half.z());
  double speed = 0;
  if (travel > 0) limit_motion(travel, speed);
  Json walls = Json::array();
  for (int k = 0; k < 3; ++k)
    for (const int side : {-1, 1}) {
      Vec3 point = Vec3::Zero();
      point[k] = side * half[k];
      Json normal = {0, 0, 0};
      normal[k] = -side;
      Json wall = {{"point", place(point)}, {"normal", normal}, {"mirror", true}};
      if (k == 0 && side > 0 && travel > 0) {
        wall["speed"] = quantity(speed, "um/h");
        wall["travel"] = quantity(travel, "um");
      }
      walls.push_back(wall);
    }
  scene_["walls"] = walls;
}

/// Draws cells placed at random about a branching vessel of a network file.
void Drawing::draw_fill() {
  // Darts at 0.15 of their balls' volume find places; more than 0.38 they never do.
  const double distance =
      2 * radius_ * (wide_ ? random_.uniform(0.75, 1.1) : random_.uniform(1, 1.1));
  const double half =
      0.5 * std::cbrt(count_ * kPi / 6 * std::pow(distance, 3) / 0.12) + 0.5 * radius_;
  scene_["cells"] = {{"source", "fill"},
                     {"count", count_},
                     {"low", place(Vec3::Constant(-half))},
                     {"high", place(Vec3::Constant(half))},
                     {"min_distance", quantity(distance, "um")}};
  add_zoom(half);
  const auto line = [&](int id, const Vec3& x, double radius, int parent) {
    result_.network += fmt::format("{} 0 {:.4f} {:.4f} {:.4f} {:.4f} {}\n", id, x.x(), x.y(), x.z(),
                                   radius, parent);
  };
  const double out = half + 2 * radius_;
  const double thick = wide_ ? decades(2, 20) : kSinusoidRadius;
  const double thin = wide_ ? thick * random_.uniform(0.3, 1) : kSinusoidRadius;
  const double bend = random_.uniform(-0.3, 0.3) * half, lift = random_.uniform(-0.3, 0.3) * half;
  line(1, {-out, 0, 0}, thick, -1);
  line(2, {0, bend, lift}, thick, 1);
  line(3, {out, -bend, 0}, thin, 2);
  line(4, {0.3 * half, out, lift}, thin, 2);
  Json vessels;
  vessels["file"] = kNetworkFile;
  vessels["young"] = quantity(near(600), "Pa");
  if (wide_ && chance(0.3)) vessels["adhesion"] = quantity(decades(1e-6, 1e-4), "J/m^2");
  scene_["vessels"] = vessels;
}

void Drawing::draw_lobule() {
  const double size = radius_ * random_.uniform(7.5, 10);
  scene_["experiment"] = "lobule";
  scene_["cells"] = {{"source", "lobule"}};
  if (share_ > 0 && share_ < 1) {
    scene_["cells"]["model"] = "zoom";
    scene_["zoom"] = Json::array(
        {Json::object({{"kind", "axis_distance"},
                       {"max_distance", quantity(size * (0.5 + 0.5 * share_), "um")}})});
  } else {
    scene_["cells"]["model"] = share_ > 0 ? "dcm" : "cbm";
  }
  scene_["lobule"] = {{"radius", quantity(size, "um")},
                      {"height", quantity(random_.uniform(2.2, 3.5) * radius_, "um")},
                      {"lesion_radius", quantity(random_.uniform(0.3, 0.5) * size, "um")},
                      {"min_distance", quantity(random_.uniform(1.6, 1.9) * radius_, "um")},
                      {"cells", count_}};
  scene_["vessels"]["young"] = quantity(near(600), "Pa");
  scene_["start_up"] = {{"enabled", true},
                        {"growth_time", quantity(wide_ ? decades(10, 120) : 60, "min")},
                        {"max_duration", quantity(decades(5, 30), "min")}};
}

void Drawing::add_life() {
  bool confined = false;
  for (const char* wall : {"capsule", "walls", "lobule"}) confined |= scene_.contains(wall);
  scene_.merge_patch(Json::parse(
      draw_life({seed_, wide_, end_, count_, radius_, scene_.contains("vessels"), confined})));
  const Json& type = scene_["cell_types"]["cell"];
  if (!type.contains("cycle") || type["cycle"]["start"] != "random") return;
  // The oldest cells of the start have almost twice the volume: they are to fit where the others
  // did, in the same places.
  const auto shrink = [](Json& radius) {
    radius = quantity(std::stod(radius.get<std::string>()) / std::cbrt(2.0), "um");
  };
  shrink(scene_["cell_types"]["cell"]["radius"]);
  if (scene_["cells"].contains("list"))
    for (Json& cell : scene_["cells"]["list"]) shrink(cell["radius"]);
  for (const char* key : {"spacing", "jitter"})  // in diameters
    if (scene_["cells"].contains(key))
      scene_["cells"][key] = scene_["cells"][key].get<double>() * std::cbrt(2.0);
}

void Drawing::add_moving_zoom() {
  if (nodes_ > 162 && count_ > 6) return;  // too many for such meshes
  scene_.merge_patch(
      Json::parse(draw_zoom({seed_, wide_, end_, count_, radius_, scene_.contains("vessels"),
                             scene_.contains("lobule")})));
}

RandomScene Drawing::draw(const SceneKind& kind) {
  scene_["name"] = fmt::format("stress_{}", seed_);
  scene_["description"] = std::string(name_of(family_of(seed_))) + " stress scene";
  scene_["seed"] = seed_;
  draw_cell_type();
  draw_share();
  draw_motion();
  const double situation = random_.uniform();
  if (situation >= 0.4) count_ = std::min(count_, 32);  // one by one, or with vessels
  draw_time();
  if (situation < 0.4)
    draw_clump();
  else if (situation < 0.6)
    draw_list();
  else if (situation < 0.75)
    draw_box();
  else if (situation < 0.9)
    draw_fill();
  else
    draw_lobule();
  const std::string law = kind.law.empty() ? draw_law(seed_) : kind.law;
  if (law == kTriangleLaw) scene_["contact"] = {{"law", law}, {"quadrature", "3-point"}};
  if (kind.life) add_moving_zoom();
  if (kind.life) add_life();
  scene_.merge_patch(Json::parse(
      draw_substances({seed_, wide_, kind.life, end_, radius_, scene_.contains("vessels")})));
  result_.cells = count_;
  result_.text = scene_.dump(2) + "\n";
  return result_;
}

}  // namespace

RandomScene draw_scene(std::uint64_t seed, const SceneKind& kind) {
  return Drawing(seed).draw(kind);
}

}  // namespace acinus::bench
