// What one step of the particle filter costs, per particle and landmark sighting, beside the floor:
// a bare loop of 2x2 Kalman updates over arrays.  CPU times; counters in nanoseconds.
#include <slamot/core/FilterRegistry.h>
#include <slamot/filters/RbpfSlamot.h>
#include <slamot/maps/LandmarkMap.h>
#include <slamot/math/random.h>
#include <slamot/models/RangeBearing.h>

#include <benchmark/benchmark.h>

#include <cstdio>

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
  const auto filter = makeFilter(particles, known, informed, static_cast<int>(state.range(1)));
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
BENCHMARK(knownMotion)->ArgNames({"landmarks", "threads"})->Args({100, 1})->Args({10000, 1});
BENCHMARK(knownInformed)->ArgNames({"landmarks", "threads"})->Args({100, 1})->Args({10000, 1});
BENCHMARK(unknownMotion)->ArgNames({"landmarks", "threads"})->Args({100, 1})->Args({10000, 1});
BENCHMARK(unknownInformed)->ArgNames({"landmarks", "threads"})->Args({100, 1})->Args({10000, 1});
BENCHMARK(knownInformed)
    ->ArgNames({"landmarks", "threads"})
    ->Args({100, 1})
    ->Args({100, 2})
    ->UseRealTime()
    ->Name("knownInformed/wall");

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
BENCHMARK(memory)->ArgName("advance")->Arg(5)->Arg(20)->Iterations(1)->Unit(
    benchmark::kMillisecond);
}  // namespace

BENCHMARK_MAIN();
