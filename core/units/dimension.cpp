#include "core/units/dimension.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdlib>

namespace acinus {
namespace {

struct NamedDimension {
  Dimension dimension;
  const char* name;
  const char* example;
};

constexpr std::array kNames{NamedDimension{kLength, "a length", "12 um"},
                            NamedDimension{kTime, "a time", "24 h"},
                            NamedDimension{kForce, "a force", "0.3 nN"},
                            NamedDimension{kSpeed, "a speed", "0.01 um/min"},
                            NamedDimension{kRate, "a rate", "0.01 1/h"},
                            NamedDimension{kDiffusion, "a diffusion coefficient", "1e-16 m^2/s"},
                            NamedDimension{kNumberDensity, "a number density", "4.8e-5 1/um^3"},
                            NamedDimension{kStress, "a stress", "1 kPa"},
                            NamedDimension{kTension, "a tension or energy per area", "1e-5 J/m^2"},
                            NamedDimension{kEnergy, "an energy", "1 fJ"},
                            NamedDimension{kStiffnessPerArea, "a stress per length", "5 kPa/um"},
                            NamedDimension{kFriction, "a friction coefficient", "1e-4 N s/m"},
                            NamedDimension{kFrictionPerArea, "a friction per area", "5e10 N s/m^3"},
                            NamedDimension{kViscosity, "a viscosity", "1e-3 Pa s"},
                            NamedDimension{kPower, "a power", "1.1 W"},
                            NamedDimension{kTemperature, "a temperature", "310 K"},
                            NamedDimension{kMolarEnergy, "an energy per amount", "55 kJ/mol"}};

}  // namespace

std::string base_unit(Dimension dimension) {
  std::string above, below;
  const auto append = [&](const char* symbol, int power) {
    if (power == 0) return;
    std::string& side = power > 0 ? above : below;
    side += power > 0 ? (side.empty() ? "" : " ") : "/";
    side += symbol;
    if (std::abs(power) > 1) side += fmt::format("^{}", std::abs(power));
  };
  append("nN", dimension.force);
  append("s", dimension.time);
  append("um", dimension.length);
  append("K", dimension.temperature);
  append("mol", dimension.amount);
  return above.empty() && !below.empty() ? "1" + below : above + below;
}

std::string dimension_formula(Dimension dimension) {
  std::string above, below;
  const auto append = [&](const char* name, int power) {
    if (power == 0) return;
    std::string& side = power > 0 ? above : below;
    if (power > 0 && !side.empty()) side += " ";
    if (power < 0) side += "/";
    side += name;
    if (std::abs(power) > 1) side += fmt::format("^{}", std::abs(power));
  };
  append("force", dimension.force);
  append("time", dimension.time);
  append("length", dimension.length);
  append("temperature", dimension.temperature);
  append("amount", dimension.amount);
  if (above.empty() && below.empty()) return "a plain number";
  return above.empty() ? "1" + below : above + below;
}

std::string dimension_name(Dimension dimension) {
  for (const NamedDimension& named : kNames) {
    if (named.dimension == dimension) return named.name;
  }
  return "";
}

std::string dimension_example(Dimension dimension) {
  for (const NamedDimension& named : kNames) {
    if (named.dimension == dimension) return named.example;
  }
  const std::string unit = base_unit(dimension);
  return unit.empty() ? "1" : "1 " + unit;
}

}  // namespace acinus
