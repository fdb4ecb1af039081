// What one step of the particle filter costs, per particle and landmark sighting, beside the floor:
// a bare loop of 2x2 Kalman updates over arrays.  CPU times; counters in nanoseconds.  Repetitions
// of all benchmarks are shuffled and their medians taken, so that a machine that is slower for a
// minute does not tell for or against one of them; a summary at the end has the ratios.
#include <slamot/core/FilterRegistry.h>
#include <slamot/filters/RbpfSlamot.h>
#include <slamot/maps/LandmarkMap.h>
#include <slamot/math/random.h>
#include <slamot/models/RangeBearing.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>

namespace
{
using namespace slamot;

/// A field of landmarks, as dense whatever its size, in tiles of 20 that a robot in their middle
/// sees.
class Field
{
 public:
  static constexpr int kInView = 20;

  explicit Field(int landmarks)
  {
    const int tiles = landmarks / kInView, edge = static_cast<int>(std::ceil(std::sqrt(tiles)));
    for (int tile = 0; tile < tiles; ++tile)
      for (int i = 0; i < kInView; ++i)
      {
        const int row = tile / edge, column = row % 2 ? edge - 1 - tile % edge : tile % edge;
        points_.push_back({kSpacing * (5 * column + i / 4), kSpacing * (4 * row + i % 4)});
      }
  }

  /// A scan of landmarks [from, from + kInView) from the middle of where they are, after a drive
  /// there with an odometer of given quality.
  core::Step scan(int from, bool known, double odometerStd = 0.02)
  {
    const int end = std::min<int>(from + kInView, size());
    Pose2D middle{0.9, 0.4, 0};  // aside from all landmarks
    for (int i = from; i < end; ++i)
    {
      middle.x += points_[static_cast<std::size_t>(i)].x / (end - from);
      middle.y += points_[static_cast<std::size_t>(i)].y / (end - from);
    }
    core::Step step;
    step.time = 0.1 * ++steps_;
    step.odometry = math::turnThenMove(0, 0, 0.1, odometerStd, 0.5 * odometerStd);
    step.odometry->mean = {middle.x - robot_.x, middle.y - robot_.y, 0};
    robot_ = middle;
    step.landmarks.emplace();
    math::RandomStream random{1, static_cast<std::uint64_t>(steps_)};
    for (int i = from; i < end; ++i)
    {
      const auto z = models::RangeBearing::predict(robot_, points_[static_cast<std::size_t>(i)]);
      step.landmarks->sightings.push_back({z[0] + 0.1 * random.normal(),
                                           z[1] + 0.01 * random.normal(), 0.1, 0.01,
                                           known ? i : core::kNoId});
    }
    return step;
  }
  [[nodiscard]] int size() const { return static_cast<int>(points_.size()); }

