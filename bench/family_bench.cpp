// What a scan of five sightings costs per particle in each member of the FastSLAM family, among
// 100 and 10 000 landmarks and by number of particles.  One thread, CPU times, medians of shuffled
// repetitions, as in rbpf-bench; a summary at the end has the ratios.
#include <slamot/core/FilterRegistry.h>
#include <slamot/filters/registerAll.h>
#include <slamot/math/random.h>
#include <slamot/models/RangeBearing.h>

#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>

namespace
{
using namespace slamot;

constexpr double kReach = 30, kSpacing = 16.8;  // [m]: five landmarks in the half plane in front

/// A square lattice of landmarks and a robot that sees those before it.
class Lattice
{
 public:
  explicit Lattice(int landmarks) : edge_(static_cast<int>(std::lround(std::sqrt(landmarks)))) {}

  [[nodiscard]] double size() const { return kSpacing * (edge_ - 1); }
  /// What the robot sees after it went to a place with a good odometer.
  core::Step scanAt(double x, double y, double odometerStd)
  {
    core::Step step;
    step.time = 0.2 * ++steps_;
    step.odometry = math::turnThenMove(0, 0, 0.1, odometerStd, 0.1 * odometerStd);
    step.odometry->mean = {x - robot_.x, y - robot_.y, 0};
    robot_ = {x, y, 0};
    auto& scan = step.landmarks.emplace();
    scan.fov = {0, kReach, -math::kPi / 2, math::kPi / 2};
    math::RandomStream random{1, static_cast<std::uint64_t>(steps_)};
    const int last = static_cast<int>((x + kReach) / kSpacing);
    for (int i = std::max(0, static_cast<int>(x / kSpacing)); i <= std::min(edge_ - 1, last); ++i)
      for (int j = 0; j < edge_; ++j)
      {
        const auto z = models::RangeBearing::predict(robot_, Point2D(kSpacing * i, kSpacing * j));
        if (scan.fov.contains(z[0], z[1]))
          scan.sightings.push_back({z[0] + 0.1 * random.normal(), z[1] + 0.0175 * random.normal(),
                                    0.1, 0.0175, core::kNoId});
      }
    return step;
  }

 private:
  int edge_, steps_ = 0;
  Pose2D robot_;
};

std::unique_ptr<core::Filter> makeFilter(const std::string& name, int particles)
{
  filters::registerAll();
  core::Config config = core::Config::parse("[" + name + "]\n", "bench");
  config.set(name, "particles", std::to_string(particles));
  if (name == "gmphd-ufastslam") config.set(name, "detection_probability", "0.98");
  core::FilterContext context;
  context.threads = 1;
  return core::FilterRegistry::instance().make(name, config, context);
}

void scan(benchmark::State& state, const char* name)
{
  const int particles = static_cast<int>(state.range(1));
  Lattice lattice(static_cast<int>(state.range(0)));
  const auto filter = makeFilter(name, particles);
  for (int turn = 0; turn < 2; ++turn)
    for (double x = -1; x < lattice.size(); x += kSpacing)
      for (double y = 0; y <= lattice.size(); y += kSpacing)
        filter->process(lattice.scanAt(x, y + 8, 1e-3));
  double sightings = 0;
  for (auto _ : state)
  {
    state.PauseTiming();
    const core::Step step =
        lattice.scanAt(0.5 * lattice.size() + 3, 0.5 * lattice.size() + 8, 0.02);
    sightings += static_cast<double>(step.landmarks->sightings.size());
    state.ResumeTiming();
    benchmark::DoNotOptimize(filter->process(step));
  }
  state.counters["sightings"] = sightings / static_cast<double>(state.iterations());
  state.counters["us_per_particle"] =
      benchmark::Counter(1e-6 * static_cast<double>(state.iterations()) * particles,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

class Summary : public benchmark::ConsoleReporter
{
 public:
  Summary() : ConsoleReporter(OO_Tabular) {}  // no colour codes in a log
  void ReportRuns(const std::vector<Run>& runs) override
  {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs)
      if (run.aggregate_name == "median")
        us_[run.run_name.function_name + "/" + run.run_name.args] =
            run.counters.at("us_per_particle");
  }
  void print()
  {
    for (const char* name : {"fastslam1", "fastslam2", "ufastslam", "gmphd-ufastslam"})
    {
      const auto us = [&](int landmarks, int particles)
      {
        return us_[std::string(name) + "/landmarks:" + std::to_string(landmarks) +
                   "/particles:" + std::to_string(particles)];
      };
      std::printf(
          "%s: %.2f us a particle and scan; 10 000 landmarks / 100: %.2f; a particle of 1000"
          " / of 100: %.2f\n",
          name, us(100, 100), us(10000, 100) / us(100, 100), us(100, 1000) / us(100, 100));
    }
  }

 private:
  std::map<std::string, double> us_;
};
}  // namespace

int main(int argc, char** argv)
{
  for (const char* name : {"fastslam1", "fastslam2", "ufastslam", "gmphd-ufastslam"})
    benchmark::RegisterBenchmark(name, scan, name)
        ->ArgNames({"landmarks", "particles"})
        ->Args({100, 100})
        ->Args({100, 1000})
        ->Args({10000, 100})
        ->Iterations(30)
        ->Repetitions(5)
        ->ReportAggregatesOnly();
  benchmark::Initialize(&argc, argv);
  Summary summary;
  benchmark::RunSpecifiedBenchmarks(&summary);
  std::printf("\n");
  summary.print();
}
