// SPDX-License-Identifier: Apache-2.0
#include "sublimit/base/detail/format_number.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

namespace sublimit::testing {
namespace {

// All bit patterns alike: every exponent, subnormals among them.
template <class T, class Bits>
void expect_round_trips(Bits seed) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < 200000; ++i) {
    const T value = std::bit_cast<T>(static_cast<Bits>(random()));
    if (std::isnan(value)) continue;
    const std::string text = format_number(value);
    const Parsed<T> parsed = parse_number<T>(text);
    ASSERT_TRUE(parsed) << text;
    ASSERT_EQ(std::bit_cast<Bits>(parsed.value), std::bit_cast<Bits>(value)) << text;
  }
}

TEST(FormatNumber, EveryDoubleReadsBackToTheSameBits) { expect_round_trips<double, std::uint64_t>(1); }
TEST(FormatNumber, EveryFloatReadsBackToTheSameBits) { expect_round_trips<float, std::uint32_t>(2); }

TEST(FormatNumber, SubnormalsReadBackToTheSameBits) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random() >> 12);  // exponent zero
    ASSERT_EQ(parse_number<double>(format_number(value)).value, value);
  }
  EXPECT_EQ(format_number(5e-324), "5e-324");
}

TEST(FormatNumber, FormsAreTheShortest) {
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_EQ(format_number(0.1f), "0.1");
  EXPECT_EQ(format_number(1.0), "1");
  EXPECT_EQ(format_number(-0.0), "-0");
  EXPECT_EQ(format_number(1.0 / 3), "0.3333333333333333");
  EXPECT_EQ(format_number(1e300), "1e+300");
  EXPECT_EQ(format_number(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
}

TEST(FormatNumber, AppendsBehindWhatIsThere) {
  std::string text = "v ";
  append_number(text, 0.25);
  append_number(text, -3);
  EXPECT_EQ(text, "v 0.25-3");
}

TEST(ParseNumber, TakesEveryUsualSpelling) {
  for (const char* const text : {"2", "+2", "2.", "2.0", "0.2e1", "20E-1", "+.2e+1", "002", "2e0"}) {
    EXPECT_EQ(parse_number<double>(text).value, 2.0) << text;
    EXPECT_TRUE(parse_number<double>(text)) << text;
  }
  EXPECT_EQ(parse_number<std::int64_t>("+17").value, 17);
  EXPECT_EQ(parse_number<std::int64_t>("-17").value, -17);
  EXPECT_TRUE(std::isinf(parse_number<float>("inf").value));
  EXPECT_TRUE(std::isnan(parse_number<double>("nan").value));
}

TEST(ParseNumber, TakesTheWholeTextOrNothing) {
  for (const char* const text :
       {"", "+", "-", ".", "e5", "abc", "1x", "1 ", " 1", "1,5", "0x10", "1e", "1e+", "--1", "+-1", "++1", "1.2.3"}) {
    EXPECT_EQ(parse_number<double>(text).status, ParseStatus::malformed) << text;
    EXPECT_EQ(parse_number<float>(text).status, ParseStatus::malformed) << text;
    EXPECT_EQ(parse_number<std::int64_t>(text).status, ParseStatus::malformed) << text;
  }
  EXPECT_EQ(parse_number<std::int64_t>("1.0").status, ParseStatus::malformed);
}

TEST(ParseNumber, SaysWhatIsTooLarge) {
  for (const char* const text : {"1e309", "-1e309", "+2e308", "1e99999999999999999999", "0.001e312"}) {
    EXPECT_EQ(parse_number<double>(text).status, ParseStatus::too_large) << text;
  }
  EXPECT_EQ(parse_number<double>("1" + std::string(400, '0')).status, ParseStatus::too_large);
  EXPECT_EQ(parse_number<float>("1e39").status, ParseStatus::too_large);
  EXPECT_EQ(parse_number<std::int64_t>("9223372036854775808").status, ParseStatus::too_large);
  EXPECT_EQ(parse_number<std::int64_t>("-9223372036854775809").status, ParseStatus::too_large);
}

TEST(ParseNumber, RoundsWhatIsTooSmallToZero) {
  for (const char* const text : {"1e-400", "0.1e-400", "1e-99999999999999999999", "12345e-500"}) {
    const Parsed<double> parsed = parse_number<double>(text);
    EXPECT_TRUE(parsed) << text;
    EXPECT_EQ(parsed.value, 0.0) << text;
    EXPECT_TRUE(std::signbit(parse_number<double>("-" + std::string(text)).value)) << text;
  }
  EXPECT_TRUE(parse_number<double>("0." + std::string(400, '0') + "1"));
  EXPECT_EQ(parse_number<float>("1e-60").value, 0.0f);
  EXPECT_EQ(parse_number<double>("1" + std::string(400, '0') + "e-400").value, 1.0);
}

}  // namespace
}  // namespace sublimit::testing