 private:
  static constexpr double kSpacing = 4.0;  // [m]
  int steps_ = 0;
  Pose2D robot_;
  std::vector<Point2D> points_;
};

std::unique_ptr<core::Filter> makeFilter(int particles, bool known, bool informed, int threads)
{
  core::Config config = core::Config::parse("[rbpf-slamot]\n", "bench");
  const auto set = [&](const char* key, const std::string& value)
  { config.set("rbpf-slamot", key, value); };
  set("particles", std::to_string(particles));
  set("association", known ? "known" : "nn");
  set("proposal", informed ? "informed" : "motion");
  set("target_velocity_std_mps", "1");
  set("target_velocity_time_s", "1");
  core::FilterContext context;
  context.threads = threads;
  core::Params params(config, "rbpf-slamot");
  return std::make_unique<filters::RbpfSlamot>(params, context);
}

/// A drive past all landmarks to the first ones, half of each scan seen before, with a good
/// odometer: else the particles' maps drift apart over kilometres, and a step's time would tell of
/// that too.
void fillMap(core::Filter& filter, Field& field, bool known)
{
  for (int from = field.size() - Field::kInView; from >= 0; from -= Field::kInView / 2)
    filter.process(field.scan(from, known, 1e-3));
}

void step(benchmark::State& state, bool known, bool informed)
{
  const int particles = 1000;
  Field field(static_cast<int>(state.range(0)));
  const auto filter = makeFilter(particles, known, informed, 1);
  fillMap(*filter, field, known);
  for (auto _ : state)
  {
    state.PauseTiming();
    const core::Step scan = field.scan(0, known);
    state.ResumeTiming();
    benchmark::DoNotOptimize(filter->process(scan));
  }
  state.counters["per_particle_and_sighting"] =
      benchmark::Counter(double(state.iterations()) * particles * Field::kInView,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
void knownMotion(benchmark::State& s)
{
  step(s, true, false);
}
void knownInformed(benchmark::State& s)
{
  step(s, true, true);
}
void unknownMotion(benchmark::State& s)
{
  step(s, false, false);
}
void unknownInformed(benchmark::State& s)
{
  step(s, false, true);
}
BENCHMARK(knownMotion)->ArgName("landmarks")->Arg(100)->Arg(10000);
BENCHMARK(knownInformed)->ArgName("landmarks")->Arg(100)->Arg(10000);
BENCHMARK(unknownMotion)->ArgName("landmarks")->Arg(100)->Arg(10000);
BENCHMARK(unknownInformed)->ArgName("landmarks")->Arg(100)->Arg(10000);

double median(std::vector<double> v)
{
  const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
  std::nth_element(v.begin(), middle, v.end());
  return *middle;
}

/// Wall time of a step on one thread over that on two, taken in turns: the machine's other work
/// then weighs on both alike.
void twoThreads(benchmark::State& state)
{
  using Clock = std::chrono::steady_clock;
  Field fields[2] = {Field(100), Field(100)};
  std::unique_ptr<core::Filter> filters[2];
  for (int k = 0; k < 2; ++k)
  {
    filters[k] = makeFilter(1000, true, true, k + 1);
    fillMap(*filters[k], fields[k], true);
  }
  std::vector<double> seconds[2];
  for (auto _ : state)
    for (int k = 0; k < 2; ++k)
    {
      const core::Step scan = fields[k].scan(0, true);
      const auto start = Clock::now();
      benchmark::DoNotOptimize(filters[k]->process(scan));
      seconds[k].push_back(std::chrono::duration<double>(Clock::now() - start).count());
    }
  state.counters["speedup"] = median(seconds[0]) / median(seconds[1]);
}
BENCHMARK(twoThreads)->UseRealTime();

/// The floor: 2x2 Kalman updates with given innovation and Jacobian, arrays of numbers, no map.
void bareUpdates(benchmark::State& state)
{
  constexpr std::size_t n = 20000;  // 1000 particles by 20 sightings
  std::vector<double> x(n, 1), y(n, 2), xx(n, 0.01), xy(n, 0.001), yy(n, 0.02), weight(n / 20, 0);
  for (auto _ : state)
  {
    for (std::size_t i = 0; i < n; ++i)
    {
      const double q = x[i] * x[i] + y[i] * y[i], r = std::sqrt(q), ir = 1 / r;
      const double h11 = x[i] * ir, h12 = y[i] * ir, h21 = -h12 * ir, h22 = h11 * ir;
      const double a1 = xx[i] * h11 + xy[i] * h12, a2 = xy[i] * h11 + yy[i] * h12;
      const double b1 = xx[i] * h21 + xy[i] * h22, b2 = xy[i] * h21 + yy[i] * h22;
      const double s11 = h11 * a1 + h12 * a2 + 0.01, s12 = h21 * a1 + h22 * a2,
                   s22 = h21 * b1 + h22 * b2 + 1e-4;
      const double det = s11 * s22 - s12 * s12, id = 1 / det;
      const double nr = 2.236 - r, nb = 1.107 - std::atan2(y[i], x[i]);
      const double k11 = (a1 * s22 - b1 * s12) * id, k12 = (b1 * s11 - a1 * s12) * id;
      const double k21 = (a2 * s22 - b2 * s12) * id, k22 = (b2 * s11 - a2 * s12) * id;
      weight[i / 20] -=
          0.5 * ((s22 * nr * nr - 2 * s12 * nr * nb + s11 * nb * nb) * id + std::log(det));
      x[i] += k11 * nr + k12 * nb;
      y[i] += k21 * nr + k22 * nb;
      // The covariance is put back up, or after many rounds nothing would be left to update.
      xx[i] = 0.5 * (xx[i] - k11 * a1 - k12 * b1) + 0.005;
      xy[i] = xy[i] - k11 * a2 - k12 * b2;
      yy[i] = 0.5 * (yy[i] - k21 * a2 - k22 * b2) + 0.01;
    }
    benchmark::DoNotOptimize(weight.data());
    benchmark::ClobberMemory();
  }
  state.counters["per_particle_and_sighting"] = benchmark::Counter(
      double(state.iterations()) * n, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(bareUpdates);

void resample(benchmark::State& state)
{
  const auto n = static_cast<std::size_t>(state.range(0));
  maps::LandmarkPool pool;
  // The same substitution as the filter's, with maps of so many landmarks.
  std::vector<maps::LandmarkMap> maps(n);
  for (auto& m : maps)
  {
    m.detach(pool.newToken());
    for (std::uint32_t slot = 0; slot < state.range(1); ++slot) m.modify(pool, 0, slot).x = slot;
  }
  math::RandomStream random{1};
  for (auto _ : state)
  {
    std::vector<maps::LandmarkMap> next(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      next[i] = maps[random() % n];
      next[i].detach(pool.newToken());
      next[i].modify(pool, 0, static_cast<std::uint32_t>(i % state.range(1))).y += 1;
    }
    maps = std::move(next);
    if (maps::LandmarkCollector::isDue(pool))
    {
      maps::LandmarkCollector collector(pool);
      for (const auto& m : maps) collector.mark(m);
      collector.sweep();
    }
  }
}
BENCHMARK(resample)
    ->ArgNames({"particles", "landmarks"})
    ->Args({1000, 1000})
    ->Unit(benchmark::kMicrosecond);

/// 1000 particles and 10 000 landmarks: the maps' memory in MB, live nodes and what waits to be
/// collected.  A scan sees 20, the next ones `advance` others: 5 is a drive that sees each for four
/// scans; 20 sees each once, so that there is nothing to tell particles by and no map is shared.
void memory(benchmark::State& state)
{
  const int advance = static_cast<int>(state.range(0));
  double most = 0;
  for (auto _ : state)
  {
    Field field(10000);
    const auto filter = makeFilter(1000, true, true, 1);
    const auto& maps = dynamic_cast<const filters::RbpfSlamot&>(*filter);
    for (int from = 0; from < field.size(); from += advance)
    {
      filter->process(field.scan(from, true));
      most = std::max(most, static_cast<double>(maps.mapBytes()));
    }
  }
  state.counters["maps_MB"] = most / 1e6;
}
BENCHMARK(memory)->ArgName("advance")->Arg(5)->Arg(20)->Iterations(1)->Repetitions(1)->Unit(
    benchmark::kMillisecond);

/// Prints as Google Benchmark does, of repetitions only the medians; then those beside the floor.
class Reporter : public benchmark::ConsoleReporter
{
 public:
  Reporter() : ConsoleReporter(OO_Tabular) {}  // no colour codes in a log
  void ReportRuns(const std::vector<Run>& runs) override
  {
    std::vector<Run> shown;
    for (const Run& run : runs)
    {
      const bool aggregate = run.run_type == Run::RT_Aggregate;
      if (aggregate && run.aggregate_name != "median") continue;
      shown.push_back(run);
      if (aggregate)
        for (const auto& [name, counter] : run.counters) medians_[run.run_name.str()] = counter;
    }
    ConsoleReporter::ReportRuns(shown);
  }
  void Finalize() override
  {
    ConsoleReporter::Finalize();
    const auto floor = medians_.find("bareUpdates");
    if (floor == medians_.end()) return;
    auto& out = GetOutputStream();
    char line[160];
    out << "\nCPU of a step, per particle and sighting    100 landmarks    x floor    10 000 / "
           "100\n";
    for (const char* name : {"knownMotion", "knownInformed", "unknownMotion", "unknownInformed"})
    {
      const auto few = medians_.find(name + std::string("/landmarks:100"));
      const auto many = medians_.find(name + std::string("/landmarks:10000"));
      if (few == medians_.end() || many == medians_.end()) continue;
      std::snprintf(line, sizeof line, "%-40s %12.0f ns %10.1f %15.2f\n", name, 1e9 * few->second,
                    few->second / floor->second, many->second / few->second);
      out << line;
    }
    std::snprintf(line, sizeof line, "%-40s %12.0f ns\n", "bare 2x2 updates: the floor",
                  1e9 * floor->second);
    out << line;
  }

 private:
  std::map<std::string, double> medians_;
};
}  // namespace

int main(int argc, char** argv)
{
  char repetitions[] = "--benchmark_repetitions=11",
       shuffled[] = "--benchmark_enable_random_interleaving=true";
  char shortly[] = "--benchmark_min_time=0.05",
       medians[] = "--benchmark_report_aggregates_only=true";
  std::vector<char*> args{argv[0], repetitions, shuffled, shortly, medians};
  args.insert(args.end(), argv + 1, argv + argc);  // the caller's come last and win
  int n = static_cast<int>(args.size());
  benchmark::Initialize(&n, args.data());
  if (benchmark::ReportUnrecognizedArguments(n, args.data())) return 1;
  Reporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
}
