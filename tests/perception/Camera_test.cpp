#include <slamot/perception/Camera.h>

#include "drawnScenes.h"

#include <gtest/gtest.h>

namespace slamot::perception
{
namespace
{
Camera pinhole()
{
  Camera c;
  c.width = 640, c.height = 480;
  c.fx = 500, c.fy = 510, c.cx = 322, c.cy = 238;
  return c;
}
Camera distorted()
{
  Camera c = pinhole();
  c.distortion = {-0.25, 0.08, 1e-3, -5e-4, 0, 0, 0, 0};
  return c;
}
Camera fisheye()
{
  Camera c = pinhole();
  c.fx = c.fy = 400;
  c.lens = Camera::Lens::kFisheye;
  c.distortion = {0.02, -0.01, 0.003, -0.001, 0, 0, 0, 0};
  return c;
}

TEST(Camera, AxisAndSides)
{
  const Camera c = pinhole();
  EXPECT_NEAR(c.direction({322, 238}).bearing, 0, 1e-12);
  EXPECT_NEAR(c.direction({322, 238}).elevation, 0, 1e-12);
  EXPECT_NEAR(c.direction({322 + 500, 238}).bearing, -math::kPi / 4, 1e-12);  // the image's right
  EXPECT_NEAR(c.direction({322, 238 - 510}).elevation, math::kPi / 4, 1e-12);
}

TEST(Camera, PixelsComeBack)
{
  for (const Camera& c : {pinhole(), distorted(), fisheye()})
    for (double u = 5; u < 640; u += 90)
      for (double v = 5; v < 480; v += 90)
      {
        const cv::Point2d back = c.pixel(c.direction({u, v}));
        EXPECT_NEAR(back.x, u, 1e-3);
        EXPECT_NEAR(back.y, v, 1e-3);
      }
}

TEST(Camera, AnotherSizeIsTheSameView)
{
  const auto whole = distorted().direction({100, 400});
  const auto half = distorted().scaledTo(320, 240).direction({49.75, 199.75});
  EXPECT_NEAR(whole.bearing, half.bearing, 1e-9);
  EXPECT_NEAR(whole.elevation, half.elevation, 1e-9);
}

TEST(Camera, NumbersThatAreNoCamera)
{
  EXPECT_TRUE(pinhole().makesSense());
  Camera c = pinhole();
  c.fx = 0;
  EXPECT_FALSE(c.makesSense());
  c = pinhole();
  c.cy = std::nan("");
  EXPECT_FALSE(c.makesSense());
  c = pinhole();
  c.distortion[2] = INFINITY;
  EXPECT_FALSE(c.makesSense());
}

// Drawn at known places: the error of the bearing in its own deviations.
TEST(DirectionOf, DeviationsAreThoseOfDrawnDiscs)
{
  const Camera camera = distorted();
  BlobNoise noise;
  noise.calibration = 0;  // these numbers are the camera's own
  noise.shape = 0;        // and discs are evenly lit
  ColorDetector detector({test::orange()});
  double sum = 0;
  constexpr int kImages = 100;
  for (int i = 0; i < kImages; ++i)
  {
    math::RandomStream random{static_cast<std::uint64_t>(i)};
    cv::Mat image = test::background();
    const cv::Point2d at(random.uniform(80, 560), random.uniform(80, 400));
    test::drawDisc(image, at, random.uniform(4, 40), test::color(25, 0.9, 0.8));
    test::addNoise(image, 10, 500 + static_cast<std::uint64_t>(i));
    const auto blobs = detector.detect(image);
    ASSERT_GE(blobs.size(), 1u);
    const SeenDirection seen = directionOf(blobs[0], camera, noise);
    const auto truth = camera.direction(at);
    sum += std::pow((seen.at.bearing - truth.bearing) / seen.bearingStd, 2) +
           std::pow((seen.at.elevation - truth.elevation) / seen.elevationStd, 2);
  }
  const double nees = sum / (2 * kImages);
  // A rim that falls between pixels errs by 0.29 pixel, of the 0.5 that are assumed.
  EXPECT_NEAR(nees, std::pow(0.29 / 0.5, 2), 0.1);
}

TEST(DirectionOf, DoubtGrowsWithWhatIsUnsure)
{
  const Camera camera = pinhole();
  ImageBlob small, large, cut;
  small.center = large.center = cut.center = {200, 200};
  small.box = {195, 195, 10, 10}, large.box = cut.box = {150, 150, 100, 100};
  small.area = 78, large.area = cut.area = 7850;
  cut.cut = true;
  BlobNoise rim;
  rim.calibration = rim.shape = 0;
  EXPECT_GT(directionOf(small, camera, rim).bearingStd, directionOf(large, camera, rim).bearingStd);
  EXPECT_GT(directionOf(cut, camera, {}).bearingStd, 3 * directionOf(large, camera, {}).bearingStd);
}
}  // namespace
}  // namespace slamot::perception
