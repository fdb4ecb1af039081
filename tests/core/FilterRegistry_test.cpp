#include "expectError.h"

#include <slamot/core/FilterRegistry.h>

namespace slamot::core
{
namespace
{
using test::expectConfigError;

/// Stands still; the pose is its parameter and its context's seed.
class Still : public Filter
{
 public:
  Still(Params& p, const FilterContext& c)
  {
    estimate_.robot.mean = {p.number("x"), double(c.seed), 0};
  }
  Update process(const Step&) override { return {estimate_, {}, {}}; }
  [[nodiscard]] Estimate estimate() const override { return estimate_; }

 private:
  Estimate estimate_;
};
SLAMOT_REGISTER_FILTER("still", Still)

std::string methodOfText(const std::string& text)
{
  Config c = Config::parse(text, "x.ini");
  return methodOf(c);
}
}  // namespace

TEST(FilterRegistry, MakesAFilterWithItsSection)
{
  Config c = Config::parse("[still]\nx = 4\n", "x.ini");
  FilterContext context;
  context.seed = 9;
  const auto filter = FilterRegistry::instance().make("still", c, context);
  EXPECT_EQ(filter->estimate().robot.mean, Pose2D(4, 9, 0));
  EXPECT_TRUE(filter->particles().empty());
  c.requireAllRead();
}

TEST(FilterRegistry, NamesTheFiltersItKnows)
{
  Config c;
  expectConfigError([&] { (void)FilterRegistry::instance().make("stil", c, {}); },
                    {"filter 'stil' is unknown", "still", "--plugin"});
  EXPECT_TRUE(FilterRegistry::instance().has("still"));
  EXPECT_FALSE(FilterRegistry::instance().has("stil"));
}

TEST(FilterRegistry, MakesNoneOfTwoWithOneName)
{
  const auto factory = [](Params& p, const FilterContext& c)
  { return std::make_unique<Still>(p, c); };
  FilterRegistry::instance().add("twin", factory);
  FilterRegistry::instance().add("twin", factory);
  Config c = Config::parse("[twin]\nx = 1\n", "x.ini");
  expectConfigError([&] { (void)FilterRegistry::instance().make("twin", c, {}); },
                    {"twin", "twice"});
}

TEST(MethodOf, IsTheSectionNamedAfterAFilterOrWhatRunNames)
{
  EXPECT_EQ(methodOfText("[other]\ny = 1\n[still]\nx = 1\n"), "still");
  EXPECT_EQ(methodOfText("[run]\nmethod = still\n"), "still");
  expectConfigError([] { (void)methodOfText("[other]\ny = 1\n"); }, {"names no filter"});
  expectConfigError([] { (void)methodOfText("[run]\nmethod = stil\n"); },
                    {"[run] method", "'stil' is not known"});
}

TEST(MethodOf, IsInTheEffectiveConfig)
{
  Config c = Config::parse("[still]\nx = 1\n", "x.ini");
  (void)methodOf(c);
  EXPECT_EQ(c.effectiveText(), "[run]\nmethod = still\n");
}

TEST(MethodOf, RefusesToChooseBetweenTwo)
{
  FilterRegistry::instance().add(
      "still-too", [](Params& p, const FilterContext& c) { return std::make_unique<Still>(p, c); });
  expectConfigError([] { (void)methodOfText("[still]\nx = 1\n[still-too]\nx = 1\n"); },
                    {"still and still-too", "[run] method"});
  EXPECT_EQ(methodOfText("[still]\nx = 1\n[still-too]\nx = 1\n[run]\nmethod = still-too\n"),
            "still-too");
}
}  // namespace slamot::core
