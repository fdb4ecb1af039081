#include <slamot/perception/OdometryTrack.h>

#include <gtest/gtest.h>

namespace slamot::perception
{
namespace
{
void expectPose(const Pose2D& a, const Pose2D& b)
{
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
  EXPECT_NEAR(math::wrapToPi(a.phi - b.phi), 0, 1e-12);
}
}  // namespace

TEST(OdometryTrack, IsBetweenItsPosesAndHeldAtItsEnds)
{
  OdometryTrack track;
  expectPose(track.at(5), {});
  track.add(1, {2, 0, 3.1});
  track.add(2, {0, 0, -3.1});  // over pi, driving backwards along x
  expectPose(track.at(0), {2, 0, 3.1});
  expectPose(track.at(9), {0, 0, -3.1});
  const Pose2D middle = track.at(1.5);
  EXPECT_NEAR(middle.x, 1, 1e-12);
  EXPECT_NEAR(std::abs(middle.phi), math::kPi, 1e-12);
  expectPose(track.between(1, 2), math::between({2, 0, 3.1}, {0, 0, -3.1}));
}

TEST(OdometryTrack, ForgetsOnlyWhatIsNotNeeded)
{
  OdometryTrack track;
  for (int i = 0; i < 10; ++i) track.add(i, {static_cast<double>(i), 0, 0});
  track.forgetBefore(5.5);
  EXPECT_NEAR(track.at(5.5).x, 5.5, 1e-12);
  EXPECT_NEAR(track.at(2).x, 5, 1e-12);
  track.add(9, {20, 0, 0});  // of equal times the last holds
  EXPECT_NEAR(track.at(9).x, 20, 1e-12);
}
}  // namespace slamot::perception
