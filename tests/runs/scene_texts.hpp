#pragma once
/// Scene texts and helpers shared by the tests of the scene reader.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "runs/experiments/read_scene.hpp"
#include "tests/messages.hpp"

namespace acinus::runs::scene_texts {
namespace fs = std::filesystem;

inline constexpr const char* kMinimal = R"({
  "time": {"end": "2 h"},
  "cell_types": {"hepatocyte": {}},
  "cells": {"model": "dcm", "list": [{"position": ["0 um", "0 um", "0 um"]}]}
})";

/// Everything the reader can meet; every block present.
inline constexpr const char* kFull = R"({
  // a comment
  "name": "full", "description": "every block", "seed": 18446744073709551615,
  "experiment": "lobule", "model": "zoom",
  "time": {"end": "2 days", "step": "30 s", "min_step": "1 ms", "adaptive": false,
           "tolerance": "5 nm", "max_move": 0.25, "until_cells": 300},
  "solver": {"tolerance": 1e-4, "max_iterations": 500},
  "start_up": {"enabled": true, "initial_radius": "3 um", "growth_time": "1 h"},
  "cell_types": {
    "old": {"radius": "11.3 um", "adhesion": "2.5e-5 J/m^2",
            "adhesion_with": [{"type": "young", "adhesion": "4e-6 J/m^2"}],
            "dcm": {"nodes": 642, "cortex_young": "0.9 kPa", "nodal_friction_across": 0,
                    "cortex_tension": "1e-4 N/m", "nucleus": {"size": 0.4},
                    "contraction": {"ring": 0.5, "course": [{"time": "1 s", "factor": 2}]}},
            "cycle": {"time": "23.7 h", "spread": 0.07, "mitosis": "50 min", "force_ramp": 0.2,
                      "axis": "given", "direction": [0, 1, 1], "start": "random"},
            "inhibition": {"by": "pressure", "pressure_threshold": "210 Pa", "power": 3},
            "death": {"mode": "lysis", "duration": "7 h", "final_volume": 0.3, "softening": 0.5},
            "cbm": {"young": "450 Pa", "poisson": 0.47},
            "exchange": [{"substance": "oxygen", "secretion": "0.1 1/s", "saturation": 3,
                          "uptake": "0.2 1/s", "uptake_max": "2 1/s", "half_max": 0.7,
                          "secretion_per_area": "1 um/s", "uptake_per_area": "2 um/s"}]},
    "young": {"diffusion": "3e-16 m^2/s",
              "inhibition": {"by": "volume", "volume_threshold": 0.8}}},
  "cells": {"source": "list", "model": "zoom", "list": [
      {"position": ["1 um", "2.7 um", "-3 um"], "type": "old", "radius": "9 um"},
      {"position": ["40 um", "0 um", "0 um"], "type": "young", "model": "cbm",
       "pull": ["0 nN", "0 nN", "0.1 nN"]}], "grid": [2, 3, 4]},
  "life": {"grid": "7 min", "rules": [
      {"do": "rest", "region": {"kind": "sphere", "radius": "50 um"}, "until": "1.7 days"},
      {"do": "die", "cells": [0, 9007199254740993], "descendants": false, "from": "5 h",
       "share": 0.25}]},
  "substances": [{"name": "oxygen", "unit": "mmHg", "diffusion": "2e-9 m^2/s", "decay": "0.1 1/h",
      "initial": 38, "boundary": {"kind": "fixed", "value": 38},
      "faces": [{"side": "z_low", "kind": "exchange", "value": 5, "coefficient": "1 um/s"}],
      "sources": [{"region": {"kind": "sphere", "radius": "20 um"}, "secretion": "0.5 1/s"}],
      "course": [{"time": "1 h", "factor": 0.5}],
      "vessels": {"concentration": 60, "permeability": "3 um/s"}}],
  "substance_grid": {"spacing": "9 um", "box": [["0 um", "0 um", "0 um"], ["1 um", "2 um", "3 um"]],
                     "margin": "50 um", "grow": false, "step": "90 s", "tolerance": 1e-5},
  "rules": [{"signal": "oxygen", "behaviour": "death", "direction": "decreases", "half_max": 2.5,
             "power": 6, "rate": "0.3 1/h", "cell_type": "old"},
            {"signal": "oxygen", "behaviour": "chemotaxis", "half_max": 1, "force": "-0.1 nN",
             "sensitivity": 0.02},
            {"signal": "oxygen", "behaviour": "uptake", "of": "oxygen", "half_max": 1},
            {"signal": "neighbours", "behaviour": "adhesion", "half_max": 6,
             "neighbour_type": "young"},
            {"signal": "pressure", "behaviour": "growth", "direction": "decreases",
             "half_max": "0.2 kPa"},
            {"signal": "age", "behaviour": "motility", "half_max": "30 min"},
            {"signal": "volume", "behaviour": "death", "half_max": "9e-15 m^3", "rate": "1 1/h"}],
  "moving_zoom": {"every": "2 h", "margin": "40 um", "stay": "1 h", "fade": "30 min", "at_once": 5,
                  "most_deformable": 100},
  "zoom": [{"kind": "sphere", "center": ["0 um", "0 um", "0 um"], "radius": "30 um"},
           {"kind": "box", "low": ["0 um", "0 um", "0 um"], "high": ["1 um", "2 um", "3 um"]},
           {"kind": "half_space", "point": ["0 um", "0 um", "0 um"], "normal": [1, 0, 0.5]},
           {"kind": "axis_distance", "max_distance": "60 um"}, {"kind": "all"},
           {"kind": "cells", "cells": [0], "offspring": false, "max_distance": "30 um"},
           {"kind": "pressure", "above": "20 Pa", "below": "-5 Pa"},
           {"kind": "front", "max_distance": "60 um"}, {"kind": "vessel", "max_distance": "9 um"}],
  "axis_point": ["1 um", "0 um", "0 um"],
  "contact": {"quadrature": "nodes", "range": 0.4, "skin": "0.2 um"},
  "friction": {"dcm_cbm": "auto", "dcm_vessel": "1e9 N s/m^3", "medium": "liquid"},
  "motility": {"random": true, "leader_force": "0.3 nN"},
  "lobule": {"shape": "pie", "height": "72 um"},
  "vessels": {"unit": "1 mm", "scale": 2, "center": true,
              "crop": [["0 um", "0 um", "0 um"], ["1 um", "2 um", "3 um"]]},
  "walls": [{"point": ["0 um", "0 um", "0 um"], "normal": [0, 0, 1], "mirror": true},
            {"name": "top wall", "point": ["0 um", "0 um", "72 um"], "normal": [0, 0, -1],
             "speed": "7 um/h", "travel": "10 um", "mirror": true},
            {"name": "floor", "mirror": false, "adhesion": "1e-5 J/m^2", "young": "600 Pa",
             "poisson": 0.4}],
  "capsule": {"radius": "100 um", "speed": "10 um/h", "min_radius": "60 um"},
  "pipette": {"radius": "5 um", "suction": [{"time": "1 s", "pressure": "20 Pa"}]},
  "stretcher": {"power": "900 mW", "pulses": [{"from": "1 s", "to": "3 s"}]},
  "temperature": {"course": [{"time": "1 s", "value": "300 K"}]},
  "output": {"every": "7 min", "compression": "none", "start_up": true}
  /* the end */
})";

inline std::string failure(const std::string& text, const std::vector<std::string>& set = {}) {
  return test::fault_of([&] { parse_scene(text, "scene.json", ".", set); });
}

inline std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

inline std::string minimal(const std::string& from, const std::string& to) {
  return changed(kMinimal, from, to);
}

inline std::string with_block(const std::string& block) {
  return minimal("{\n  \"time\"", "{ " + block + ",\n  \"time\"");
}

class TemporaryFolder {
 public:
  TemporaryFolder() : path_(io::make_temporary_folder("acinus_scene_")) {}
  ~TemporaryFolder() { fs::remove_all(path_); }
  std::string write(const std::string& name, const std::string& text) const {
    const fs::path file = path_ / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
    return file.string();
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

inline std::string file_failure(const std::string& file, const std::vector<std::string>& set = {}) {
  return test::fault_of([&] { read_scene(file, set); });
}

}  // namespace acinus::runs::scene_texts
