#include "core/units/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/error.hpp"
#include "tests/messages.hpp"

namespace acinus {
namespace {

/// Message of the error, "" if there is none.
std::string failure(const std::string& text, Dimension needed) {
  return test::fault_of([&] { parse_quantity(text, needed); });
}

TEST(Units, TableOneInBaseUnitsIsExact) {
  EXPECT_EQ(parse_quantity("12 um", kLength), 12.0);
  EXPECT_EQ(parse_quantity("500 nm", kLength), 0.5);
  EXPECT_EQ(parse_quantity("24 h", kTime), 86400.0);
  EXPECT_EQ(parse_quantity("1000 Pa", kStress), 1.0);
  EXPECT_EQ(parse_quantity("0.8e-3 N/m", kTension), 0.8);
  EXPECT_EQ(parse_quantity("1e-5 J/m^2", kTension), 0.01);
  EXPECT_EQ(parse_quantity("1e-4 N s/m", kFriction), 0.1);
  EXPECT_EQ(parse_quantity("5e10 N s/m^3", kFrictionPerArea), 50.0);
  EXPECT_EQ(parse_quantity("1e8 N s/m^3", kFrictionPerArea), 0.1);
  EXPECT_EQ(parse_quantity("1e-16 m^2/s", kDiffusion), 1e-4);
  EXPECT_EQ(parse_quantity("1e-3 Pa s", kViscosity), 1e-6);
  EXPECT_EQ(parse_quantity("0.3 nN", kForce), 0.3);
  EXPECT_EQ(parse_quantity("4.8e-5 1/um^3", kNumberDensity), 4.8e-5);
  EXPECT_EQ(parse_quantity("0.01 um/min", kSpeed), 0.01 / 60);
  EXPECT_EQ(parse_quantity("1 %/h", kRate), 0.01 / 3600);
}

TEST(Units, EveryUnitHasItsValue) {
  const auto is = [](const char* text, Dimension dimension, double value) {
    EXPECT_EQ(parse_quantity(text, dimension), value) << text;
  };
  is("1 m", kLength, 1e6), is("1 dm", kLength, 1e5), is("1 cm", kLength, 1e4);
  is("1 mm", kLength, 1e3), is("1 um", kLength, 1), is("1 nm", kLength, 1e-3);
  is("1 s", kTime, 1), is("1 ms", kTime, 1e-3), is("1 us", kTime, 1e-6);
  is("1 min", kTime, 60), is("1 h", kTime, 3600), is("1 d", kTime, 86400);
  is("1 day", kTime, 86400), is("2 days", kTime, 172800);
  is("1 N", kForce, 1e9), is("1 mN", kForce, 1e6), is("1 uN", kForce, 1e3);
  is("1 nN", kForce, 1), is("1 pN", kForce, 1e-3);
  is("1 Pa", kStress, 1e-3), is("1 kPa", kStress, 1), is("1 MPa", kStress, 1e3);
  is("1 GPa", kStress, 1e6);
  is("1 J", kEnergy, 1e15), is("1 mJ", kEnergy, 1e12), is("1 uJ", kEnergy, 1e9);
  is("1 nJ", kEnergy, 1e6), is("1 pJ", kEnergy, 1e3), is("1 fJ", kEnergy, 1);
  is("1 kJ", kEnergy, 1e18), is("1 W", kPower, 1e15), is("900 mW", kPower, 9e14);
  is("1 uW", kPower, 1e9), is("310 K", kTemperature, 310), is("55 kJ/mol", kMolarEnergy, 55e18);
  is("1 aJ", kEnergy, 1e-3), is("50 %", kDimensionless, 0.5), is("0.5", kDimensionless, 0.5);
}

TEST(Units, SpellingsOfTheSameQuantityAgree) {
  for (const char* text :
       {"5e10 N s/m^3", "5e10 N*s/m^3", "5e10 N s / m^3", "5E10 N·s/m^3", "5e10 (N s)/(m^3)",
        "5e10 N/m^2/(m/s)", "5e10 N/(m^2 m/s)", "5e10 N s m^-3", " 5e10N s/m^3 ", "+50e9 N s/m/m/m",
        "50 GPa s/m", "50 nN s/um^3", "50 kPa s/um", "5e10 N s/(m)^3"}) {
    EXPECT_DOUBLE_EQ(parse_quantity(text, kFrictionPerArea), 50.0) << text;
  }
  EXPECT_EQ(parse_quantity("12 \xC2\xB5m", kLength), 12.0);  // micro sign
  EXPECT_EQ(parse_quantity("12 \xCE\xBCm", kLength), 12.0);  // Greek mu
  EXPECT_EQ(parse_quantity("2/h", kRate), parse_quantity("2 1/h", kRate));
  EXPECT_EQ(parse_quantity("-.5 um", kLength), -0.5);
}

TEST(Units, WrongDimensionNamesBothSides) {
  EXPECT_EQ(failure("1 kPa", kLength),
            "\"1 kPa\": has dimension force/length^2 (a stress), needed a length, e.g. \"12 um\"");
  EXPECT_EQ(failure("1 um^2", kTime),
            "\"1 um^2\": has dimension length^2, needed a time, e.g. \"24 h\"");
  EXPECT_EQ(failure("12 m/s", kDimensionless).find("\"12 m/s\": has dimension length/time"), 0u);
}

TEST(Units, BareNumberIsRefused) {
  EXPECT_EQ(failure("12", kLength), "\"12\": has no unit; needed a length, e.g. \"12 um\"");
}

TEST(Units, UnknownUnitComesWithAHint) {
  EXPECT_EQ(failure("1 kPA", kStress), "\"1 kPA\": unknown unit \"kPA\". Did you mean \"kPa\"?");
  EXPECT_EQ(failure("2 hours", kTime), "\"2 hours\": unknown unit \"hours\". Did you mean \"h\"?");
  EXPECT_EQ(failure("5 dayz", kTime), "\"5 dayz\": unknown unit \"dayz\". Did you mean \"day\"?");
  EXPECT_EQ(failure("1 parsec", kLength), "\"1 parsec\": unknown unit \"parsec\"");
}

TEST(Units, MalformedTextIsRefused) {
  for (const char* text : {"",           " ",
                           "um",         "nan um",
                           "inf um",     "-inf um",
                           "1e um",      "12 um 5",
                           "12 um)",     "12 (um",
                           "12 um^",     "12 um^0",
                           "12 um^99",   "12 um^1.5",
                           "12 *um",     "12 um*",
                           "12 um/",     "12 /",
                           "1 um, 2 um", "1,5 um",
                           "0x10 um",    "--1 um",
                           "1 2 um",     "1e999 um",
                           "1e-999 um",  "1e99999999999999999999 um",
                           "12 um \x01", "1 ((((((((((((um))))))))))))"}) {
    EXPECT_NE(failure(text, kLength), "") << text;
  }
  EXPECT_NE(failure(std::string(100000, '9').append(" um"), kLength), "");
  EXPECT_NE(failure("1 " + std::string(100, 'm'), kLength), "");
}

TEST(Units, FormatUsesFewDigits) {
  EXPECT_EQ(format_quantity(86400, kTime, "h"), "24 h");
  EXPECT_EQ(format_quantity(60, kTime, "s"), "60 s");
  EXPECT_EQ(format_quantity(0.01, kTension, "J/m^2"), "1e-5 J/m^2");
  EXPECT_EQ(format_quantity(50, kFrictionPerArea, "N s/m^3"), "5e10 N s/m^3");
  EXPECT_EQ(format_quantity(2.5, kStress, "Pa"), "2500 Pa");
  EXPECT_EQ(format_quantity(0.01 / 60, kSpeed, "um/min"), "0.01 um/min");
  EXPECT_EQ(format_quantity(-11.75, kLength, "um"), "-11.75 um");
  EXPECT_EQ(format_quantity(0, kLength, "um"), "0 um");
  EXPECT_EQ(format_quantity(0.3, kDimensionless, ""), "0.3");
  EXPECT_EQ(format_quantity(1e-7, kDimensionless, ""), "1e-7");
  EXPECT_THROW(format_quantity(1, kLength, "s"), Error);
  EXPECT_THROW(format_quantity(std::nan(""), kLength, "um"), Error);
  EXPECT_THROW(format_quantity(std::numeric_limits<double>::infinity(), kLength, "um"), Error);
}

TEST(Units, FormattedQuantitiesReadBackToTheSameDouble) {
  const std::pair<Dimension, const char*> units[] = {
      {kLength, "um"},      {kLength, "m"},        {kTime, "h"},
      {kTime, "days"},      {kSpeed, "um/min"},    {kRate, "1/h"},
      {kTension, "J/m^2"},  {kDiffusion, "m^2/s"}, {kFrictionPerArea, "N s/m^3"},
      {kViscosity, "Pa s"}, {kStress, "Pa"},       {kNumberDensity, "1/um^3"},
      {kDimensionless, ""}, {kFriction, "N s/m"},  {kStiffnessPerArea, "kPa/um"}};
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> mantissa(-10, 10);
  std::uniform_int_distribution<int> exponent(-12, 12);
  int n_base = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto& [dimension, unit] = units[static_cast<std::size_t>(i) % std::size(units)];
    const double value = mantissa(random) * std::pow(10.0, exponent(random));
    const std::string text = format_quantity(value, dimension, unit);
    ASSERT_EQ(parse_quantity(text, dimension), value) << text;
    if (!text.ends_with(unit)) ++n_base;
  }
  std::printf("20000 quantities read back bit by bit, %d of them only in base units\n", n_base);
  for (const double value : {std::numeric_limits<double>::max(), std::numeric_limits<double>::min(),
                             5e-324, 0.1, 1.0 / 3}) {
    EXPECT_EQ(parse_quantity(format_quantity(value, kLength, "um"), kLength), value);
    EXPECT_EQ(parse_quantity(format_quantity(value, kTime, "days"), kTime), value);
    EXPECT_EQ(parse_quantity(format_quantity(value, kLength, "nm"), kLength), value);
  }
}

TEST(Units, EveryDimensionHasAnExampleOfItsOwn) {
  for (const Dimension dimension :
       {kDimensionless, kLength, kTime, kForce, kSpeed, kRate, kDiffusion, kNumberDensity, kStress,
        kTension, kEnergy, kStiffnessPerArea, kFriction, kFrictionPerArea, kViscosity,
        Dimension{3, -2, 1}, Dimension{-2, -1, 0}}) {
    EXPECT_NO_THROW(parse_quantity(dimension_example(dimension), dimension));
    if (dimension != kDimensionless) {
      EXPECT_EQ(parse_quantity("1 " + base_unit(dimension), dimension), 1.0);
    }
  }
  EXPECT_EQ(dimension_formula(kFrictionPerArea), "force time/length^3");
  EXPECT_EQ(dimension_formula(kNumberDensity), "1/length^3");
}

}  // namespace
}  // namespace acinus
