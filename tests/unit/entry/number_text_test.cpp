// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: decimal text becomes the number it says whatever the locale, and nothing but a number is taken for one.

#include "part/number_text.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

namespace pose_wall {
namespace {

double read(const std::string& text) {
  double value = -12345.0;
  return whole_number_text(text.c_str(), &value) ? value : std::nan("");
}

TEST(NumberText, ReadsWhatPeopleWrite) {
  for (const char* text : {"0", "1", "-1", "+2.0", "0.30", "30.0", ".5", "5.", "1e3", "1E3", "1.5e-3", "-2e+2", "007",
                           "2000000000", "0.000001", "123456.789", " 3.25\t"}) {
    EXPECT_EQ(read(text), std::strtod(text, nullptr)) << text;
  }
}

TEST(NumberText, RefusesWhatIsNoNumber) {
  for (const char* text : {"",     " ",   "+",   "-",   ".",   "-.",  "e5", "1e",  "1e+",   "1.2.3", "1,5",
                           "0x10", "nan", "inf", "1 2", "--1", "+-1", "1m", "one", "1e5.0", "\n1"}) {
    EXPECT_TRUE(std::isnan(read(text))) << "'" << text << "' was read as " << read(text);
  }
}

TEST(NumberText, FailureLeavesCursorAndValue) {
  const char* text = "abc";
  const char* cursor = text;
  double value = 7.0;
  EXPECT_FALSE(read_number(&cursor, &value));
  EXPECT_EQ(cursor, text);
  EXPECT_EQ(value, 7.0);
  EXPECT_FALSE(whole_number_text("1 x", &value));
  EXPECT_EQ(value, 7.0);
}

TEST(NumberText, StopsBehindTheNumber) {
  const char* cursor = "-2.5e1,3";
  double value = 0.0;
  ASSERT_TRUE(read_number(&cursor, &value));
  EXPECT_EQ(value, -25.0);
  EXPECT_STREQ(cursor, ",3");
}

TEST(NumberText, AgreesWithTheCLibraryOnRandomNumbers) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> mantissa(-10.0, 10.0);
  std::uniform_int_distribution<int> exponent(-30, 30);
  for (int i = 0; i < 20000; ++i) {
    char text[64];
    std::snprintf(text, sizeof text, "%.15ge%d", mantissa(random), exponent(random));
    const double expected = std::strtod(text, nullptr);
    ASSERT_NEAR(read(text) / expected, 1.0, 2e-15) << text;
  }
}

TEST(NumberText, FifteenDigitsWithoutLargeExponentAreExact) {
  std::mt19937_64 random(6);
  std::uniform_int_distribution<long long> digits(-999999999999999LL, 999999999999999LL);
  for (int i = 0; i < 20000; ++i) {
    const std::string text = std::to_string(digits(random)) + "e-" + std::to_string(i % 22);
    ASSERT_EQ(read(text), std::strtod(text.c_str(), nullptr)) << text;
  }
}

TEST(NumberText, EndlessDigitsAndExponentsEndSomewhereHarmless) {
  const std::string zeros(100000, '0'), nines(100000, '9');
  EXPECT_EQ(read(zeros + "1"), 1.0);
  EXPECT_EQ(read("0." + zeros + "1"), 0.0);
  EXPECT_FALSE(std::isfinite(read(nines)));
  EXPECT_FALSE(std::isfinite(read("1e" + nines)));
  EXPECT_EQ(read("1e-" + nines), 0.0);
  EXPECT_NEAR(read("0." + nines), 1.0, 1e-15);
}

TEST(NumberText, DoesNotCareForTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) == nullptr) continue;
    EXPECT_EQ(read("0.5"), 0.5) << name;
    EXPECT_TRUE(std::isnan(read("0,5"))) << name;
  }
  std::setlocale(LC_ALL, before.c_str());
}

}  // namespace
}  // namespace pose_wall
