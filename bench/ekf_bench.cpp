// What one step of ekf-slamot costs: 20 landmarks and a target seen, in a map of any size; beside
// the floors: one pass over the triangle that an update changes, and as many multiplications as it
// needs, both at the best this machine does in this build.  And beside MRPT's CRangeBearingKFSLAM2D
// on the same sightings.  CPU times, medians of shuffled repetitions; the ratios come at the end.
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/slam/CRangeBearingKFSLAM2D.h>
#include <slamot/core/FilterRegistry.h>
#include <slamot/filters/EkfSlamot.h>
#include <slamot/filters/registerAll.h>
#include <slamot/math/random.h>
#include <slamot/models/RangeBearing.h>

#include <Eigen/Core>

#include <benchmark/benchmark.h>

#include "ekf/addProduct.h"

#include <algorithm>
#include <cstdio>
#include <map>

namespace
{
using namespace slamot;
namespace ekf = slamot::filters::ekf;

constexpr int kSeen = 20, kTarget = 6;
constexpr double kSpacing = 4;         // [m], between landmarks on a square grid
constexpr double kLocalRadius = 17.2;  // [m]: some 60 landmarks

int statesOf(int landmarks)
{
  return 3 + kTarget + 2 * landmarks;
}

/// A grid of landmarks about the origin, the nearest first.
class Field
{
 public:
  explicit Field(int landmarks)
  {
    const int edge = static_cast<int>(std::ceil(std::sqrt(landmarks)));
    for (int i = 0; i < edge * edge; ++i)
      points_.push_back(
          {kSpacing * (i % edge - 0.5 * edge + 0.3), kSpacing * (i / edge - 0.5 * edge + 0.4)});
    std::sort(points_.begin(), points_.end(),
              [](const Point2D& a, const Point2D& b)
              { return a.x * a.x + a.y * a.y < b.x * b.x + b.y * b.y; });
    points_.resize(static_cast<std::size_t>(landmarks));
  }

  /// A scan of the nearest `count` landmarks from near the origin.
  core::Step scan(int count)
  {
    core::Step step;
    step.time = 0.1 * ++steps_;
    const Pose2D next{0.3 * std::sin(0.7 * steps_), 0.3 * std::cos(0.9 * steps_),
                      0.05 * std::sin(steps_)};
    step.odometry = {math::between(robot_, next), 1e-4 * Matrix3::Identity()};
    robot_ = next;
    math::RandomStream random{1, static_cast<std::uint64_t>(steps_)};
    step.landmarks.emplace();
    for (int i = 0; i < count; ++i)
    {
      const auto z = models::RangeBearing::predict(robot_, points_[static_cast<std::size_t>(i)]);
      step.landmarks->sightings.push_back({z[0] + 0.1 * random.normal(),
                                           math::wrapToPi(z[1] + 0.01 * random.normal()), 0.1, 0.01,
                                           i});
    }
    core::Blob blob;
    blob.label = "target";
    blob.id = 0;
    const auto z = models::RangeBearing::predict(robot_, {5, 5});
    blob.range = z[0] + 0.1 * random.normal();
    blob.bearing = z[1] + 0.01 * random.normal();
    blob.rangeStd = 0.1;
    blob.bearingStd = 0.01;
    step.blobs.emplace().blobs = {blob};
    return step;
  }

 private:
  std::vector<Point2D> points_;
  Pose2D robot_;
  int steps_ = 0;
};

/// A filter that has seen the whole field once, and its nearest part a few times.
struct Rig
{
  Field field;
  std::unique_ptr<core::Filter> filter;

