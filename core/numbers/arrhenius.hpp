#pragma once
/// Temperature dependence of friction after Arrhenius.

#include <cmath>

namespace acinus {

inline constexpr double kGasConstant = 8.314e15;  ///< fJ/(mol K)

/// Friction over that at the reference temperature: gamma(T) / gamma(T0) = exp(E_a/R (1/T - 1/T0)).
/// [VanLiedekerke2020, Eq. (23); E_a is in kJ/mol, printed there per K]
/// @param activation       fJ/mol, 1e18 are a kJ/mol
/// @param temperature, reference  K, above 0
inline double arrhenius_factor(double activation, double temperature, double reference) {
  return std::exp(activation / kGasConstant * (1 / temperature - 1 / reference));
}

}  // namespace acinus
