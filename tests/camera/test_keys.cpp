#include "camera/keys.h"

#include <gtest/gtest.h>

#include <climits>
#include <limits>

#include "usage.h"

namespace pullfocus {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr FocusInterp every_interpolation[] = {FocusInterp::dioptre, FocusInterp::distance, FocusInterp::smooth};

KeyedValue focus(std::string_view text) { return KeyedValue::parse(text, "--focus", Infinity::legal); }

TEST(Keys, ConstantHoldsOnEveryFrame) {
  const KeyedValue value = focus("1.5");
  for (int frame : {INT_MIN, -1, 0, 7, INT_MAX})
    for (FocusInterp interpolation : every_interpolation) EXPECT_EQ(value.focus_at(frame, interpolation), 1.5);
}

TEST(Keys, EveryKeyReturnsItsValueBitForBitAndIsHeldOutside) {
  const KeyedValue value = focus("-3:0.1,1:0.3,7:0.7,24:1e-3");
  for (FocusInterp interpolation : every_interpolation) {
    for (const Key& key : value.keys()) EXPECT_EQ(value.focus_at(key.frame, interpolation), key.value);
    EXPECT_EQ(value.focus_at(-100, interpolation), 0.1);
    EXPECT_EQ(value.focus_at(INT_MAX, interpolation), 1e-3);
  }
}

TEST(Keys, DioptreIsLinearInInverseDistance) {
  const KeyedValue value = focus("0:0.5,10:2");
  for (int frame = 0; frame <= 10; ++frame)
    EXPECT_NEAR(1 / value.focus_at(frame, FocusInterp::dioptre), 2 - 0.15 * frame, 1e-12);
}

TEST(Keys, DistanceIsLinearInDistance) {
  const KeyedValue value = focus("0:0.5,10:2");
  for (int frame = 0; frame <= 10; ++frame) {
    EXPECT_NEAR(value.focus_at(frame, FocusInterp::distance), 0.5 + 0.15 * frame, 1e-12);
    EXPECT_EQ(value.linear_at(frame), value.focus_at(frame, FocusInterp::distance));
  }
}

TEST(Keys, SmoothStartsAndEndsAtRestInDioptres) {
  const KeyedValue value = focus("0:1,100:inf");
  const auto dioptres = [&](int frame) { return 1 / value.focus_at(frame, FocusInterp::smooth); };
  EXPECT_NEAR(dioptres(50), 0.5, 1e-12);
  EXPECT_NEAR(dioptres(25), 1 - 0.15625, 1e-12);  // 3/16 - 2/64
  EXPECT_LT(dioptres(0) - dioptres(1), 0.0004);
  EXPECT_LT(dioptres(99) - dioptres(100), 0.0004);
}

TEST(Keys, PullsToInfinityAreFiniteOnTheWay) {
  const KeyedValue value = focus("1:0.4,24:inf");
  for (FocusInterp interpolation : {FocusInterp::dioptre, FocusInterp::smooth}) {
    double before = 0;
    for (int frame = 1; frame < 24; ++frame) {
      const double now = value.focus_at(frame, interpolation);
      EXPECT_TRUE(now > before && now < inf) << frame;
      before = now;
    }
    EXPECT_EQ(value.focus_at(24, interpolation), inf);
  }
}

TEST(Keys, HoldsBetweenEqualKeysAreExact) {
  for (const char* text : {"1:0.3,9:0.3", "1:inf,9:inf"})
    for (FocusInterp interpolation : {FocusInterp::dioptre, FocusInterp::smooth})
      for (int frame = 1; frame < 10; ++frame)
        EXPECT_EQ(focus(text).focus_at(frame, interpolation), focus(text).focus_at(1, interpolation));
}

TEST(Keys, ResultsStayBetweenNeighbouringKeysOverTheWholeRangeOfFrames) {
  const KeyedValue value({{INT_MIN, 0.3}, {INT_MAX, 0.1 + 0.2}}, "--focus", Infinity::legal);
  for (FocusInterp interpolation : every_interpolation)
    for (int frame : {INT_MIN + 1, -1, 0, 1, INT_MAX - 1}) {
      EXPECT_GE(value.focus_at(frame, interpolation), 0.3);
      EXPECT_LE(value.focus_at(frame, interpolation), 0.1 + 0.2);
    }
}

TEST(Keys, InfiniteKeyWithDistanceInterpolationIsRefusedOnEveryFrame) {
  for (int frame : {-1, 1, 5, 24, 30})
    expect_usage_error([&] { focus("1:0.4,24:inf").focus_at(frame, FocusInterp::distance); }, "--focus-interp");
  EXPECT_EQ(focus("inf").focus_at(3, FocusInterp::distance), inf);
  EXPECT_EQ(focus("1:inf").focus_at(3, FocusInterp::distance), inf);
}

TEST(Keys, UnsortedKeysAreSorted) { EXPECT_EQ(focus("24:2,-5:1,3:7"), focus(" -5 : 1, 3:7 ,24:2 ")); }

TEST(Keys, TextRoundTripsExactly) {
  for (const char* text :
       {"1.5", "inf", "3:1.5", "-2:0.1,1:0.30000000000000004,24:inf", "1:1e-300,2:1.7976931348623157e308"}) {
    const KeyedValue value = focus(text);
    EXPECT_EQ(focus(value.to_string()), value) << text;
    EXPECT_EQ(focus(value.to_string()).is_constant(), value.is_constant());
  }
  EXPECT_EQ(focus("24:inf,1:0.4").to_string(), "1:0.4,24:inf");
}

TEST(Keys, MalformedTextIsRefusedByTheNameOfItsOption) {
  for (const char* text : {"",      " ",      "abc", "1.5mm", "0x10",    "nan",           "-1",   "0",        "-inf",
                           "1e999", "1e-320", ":",   "1:",    ":2",      "1:2,",          ",1:2", "1:2,,3:4", "1:2,3",
                           "1.5:2", "1:2:3",  "1:0", "1:nan", "1:2,1:3", "99999999999:1", "+5",   "1 2"})
    expect_usage_error([&] { KeyedValue::parse(text, "--focus", Infinity::legal); }, "--focus: ");
}

TEST(Keys, InfinityIsRefusedWhereItHasNoMeaning) {
  for (const char* text : {"inf", "1:2,3:inf"})
    expect_usage_error([&] { KeyedValue::parse(text, "--fstop", Infinity::refused); }, "--fstop: must be finite");
}

TEST(Keys, EmptyListIsRefused) {
  expect_usage_error([] { KeyedValue(std::vector<Key>{}, "--fstop", Infinity::refused); }, "--fstop: has no keys");
}

TEST(Keys, InterpolationNamesParseBack) {
  for (FocusInterp interpolation : every_interpolation)
    EXPECT_EQ(parse_focus_interp(name(interpolation)), interpolation);
  expect_usage_error([] { parse_focus_interp("cubic"); }, "--focus-interp: 'cubic'");
}

}  // namespace
}  // namespace pullfocus