  Rig(int landmarks, double localRadius) : field(landmarks)
  {
    core::Config config = core::Config::parse(
        "[ekf-slamot]\ntarget_velocity_std_mps=1\ntarget_acceleration_std_mps2=0.5\n"
        "target_jerk_noise_mps3_per_sqrt_hz=0.1\n",
        "bench");
    config.set("ekf-slamot", "local_radius_m", std::to_string(localRadius));
    filter = core::FilterRegistry::instance().make("ekf-slamot", config, {});
    filter->process(field.scan(landmarks));
    for (int i = 0; i < 3; ++i) filter->process(field.scan(kSeen));
  }
};

void runSteps(benchmark::State& state, Rig& rig)
{
  for (auto _ : state)
  {
    state.PauseTiming();
    const core::Step step = rig.field.scan(kSeen);
    state.ResumeTiming();
    benchmark::DoNotOptimize(rig.filter->process(step));
  }
}

void plain(benchmark::State& state)
{
  Rig rig(static_cast<int>(state.range(0)), 0);
  runSteps(state, rig);
}
BENCHMARK(plain)
    ->ArgName("landmarks")
    ->Arg(100)
    ->Arg(200)
    ->Arg(400)
    ->Arg(1600)
    ->Unit(benchmark::kMicrosecond);

void compressed(benchmark::State& state)
{
  // Making a map of 10 000 landmarks takes longer than all the rest: once for all repetitions.
  static std::map<std::int64_t, std::unique_ptr<Rig>> rigs;
  auto& rig = rigs[state.range(0)];
  if (!rig) rig = std::make_unique<Rig>(static_cast<int>(state.range(0)), kLocalRadius);
  runSteps(state, *rig);
}
BENCHMARK(compressed)->ArgName("landmarks")->Arg(1600)->Arg(10000)->Unit(benchmark::kMicrosecond);

void fuse(benchmark::State& state)
{
  Rig rig(static_cast<int>(state.range(0)), static_cast<double>(state.range(1)));
  auto& filter = dynamic_cast<core::TeamFilter&>(*rig.filter);
  for (auto _ : state)
  {
    state.PauseTiming();
    rig.filter->process(rig.field.scan(kSeen));
    const auto own = filter.robotAndTarget(0);
    core::Evidence e;
    e.target = 0;
    e.H = Eigen::MatrixXd::Zero(8, own.mean.size());
    e.H.block<2, 2>(0, 0).setIdentity();
    e.H.block<6, 6>(2, 3).setIdentity();
    e.innovation = Eigen::VectorXd::Zero(8);
    e.cov = 0.5 * e.H * own.cov * e.H.transpose() + 1e-6 * Eigen::MatrixXd::Identity(8, 8);
    e.independent = Eigen::MatrixXd::Zero(8, 8);
    core::FusionOptions options;
    options.omega = 0.999;  // fuses whether it pays or not, and leaves the map in order
    state.ResumeTiming();
    benchmark::DoNotOptimize(filter.fuse(e, options));
  }
}
BENCHMARK(fuse)
    ->ArgNames({"landmarks", "local"})
    ->Args({1600, 0})
    ->Args({1600, 17})
    ->Unit(benchmark::kMicrosecond);

/// Reads and writes every entry of the triangle once.
void memoryFloor(benchmark::State& state)
{
  const int n = statesOf(static_cast<int>(state.range(0)));
  Eigen::MatrixXd P = Eigen::MatrixXd::Ones(n, n);
  for (auto _ : state)
  {
    for (int j = 0; j < n; ++j) P.col(j).tail(n - j) *= 1.0000001;
    benchmark::ClobberMemory();
  }
}
BENCHMARK(memoryFloor)->ArgName("landmarks")->Arg(1600)->Unit(benchmark::kMicrosecond);

/// As many multiplications as a rank-2m update of the triangle, in products that stay in the cache.
void arithmeticFloor(benchmark::State& state)
{
  const double n = statesOf(static_cast<int>(state.range(0))), rank = 2 * (kSeen + 1);
  constexpr int kBlock = 192;
  const int products =
      static_cast<int>(std::ceil(0.5 * n * n * rank / (1.0 * kBlock * kBlock * kBlock)));
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(kBlock, kBlock),
                        B = Eigen::MatrixXd::Random(kBlock, kBlock);
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(kBlock, kBlock);
  for (auto _ : state)
  {
    for (int i = 0; i < products; ++i)
      ekf::addProduct(1, ekf::ReadOnly::of(A), ekf::ReadOnly::of(B), C.data(), C.outerStride(),
                      false);
    benchmark::DoNotOptimize(C.data());
  }
}
BENCHMARK(arithmeticFloor)->ArgName("landmarks")->Arg(1600)->Unit(benchmark::kMicrosecond);

/// The same sightings, without the target, for MRPT's filter.
void mrptKalman(benchmark::State& state)
{
  Field field(static_cast<int>(state.range(0)));
  ::mrpt::slam::CRangeBearingKFSLAM2D slam;
  slam.setVerbosityLevel(::mrpt::system::LVL_ERROR);
  slam.KF_options.verbosity_level = ::mrpt::system::LVL_ERROR;
  slam.options.std_sensor_range = 0.1f;
  slam.options.std_sensor_yaw = 0.01f;
  slam.KF_options.method = ::mrpt::bayes::kfEKFNaive;
  const auto feed = [&](const core::Step& step)
  {
    auto action = std::make_shared<::mrpt::obs::CActionCollection>();
    ::mrpt::obs::CActionRobotMovement2D motion;
    ::mrpt::obs::CActionRobotMovement2D::TMotionModelOptions options;
    motion.computeFromOdometry(::mrpt::poses::CPose2D(step.odometry->mean), options);
    action->insert(motion);
    auto frame = std::make_shared<::mrpt::obs::CSensoryFrame>();
    auto o = ::mrpt::obs::CObservationBearingRange::Create();
    o->maxSensorDistance = 1000;
    o->fieldOfView_yaw = 6.3f;
    for (const auto& s : step.landmarks->sightings)
    {
      ::mrpt::obs::CObservationBearingRange::TMeasurement m;
      m.range = static_cast<float>(s.range);
      m.yaw = static_cast<float>(s.bearing);
      m.pitch = 0;
      m.landmarkID = s.id;
      o->sensedData.push_back(m);
    }
    frame->insert(o);
    auto asAction = action;
    auto asFrame = frame;
    slam.processActionObservation(asAction, asFrame);
  };
  feed(field.scan(static_cast<int>(state.range(0))));
  feed(field.scan(kSeen));
  for (auto _ : state)
  {
    state.PauseTiming();
    const core::Step step = field.scan(kSeen);
    state.ResumeTiming();
    feed(step);
  }
}
BENCHMARK(mrptKalman)
    ->ArgName("landmarks")
    ->Arg(100)
    ->Arg(200)
    ->Arg(400)
    ->Unit(benchmark::kMicrosecond)
    ->Iterations(2)
    ->Repetitions(3);

/// Prints as Google Benchmark does, of repetitions only the medians; then the ratios.
class Reporter : public benchmark::ConsoleReporter
{
 public:
  Reporter() : ConsoleReporter(OO_Tabular) {}  // no colour codes in a log
  void ReportRuns(const std::vector<Run>& runs) override
  {
    std::vector<Run> shown;
    for (const Run& run : runs)
    {
      if (run.run_type == Run::RT_Aggregate && run.aggregate_name != "median") continue;
      shown.push_back(run);
      // "plain/landmarks:100/iterations:2" and the like
      std::string name = run.run_name.function_name + "/" + run.run_name.args;
      medians_[name] = run.GetAdjustedCPUTime();
    }
    ConsoleReporter::ReportRuns(shown);
  }
  void Finalize() override
  {
    ConsoleReporter::Finalize();
    auto& out = GetOutputStream();
    char line[200];
    const double memory = medians_["memoryFloor/landmarks:1600"];
    const double arithmetic = medians_["arithmeticFloor/landmarks:1600"];
    const double plainStep = medians_["plain/landmarks:1600"];
    std::snprintf(
        line, sizeof line,
        "\n1600 landmarks: plain %.1f ms, memory floor %.1f ms, arithmetic floor %.1f ms; "
        "plain / larger floor %.2f\n",
        plainStep / 1e3, memory / 1e3, arithmetic / 1e3, plainStep / std::max(memory, arithmetic));
    out << line;
    std::snprintf(line, sizeof line, "fusion / plain %.2f (%.1f ms), compressed fusion %.3f ms\n",
                  medians_["fuse/landmarks:1600/local:0"] / plainStep,
                  medians_["fuse/landmarks:1600/local:0"] / 1e3,
                  medians_["fuse/landmarks:1600/local:17"] / 1e3);
    out << line;
    std::snprintf(
        line, sizeof line, "compressed, some 60 local: %.3f ms of 1600, %.3f ms of 10000\n",
        medians_["compressed/landmarks:1600"] / 1e3, medians_["compressed/landmarks:10000"] / 1e3);
    out << line;
    for (const char* n : {"100", "200", "400"})
    {
      const std::string of = std::string("/landmarks:") + n;
      std::snprintf(line, sizeof line, "%s landmarks: MRPT / plain %.0f (%.1f ms, %.3f ms)\n", n,
                    medians_["mrptKalman" + of] / medians_["plain" + of],
                    medians_["mrptKalman" + of] / 1e3, medians_["plain" + of] / 1e3);
      out << line;
    }
  }

 private:
  std::map<std::string, double> medians_;
};
}  // namespace

int main(int argc, char** argv)
{
  char repetitions[] = "--benchmark_repetitions=7",
       shuffled[] = "--benchmark_enable_random_interleaving=true";
  char shortly[] = "--benchmark_min_time=0.1",
       medians[] = "--benchmark_report_aggregates_only=true";
  std::vector<char*> args{argv[0], repetitions, shuffled, shortly, medians};
  args.insert(args.end(), argv + 1, argv + argc);  // the caller's come last and win
  int n = static_cast<int>(args.size());
  benchmark::Initialize(&n, args.data());
  if (benchmark::ReportUnrecognizedArguments(n, args.data())) return 1;
  filters::registerAll();
  Reporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
}
