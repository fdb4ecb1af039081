#include "drawnScenes.h"

#include <gtest/gtest.h>
#include <slamot/core/Error.h>

#include <opencv2/imgcodecs.hpp>

#include <filesystem>

namespace slamot::perception
{
namespace
{
using namespace test;

TEST(ColorDetector, FindsDrawnDiscsWhereTheyAre)
{
  math::RandomStream random{1};
  for (int i = 0; i < 20; ++i)
  {
    cv::Mat image = background();
    const cv::Point2d at(random.uniform(100, 540), random.uniform(100, 380));
    const double radius = random.uniform(6, 60);
    drawDisc(image, at, radius, color(25, 0.9, 0.8));
    addNoise(image, 6, 10 + static_cast<std::uint64_t>(i));
    ColorDetector detector({orange()});
    const auto blobs = detector.detect(image);
    ASSERT_EQ(blobs.size(), 1u) << i;
    EXPECT_NEAR(blobs[0].center.x, at.x, 0.5) << i;
    EXPECT_NEAR(blobs[0].center.y, at.y, 0.5) << i;
    EXPECT_NEAR(blobs[0].area, math::kPi * radius * radius, 5 * radius) << i;  // but for its rim
    EXPECT_FALSE(blobs[0].cut);
  }
}

TEST(ColorDetector, TellsClassesApartAndFindsAllOfOne)
{
  cv::Mat image = background();
  drawDisc(image, {100, 100}, 20, color(25, 0.9, 0.8));
  drawDisc(image, {300, 200}, 30, color(25, 0.9, 0.8));
  drawDisc(image, {500, 300}, 15, color(355, 0.9, 0.8));  // reds lie on both sides of 0
  drawDisc(image, {500, 100}, 12, color(4, 0.9, 0.8));
  ColorDetector detector({orange(), red()});
  const auto blobs = detector.detect(image);
  ASSERT_EQ(blobs.size(), 4u);
  EXPECT_EQ(blobs[0].colorClass, 0u);
  EXPECT_NEAR(blobs[0].center.x, 300, 0.5);  // the largest first
  EXPECT_NEAR(blobs[1].center.x, 100, 0.5);
  EXPECT_EQ(blobs[2].colorClass, 1u);
  EXPECT_NEAR(blobs[2].center.y, 300, 0.5);
  EXPECT_NEAR(blobs[3].center.y, 100, 0.5);
}

TEST(ColorDetector, JoinsWhatAPostParts)
{
  cv::Mat image = background();
  drawDisc(image, {300, 200}, 40, color(25, 0.9, 0.8));
  cv::rectangle(image, {296, 0, 8, 480}, color(0, 0, 0.2), cv::FILLED);
  ColorClass apart = orange(), one = orange();
  apart.joinGap = 2;
  one.joinGap = 12;
  EXPECT_EQ(ColorDetector({apart}).detect(image).size(), 2u);
  const auto blobs = ColorDetector({one}).detect(image);
  ASSERT_EQ(blobs.size(), 1u);
  EXPECT_NEAR(blobs[0].center.x, 300, 0.6);
  EXPECT_NEAR(blobs[0].box.width, 81, 2);
}

TEST(ColorDetector, MarksWhatTheEdgeCuts)
{
  cv::Mat image = background();
  drawDisc(image, {5, 200}, 20, color(25, 0.9, 0.8));
  drawDisc(image, {300, 475}, 20, color(25, 0.9, 0.8));
  drawDisc(image, {300, 200}, 20, color(25, 0.9, 0.8));
  const auto blobs = ColorDetector({orange()}).detect(image);
  ASSERT_EQ(blobs.size(), 3u);
  for (const ImageBlob& b : blobs)
    EXPECT_EQ(b.cut, std::abs(b.center.x - 300) > 1 || b.center.y > 400);
}

TEST(ColorDetector, LeavesOutWhatIsTooSmallThinOrLarge)
{
  cv::Mat image = background();
  drawDisc(image, {100, 100}, 2, color(25, 0.9, 0.8));
  cv::line(image, {200, 100}, {400, 300}, color(25, 0.9, 0.8), 2);
  EXPECT_TRUE(ColorDetector({orange()}).detect(image).empty());
  const cv::Mat all(480, 640, CV_8UC3, color(25, 0.9, 0.8));
  EXPECT_TRUE(ColorDetector({orange()}).detect(all).empty());
  ColorClass any = orange();
  any.mostOfImage = 1;
  const auto blobs = ColorDetector({any}).detect(all);
  ASSERT_EQ(blobs.size(), 1u);
  EXPECT_TRUE(blobs[0].cut);
  EXPECT_NEAR(blobs[0].center.x, 319.5, 1e-9);
}

TEST(ColorDetector, TakesAnyKindOfImage)
{
  cv::Mat image = background();
  drawDisc(image, {300, 200}, 20, color(25, 0.9, 0.8));
  cv::Mat grey, alpha, deep;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  cv::cvtColor(image, alpha, cv::COLOR_BGR2BGRA);
  image.convertTo(deep, CV_16U, 257);
  ColorDetector detector({orange()});
  EXPECT_TRUE(detector.detect(cv::Mat()).empty());
  EXPECT_TRUE(detector.detect(grey).empty());
  EXPECT_TRUE(detector.detect(cv::Mat(10, 10, CV_32FC3, cv::Scalar(1, 0, 0))).empty());
  for (const cv::Mat& m : {image, alpha, deep})
  {
    const auto blobs = detector.detect(m);
    ASSERT_EQ(blobs.size(), 1u);
    EXPECT_NEAR(blobs[0].center.x, 300, 0.2);
  }
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(3, 1), cv::Size(641, 7), cv::Size(1, 999)})
    EXPECT_TRUE(detector.detect(cv::Mat(size, CV_8UC3, color(200, 0.9, 0.8))).empty());
}

