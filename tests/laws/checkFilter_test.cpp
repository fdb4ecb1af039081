#include <slamot/core/Error.h>
#include <slamot/core/FilterRegistry.h>
#include <slamot/core/checkStep.h>
#include <slamot/filters/registerAll.h>
#include <slamot/laws/checkFilter.h>

#include <gtest/gtest.h>

#include <limits>

namespace
{
using namespace slamot;

/// Dead reckoning with one defect, by the key `defect`.
class Defective : public core::Filter
{
 public:
  Defective(core::Params& p, const core::FilterContext& c)
      : defect_(p.text("defect")), threads_(c.threads)
  {
    estimate_.time = c.starts.time.value_or(0);
    estimate_.robot = c.starts.robotPose();
  }

  core::Update process(const core::Step& step) override
  {
    const core::Step usable = defect_ == "takes any time" ? at(step, estimate_.time) : step;
    if (defect_ == "moves before it checks" && step.odometry) move(*step.odometry);
    if (defect_ != "takes infinity") core::checkStep(usable, estimate_.time);
    if (defect_ == "throws late" && ++steps_ > 30) throw std::logic_error("a defect");
    estimate_.time = usable.time;
    if (step.odometry && defect_ != "moves before it checks") move(*step.odometry);
    if (defect_ == "grows sure" && !step.odometry) estimate_.robot.cov *= 0.99;
    return {estimate_, {}, {}};
  }
  [[nodiscard]] core::Estimate estimate() const override { return estimate_; }

 private:
  static core::Step at(core::Step step, double time)
  {
    if (step.time < time) step.time = time;
    return step;
  }
  void move(Gaussian<Pose2D> increment)
  {
    if (defect_ == "over-confident") increment.cov /= 2;
    if (defect_ == "under-confident") increment.cov *= 2;
    core::Estimate& e = estimate_;
    e.robot = math::compose(e.robot, increment);
    if (defect_ == "skews") e.robot.cov(0, 1) += 1e-3;
    if (defect_ == "negative") e.robot.cov(2, 2) = -1e-3;
    if (defect_ == "counts threads") e.robot.mean.x += 1e-9 * threads_;
    if (defect_ == "knows north") e.robot.mean.y += 1e-4;
  }

  std::string defect_;
  int threads_, steps_ = 0;
  core::Estimate estimate_;
};
SLAMOT_REGISTER_FILTER("defective", Defective)

core::Config withDefect(const std::string& defect)
{
  return core::Config::parse("[defective]\ndefect = " + defect + "\n", "test");
}

/// The laws broken by a defect, joined.
std::string lawsBroken(const std::string& defect)
{
  std::string all;
  for (const std::string& line : laws::brokenLaws("defective", withDefect(defect)))
    all += line + "\n";
  return all;
}

TEST(DeadReckoning, ObeysTheFilterLaws)
{
  filters::registerAll();
  laws::checkFilter("dead-reckoning");
}

TEST(CheckFilter, FindsOverconfidenceUnderASystematicError)
{
  laws::LawOptions options;
  options.world.speedScaleStd = 0.05;
  const auto broken = laws::brokenLaws("defective", withDefect("none"), options);
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_NE(broken[0].find("over-confident"), std::string::npos);
}

TEST(CheckFilter, FindsNothingWhereThereIsNoDefect)
{
  EXPECT_EQ(lawsBroken("none"), "");
}

struct Case
{
  const char* defect;
  const char* says;
};
class CheckFilterFinds : public ::testing::TestWithParam<Case>
{
};

TEST_P(CheckFilterFinds, TheDefect)
{
  EXPECT_NE(lawsBroken(GetParam().defect).find(GetParam().says), std::string::npos)
      << lawsBroken(GetParam().defect);
}

INSTANTIATE_TEST_SUITE_P(
    Each, CheckFilterFinds,
    ::testing::Values(
        Case{"takes any time", "time before the last step's was taken"},
        Case{"moves before it checks", "time before the last step's changed the estimate"},
        Case{"takes infinity", "time NaN was taken"},
        Case{"throws late", "the filter threw: a defect"},
        Case{"skews", "the covariance of the robot is not symmetric"},
        Case{"negative", "the covariance of the robot is not positive"},
        Case{"grows sure", "steps with nothing: the robot's place becomes more certain"},
        Case{"counts threads", "one thread and 2 differ"},
        Case{"knows north", "rotating the world rotates the estimate: seed 1"},
        Case{"over-confident", "over-confident"}, Case{"under-confident", "under-confident"}));

TEST(CheckFilter, ThrowsWithTheLawInItsText)
{
  try
  {
    laws::checkFilter("defective", withDefect("knows north"));
    FAIL() << "nothing was thrown";
  }
  catch (const laws::LawBroken& e)
  {
    EXPECT_NE(std::string(e.what()).find("filter defective breaks a law"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("rotating the world"), std::string::npos);
  }
}

TEST(CheckFilter, LetsAKnownOverconfidenceBeWithAReason)
{
  laws::LawOptions options;
  options.robotNees = {1.1, 10.0, "made so for this test"};
  EXPECT_NO_THROW(laws::checkFilter("defective", withDefect("over-confident"), options));
  options.robotNees->reason = "";
  EXPECT_THROW((void)laws::brokenLaws("defective", withDefect("over-confident"), options),
               core::Error);
}

TEST(CheckFilter, OnAverageARotatedWorldStillMustRotate)
{
  laws::LawOptions options;
  options.rotatesOnlyOnAverage = "for this test";
  EXPECT_TRUE(laws::brokenLaws("defective", withDefect("none"), options).empty());
  EXPECT_FALSE(laws::brokenLaws("defective", withDefect("knows north"), options).empty());
}

TEST(CheckFilter, NamesAFilterOrKeyThatIsNotThere)
{
  EXPECT_THROW((void)laws::brokenLaws("no-such-filter"), core::Error);
  core::Config config = withDefect("none");
  config.set("defective.defcet=typo");
  EXPECT_THROW((void)laws::brokenLaws("defective", config), core::Error);
}
}  // namespace
