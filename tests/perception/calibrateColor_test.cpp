#include <slamot/perception/calibrateColor.h>

#include "drawnScenes.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include <filesystem>

namespace slamot::perception
{
namespace
{
/// The largest blob of the range proposed for a box.
ImageBlob largest(const cv::Mat& image, const ColorProposal& proposal)
{
  ColorClass found;
  found.range = proposal.range;
  found.joinGap = 0;  // the flowers all but touch
  const auto blobs = ColorDetector({found}).detect(image);
  return blobs.empty() ? ImageBlob{} : blobs[0];
}

TEST(ProposeColor, FindsDrawnDiscsOfAnyHue)
{
  for (int hue = 0; hue < 360; hue += 15)
  {
    cv::Mat image = test::background();
    test::drawDisc(image, {300, 200}, 40, test::color(hue, 0.7, 0.7));
    test::addNoise(image, 5, 7);
    const auto proposal = proposeColor(image, {260, 160, 81, 81});
    EXPECT_GT(proposal.found, 0.9) << hue;
    EXPECT_LT(proposal.stray, 0.1) << hue;
    const ImageBlob blob = largest(image, proposal);
    EXPECT_NEAR(blob.center.x, 300, 1) << hue;
    EXPECT_NEAR(blob.center.y, 200, 1) << hue;
    EXPECT_NEAR(blob.area, math::kPi * 1600, 300) << hue;
  }
}

TEST(ProposeColor, RefusesABoxThatHasNoRestAroundIt)
{
  const cv::Mat image = test::background(64, 48);
  for (const cv::Rect& box : {cv::Rect(0, 0, 64, 48), cv::Rect(-1, 0, 10, 10),
                              cv::Rect(60, 0, 10, 10), cv::Rect(3, 3, 0, 5), cv::Rect(3, 3, 5, -5)})
    EXPECT_THROW((void)proposeColor(image, box), std::invalid_argument);
  EXPECT_THROW((void)proposeColor({}, {0, 0, 1, 1}), std::invalid_argument);
  EXPECT_NO_THROW((void)proposeColor(image, {3, 3, 1, 1}));
}

// Boxes, centres and areas: the photographs' own README.
TEST(ProposeColor, FindsTheFlower)
{
  const std::string path = SLAMOT_REAL_DATA "/blob/flower_320.png";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const cv::Mat image = cv::imread(path);
  const ImageBlob blob = largest(image, proposeColor(image, {84, 44, 139, 136}));
  EXPECT_NEAR(blob.center.x, 153.3, 4);
  EXPECT_NEAR(blob.center.y, 112.0, 4);
  EXPECT_NEAR(blob.area, 14203, 2000);
}

TEST(ProposeColor, FindsTheSaucerOnItsTable)
{
  const std::string path = SLAMOT_REAL_DATA "/blob/coffee_320.png";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const cv::Mat image = cv::imread(path);
  const ImageBlob blob = largest(image, proposeColor(image, {41, 38, 215, 170}));
  EXPECT_NEAR(blob.center.x, 143.7, 10);
  EXPECT_NEAR(blob.center.y, 131.5, 15);
}
}  // namespace
}  // namespace slamot::perception
