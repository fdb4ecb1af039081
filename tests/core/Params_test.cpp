#include "expectError.h"

#include <slamot/core/Params.h>
#include <slamot/math/geometry.h>

#include <functional>

namespace slamot::core
{
namespace
{
using test::expectConfigError;

/// What a reader makes of `x = text`.
template <class F>
auto with(const std::string& text, F read)
{
  Config c = Config::parse("[f]\nx = " + text + "\nx_deg = " + text + "\n", "x.ini");
  Params p(c, "f");
  return read(p);
}

void expectRefused(const std::string& text, const std::function<void(Params&)>& read,
                   const std::vector<std::string>& parts)
{
  SCOPED_TRACE("x = " + text);
  expectConfigError([&] { with(text, read); }, parts);
}

const auto kNumber = [](Params& p) { return p.number("x"); };
}  // namespace

TEST(Params, ReadsNumbersWhole)
{
  EXPECT_EQ(with("-1.5e-3", kNumber), -1.5e-3);
  EXPECT_EQ(with("+2", kNumber), 2);
  EXPECT_EQ(with(".5", kNumber), 0.5);
  EXPECT_EQ(with("7 // why", kNumber), 7);
  for (const char* text :
       {"abc",      "",      "1.5x", "1 2", "1,5", "0x10", "nan", "NaN", "inf",  "-inf",
        "infinity", "1e400", "--1",  "+-1", "+",   "-",    ".",   "1e",  "1..2", "1_000"})
    expectRefused(text, kNumber, {"x.ini [f] x: ", "no number", "set it to a number"});
}

TEST(Params, TellsWhatIsMissingAndWhatIsAllowed)
{
  Config c;
  Params p(c, "f");
  expectConfigError([&] { (void)p.number("a"); }, {"config [f] a: missing; set it to a number"});
  expectConfigError([&] { (void)p.positive("a"); }, {"missing", "a number > 0"});
  expectConfigError([&] { (void)p.probability("a"); }, {"missing", "(0, 1)"});
  expectConfigError([&] { (void)p.integer("a", 1, 9); }, {"missing", "whole number from 1 to 9"});
  expectConfigError([&] { (void)p.flag("a"); }, {"missing", "true | false"});
  expectConfigError([&] { (void)p.text("a"); }, {"missing"});
  expectConfigError([&] { (void)p.choice("a", {"p", "q"}); }, {"missing", "p | q"});
  expectConfigError([&] { (void)p.numbers("a"); }, {"missing"});
}

TEST(Params, ChecksEveryRange)
{
  const auto positive = [](Params& p) { return p.positive("x"); };
  const auto nonNegative = [](Params& p) { return p.nonNegative("x"); };
  const auto probability = [](Params& p) { return p.probability("x"); };
  const auto inRange = [](Params& p) { return p.inRange("x", -1, 2); };
  const auto atLeast = [](Params& p) { return p.optionalNumber("x", 3).value(); };
  EXPECT_EQ(with("1e-300", positive), 1e-300);
  EXPECT_EQ(with("0", nonNegative), 0);
  EXPECT_EQ(with("0.5", probability), 0.5);
  EXPECT_EQ(with("-1", inRange), -1);
  EXPECT_EQ(with("2", inRange), 2);
  EXPECT_EQ(with("3", atLeast), 3);
  expectRefused("0", positive, {"0 is out of range", "a number > 0"});
  expectRefused("-0", positive, {"out of range"});
  expectRefused("-1e-9", nonNegative, {"out of range", "a number >= 0"});
  expectRefused("0", probability, {"out of range", "in (0, 1)"});
  expectRefused("1", probability, {"out of range", "in (0, 1)"});
  expectRefused("2.0001", inRange, {"out of range", "in [-1, 2]"});
  expectRefused("-1.0001", inRange, {"out of range", "in [-1, 2]"});
  expectRefused("2.999", atLeast, {"out of range", ">= 3"});
}

TEST(Params, ReadsWholeNumbersWhole)
{
  const auto integer = [](Params& p) { return p.integer("x", -2, 5); };
  EXPECT_EQ(with("5", integer), 5);
  EXPECT_EQ(with("-2", integer), -2);
  for (const char* text : {"", "abc", "1.0", "1e0", "2x", "0x1", "1 2"})
    expectRefused(text, integer, {"no whole number", "from -2 to 5"});
  for (const char* text : {"6", "-3", "99999999999", "-99999999999999999999"})
    expectRefused(text, integer, {std::string(text) + " is out of range", "from -2 to 5"});
}

TEST(Params, ReadsFlagsAndChoicesByTheirWords)
{
  const auto flag = [](Params& p) { return p.flag("x"); };
  EXPECT_TRUE(with("true", flag));
  EXPECT_FALSE(with("false", flag));
  for (const char* text : {"", "yes", "1", "True"})
    expectRefused(text, flag, {"is not known", "true | false"});
  expectRefused("r", [](Params& p) { (void)p.choice("x", {"p", "q"}); }, {"'r' is not known"});
}

TEST(Params, ReadsLists)
{
  const auto list = [](Params& p) { return p.list("x"); };
  const auto numbers = [](Params& p) { return p.numbers("x"); };
  EXPECT_EQ(with("a, b c ,d", list), (std::vector<std::string>{"a", "b c", "d"}));
  EXPECT_EQ(with("1,-2.5 , 3", numbers), (std::vector<double>{1, -2.5, 3}));
  EXPECT_EQ(with("4", numbers), (std::vector<double>{4}));
  expectRefused("", list, {"has an empty part"});
  expectRefused("1,abc,3", numbers, {"'abc' is no number"});
  expectRefused("1,nan", numbers, {"'nan' is no number"});
}

// Left out in silence, the coordinates after it would change their places.
TEST(Params, RefusesListsWithAnEmptyPart)
{
  for (const char* text : {"1,,2", ",1", "1,", " , ", ","})
  {
    expectRefused(text, [](Params& p) { (void)p.list("x"); }, {"empty"});
    expectRefused(text, [](Params& p) { (void)p.numbers("x"); }, {"empty"});
  }
}

TEST(Params, TurnsDegreesIntoRadiansByTheKeysName)
{
  EXPECT_DOUBLE_EQ(with("180", [](Params& p) { return p.number("x_deg"); }), math::kPi);
  const auto list = with("0, -90", [](Params& p) { return p.numbers("x_deg"); });
  EXPECT_DOUBLE_EQ(list.at(1), -math::kPi / 2);
  Config c = Config::parse("[f]\na_deg_per_s = 90\ndegree = 90\na_degraded = 90\n", "x.ini");
  Params p(c, "f");
  EXPECT_DOUBLE_EQ(p.number("a_deg_per_s"), math::kPi / 2);
  EXPECT_EQ(p.number("degree"), 90);
  EXPECT_EQ(p.number("a_degraded"), 90);
  // A default is in radians, bounds are in the file's unit.
  EXPECT_DOUBLE_EQ(p.inRange("absent_deg", 0, 180, math::kPi / 4), math::kPi / 4);
  expectRefused("181", [](Params& q) { (void)q.inRange("x_deg", 0, 180); }, {"[0, 180]"});
}

TEST(Params, TakesADefaultOnlyWhereTheKeyIsAbsent)
{
  Config c = Config::parse("[f]\nx = abc\n", "x.ini");
  Params p(c, "f");
  EXPECT_EQ(p.number("y", 2.5), 2.5);
  expectConfigError([&] { (void)p.number("x", 2.5); }, {"'abc' is no number"});
  EXPECT_EQ(p.optionalNumber("z"), std::nullopt);
  EXPECT_EQ(p.section(), "f");
  EXPECT_EQ(p.keys(), std::vector<std::string>{"x"});
  expectConfigError([&] { p.fail("x", "is bad", "mend it"); }, {"x.ini [f] x: is bad; mend it"});
}

TEST(Params, LeavesKeysOfAChoiceNotMadeAlone)
{
  Config c = Config::parse("[f]\nnoise = log\nx = abc\n", "x.ini");
  Params p(c, "f");
  (void)p.choice("noise", {"log", "model"});
  p.allowUnused({"x", "y"});
  c.requireAllRead();
  EXPECT_EQ(c.effectiveText(), "[f]\nnoise = log\n");
}
}  // namespace slamot::core
