#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/scene/units.hpp"

namespace polynya::scene {
namespace {

struct Sample {
  const char* text;
  double value;
  Dimension dimension;
};

TEST(Units, AreReadIntoSI) {
  for (const Sample& sample : {
           Sample{"10 mm", 0.01, dimension::length},
           Sample{"10mm", 0.01, dimension::length},
           Sample{"  3 um ", 3e-6, dimension::length},
           Sample{"40 m/s", 40, dimension::speed},
           Sample{"144 km/h", 40, dimension::speed},
           Sample{"9.81 m/s^2", 9.81, dimension::acceleration},
           Sample{"9.81 m s^-2", 9.81, dimension::acceleration},
           Sample{"5 g", 5e-3, dimension::mass},
           Sample{"5 kg", 5, dimension::mass},
           Sample{"2 t", 2000, dimension::mass},
           Sample{"1.5 ms", 1.5e-3, dimension::time},
           Sample{"3 us", 3e-6, dimension::time},
           Sample{"3 µs", 3e-6, dimension::time},
           Sample{"20 kHz", 2e4, dimension::frequency},
           Sample{"1 1/s", 1, dimension::frequency},
           Sample{"1 /s", 1, dimension::frequency},
           Sample{"900 kg/m^3", 900, dimension::density},
           Sample{"0.9 g/cm^3", 900, dimension::density},
           Sample{"5.2 GPa", 5.2e9, dimension::pressure},
           Sample{"1 N/mm^2", 1e6, dimension::pressure},
           Sample{"1 atm", 101325, dimension::pressure},
           Sample{"180 deg", std::numbers::pi, dimension::none},
           Sample{"35 %", 0.35, dimension::none},
           Sample{"-1e3", -1000, dimension::none},
           Sample{"+4", 4, dimension::none},
       }) {
    const Quantity quantity = parse_quantity(sample.text);
    EXPECT_NEAR(quantity.value, sample.value, 1e-14 * std::abs(sample.value)) << sample.text;
    EXPECT_EQ(quantity.dimension, sample.dimension) << sample.text;
  }
}

TEST(Units, OnlyANumberAloneIsBare) {
  EXPECT_TRUE(parse_quantity("0.35").bare);
  EXPECT_FALSE(parse_quantity("0.35 1").bare);
  EXPECT_FALSE(parse_quantity("3 m").bare);
}

TEST(Units, WrongTextsAreRefused) {
  for (const char* text :
       {"", "mm", "10 parsec", "10 m/", "10 m^x", "10 m^1.5", "ten mm", "1 2", "inf", "nan m", "10 m//s", "3 Mmm"})
    EXPECT_THROW(parse_quantity(text), std::invalid_argument) << text;
}

TEST(Units, NamesAreWrittenAsPeopleWriteThem) {
  EXPECT_EQ(unit_name(dimension::speed), "m/s");
  EXPECT_EQ(unit_name(dimension::acceleration), "m/s^2");
  EXPECT_EQ(unit_name(dimension::density), "kg/m^3");
  EXPECT_EQ(unit_name(dimension::pressure), "Pa");
  EXPECT_EQ(unit_name(dimension::frequency), "1/s");
  EXPECT_EQ(unit_name(dimension::none), "");
}

}  // namespace
}  // namespace polynya::scene
