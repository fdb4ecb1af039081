#include <gtest/gtest.h>
#include <slamot/core/Odometry.h>

namespace slamot::core
{
namespace
{
OdometryModel model(const std::string& keys)
{
  Config c = Config::parse("[odometer]\n" + keys, "x.ini");
  Params p(c, "odometer");
  const OdometryModel m = OdometryModel::from(p);
  c.requireAllRead();
  return m;
}
}  // namespace

TEST(OdometryModel, LeavesWhatTheLogSays)
{
  const auto g = math::turnThenMove(1, 0.5, 0.1, 0.2, 0.3);
  const auto out = model("").apply(g, 0.1);
  EXPECT_EQ(out.mean, g.mean);
  EXPECT_EQ(out.cov, g.cov);
}

TEST(OdometryModel, LeavesTheModelsKeysAloneWhereTheLogIsToldToCount)
{
  EXPECT_TRUE(model("noise = log\nv_std_mps = 0.1\nomega_std_deg_per_s = 1\n").fromLog);
}

TEST(OdometryModel, MakesTheCovarianceOfTurnThenMove)
{
  const auto truth = math::turnThenMove(1.5, -0.8, 0.2, 0.4, 0.5);
  Gaussian<Pose2D> increment{truth.mean, Matrix3::Zero()};
  const auto out =
      model("noise = model\nv_std_mps = 0.4\nomega_std_deg_per_s = 28.64788975654116\n")
          .apply(increment, 0.2);
  EXPECT_EQ(out.mean, truth.mean);
  EXPECT_TRUE(out.cov.isApprox(truth.cov, 1e-12)) << out.cov << "\n\n" << truth.cov;
}

TEST(OdometryModel, GrowsWithSpeedAlsoBackwards)
{
  const OdometryModel m =
      model("noise = model\nv_std_mps = 0.3\nomega_std_deg_per_s = 0\nv_scale_std = 0.2\n");
  for (const double v : {2.0, -2.0})
  {
    const auto out = m.apply(math::turnThenMove(v, 0, 0.5, 0, 0), 0.5);
    EXPECT_NEAR(out.cov(0, 0), (0.09 + 0.16) * 0.25, 1e-12);
    EXPECT_NEAR(out.cov(1, 1), 0, 1e-12);
  }
}

TEST(OdometryModel, LeavesAnIncrementWithoutDurationAlone)
{
  const auto g = math::turnThenMove(1, 0.5, 0.1, 0.2, 0.3);
  const OdometryModel m = model("noise = model\nv_std_mps = 1\nomega_std_deg_per_s = 1\n");
  EXPECT_EQ(m.apply(g, 0).cov, g.cov);
}
}  // namespace slamot::core
