// What detection costs: colour blobs in VGA images, of one to three classes, with and without the
// decoding of a JPEG, and posts in a laser scan.  The aim is 100 images a second on one core.

#include <benchmark/benchmark.h>
#include <slamot/math/random.h>
#include <slamot/perception/ColorDetector.h>
#include <slamot/perception/RoundDetector.h>

#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace
{
using namespace slamot;
using namespace slamot::perception;

/// A noisy scene with ten discs of each of three hues.
cv::Mat scene()
{
  cv::Mat image(480, 640, CV_8UC3, cv::Scalar(120, 110, 100));
  const cv::Scalar colors[] = {{20, 110, 220}, {30, 30, 210}, {200, 60, 40}};
  math::RandomStream random{1};
  for (int i = 0; i < 30; ++i)
    cv::circle(
        image,
        {static_cast<int>(random.uniform(20, 620)), static_cast<int>(random.uniform(20, 460))},
        static_cast<int>(random.uniform(5, 30)), colors[i % 3], cv::FILLED);
  cv::Mat noise(image.size(), CV_8UC3);
  cv::RNG dice(2);
  dice.fill(noise, cv::RNG::UNIFORM, 0, 20);
  return image + noise;
}

std::vector<ColorClass> classes(std::size_t n)
{
  std::vector<ColorClass> out(3);
  const double hues[] = {25, 0, 230};
  for (std::size_t i = 0; i < 3; ++i)
  {
    out[i].range = {hues[i] == 0 ? 345 : hues[i] - 15, hues[i] + 12, 0.5, 1, 0.3, 1};
    out[i].light.rate = 0.2;
  }
  out.resize(n);
  return out;
}

void blobs(benchmark::State& state)
{
  cv::setNumThreads(1);
  const cv::Mat image = scene();
  std::vector<std::uint8_t> jpeg;
  cv::imencode(".jpg", image, jpeg);
  ColorDetector detector(classes(static_cast<std::size_t>(state.range(0))));
  std::size_t found = 0;
  for (auto _ : state)
    found +=
        detector.detect(state.range(1) != 0 ? cv::imdecode(jpeg, cv::IMREAD_COLOR) : image).size();
  state.counters["images_per_s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["blobs"] =
      benchmark::Counter(static_cast<double>(found), benchmark::Counter::kAvgIterations);
}
BENCHMARK(blobs)
    ->ArgNames({"classes", "jpeg"})
    ->ArgsProduct({{1, 3}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

/// A half turn of beams with a post every eighth of it before a far wall.
core::LaserScan scan(std::size_t beams)
{
  core::LaserScan out;
  out.angleMin = -math::kPi / 2;
  out.angleStep = math::kPi / static_cast<double>(beams - 1);
  out.rangeMax = 50;
  math::RandomStream random{3};
  for (std::size_t i = 0; i < beams; ++i)
  {
    const double a = static_cast<double>(i) * out.angleStep, off = std::remainder(a, math::kPi / 8);
    const bool post = std::abs(4 * std::sin(off)) < 0.1;
    out.ranges.push_back(static_cast<float>((post ? 4 : 20) + 0.02 * random.normal()));
  }
  return out;
}

void posts(benchmark::State& state)
{
  const core::LaserScan s = scan(static_cast<std::size_t>(state.range(0)));
  const LaserOptions laser;
  const RoundDetector detector(RoundOptions::posts(), laser);
  std::size_t found = 0;
  for (auto _ : state) found += detector.detect(s, clustersOf(s, laser)).size();
  state.counters["posts"] =
      benchmark::Counter(static_cast<double>(found), benchmark::Counter::kAvgIterations);
}
BENCHMARK(posts)->ArgName("beams")->Arg(361)->Arg(1081)->Unit(benchmark::kMicrosecond);
}  // namespace

BENCHMARK_MAIN();