TEST(ColorDetector, NoiseAloneIsNoObject)
{
  cv::Mat image(480, 640, CV_8UC3);
  cv::RNG random(3);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  EXPECT_TRUE(ColorDetector({orange(), red()}).detect(image).empty());
}

/// How many of 60 images hold a blob within a pixel of the disc, as the light changes to `end`.
int tracked(ColorClass wanted, const std::function<cv::Scalar(double)>& colorAt)
{
  ColorDetector detector({std::move(wanted)});
  int good = 0;
  for (int i = 0; i < 60; ++i)
  {
    cv::Mat image = background(480, 360);
    const cv::Point2d at(60 + 6 * i, 200);
    drawDisc(image, at, 25, colorAt(i / 59.0));
    addNoise(image, 4, 100 + static_cast<std::uint64_t>(i));
    const auto blobs = detector.detect(image);
    good += blobs.size() == 1 && cv::norm(blobs[0].center - at) < 1 ? 1 : 0;
  }
  return good;
}

// The limits that the documentation states: slowly, to 0.45 of the light, or by 15 degrees of hue.
TEST(ColorDetector, FollowsTheLight)
{
  ColorClass fixed = orange(), following = orange();
  fixed.range = following.range = {15, 35, 0.6, 1, 0.5, 1};
  following.light.rate = 0.3;
  const auto dimmer = [](double part) { return color(25, 0.9, 0.75 * (1 - 0.55 * part)); };
  const auto redder = [](double part) { return color(25 - 15 * part, 0.9, 0.75); };
  EXPECT_LT(tracked(fixed, dimmer), 45);
  EXPECT_EQ(tracked(following, dimmer), 60);
  EXPECT_LT(tracked(fixed, redder), 50);
  EXPECT_EQ(tracked(following, redder), 60);
}

TEST(ColorDetector, FollowsTheLightNoFartherThanToldTo)
{
  ColorClass following = orange();
  following.light = {0.5, 10, 1.5};
  ColorDetector detector({following});
  for (int i = 0; i < 40; ++i)
  {
    cv::Mat image = background();
    drawDisc(image, {300, 200}, 25, color(20 + i, 0.9, 0.9));
    detector.detect(image);
  }
  const HsvRange now = detector.rangeNow(0);
  EXPECT_NEAR(now.hueMin, following.range.hueMin + 10, 1e-9);
  EXPECT_NEAR(now.hueMax, following.range.hueMax + 10, 1e-9);
}

TEST(ColorDetector, FindsTheFlower)
{
  const std::string path = SLAMOT_REAL_DATA "/blob/flower_320.png";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  ColorClass flower = orange();
  flower.range = {346, 49, 0.314, 1, 0.47, 1};
  const auto blobs = ColorDetector({flower}).detect(cv::imread(path));
  ASSERT_GE(blobs.size(), 2u);
  EXPECT_NEAR(blobs[0].area, 14203, 300);
  EXPECT_NEAR(blobs[0].center.x, 153.3, 1);
  EXPECT_NEAR(blobs[0].center.y, 112.0, 1);
  EXPECT_FALSE(blobs[0].cut);
  EXPECT_TRUE(blobs[1].cut);  // the flower at the lower edge
}
}  // namespace
}  // namespace slamot::perception
