// GOSPA and OSPA of 100 points against 100.  10 000 of these must take less than 10 s.

#include <benchmark/benchmark.h>
#include <slamot/eval/Gospa.h>
#include <slamot/math/random.h>

namespace
{
using slamot::Point2D;

constexpr int kPoints = 100;
constexpr int kEvaluations = 10'000;
constexpr double kCutoff = 5;  // [m]

struct Sets
{
  std::vector<Point2D> estimates, truths;
};

/// Over a square of some side; estimates either near the truth, or anywhere.
std::vector<Sets> makeSets(double side, bool near)
{
  slamot::math::RandomStream random{1};
  std::vector<Sets> out(100);
  for (Sets& sets : out)
    for (int i = 0; i < kPoints; ++i)
    {
      const double x = random.uniform(0, side), y = random.uniform(0, side);
      sets.truths.emplace_back(x, y);
      if (near)
        sets.estimates.emplace_back(x + 0.3 * random.normal(), y + 0.3 * random.normal());
      else
        sets.estimates.emplace_back(random.uniform(0, side), random.uniform(0, side));
    }
  return out;
}

void evaluate(benchmark::State& state)
{
  const auto sets = makeSets(static_cast<double>(state.range(0)), state.range(1) != 0);
  for (auto _ : state)
    for (int i = 0; i < kEvaluations; ++i)
    {
      const Sets& s = sets[static_cast<std::size_t>(i) % sets.size()];
      benchmark::DoNotOptimize(slamot::eval::gospa(s.estimates, s.truths, kCutoff).ospa);
    }
  state.SetLabel("10 000 evaluations, 100 against 100 points");
}
// 3 m: all points within the cut-off of each other, the most work that there is.
BENCHMARK(evaluate)
    ->ArgNames({"side_m", "near"})
    ->ArgsProduct({{3, 20, 200}, {1, 0}})
    ->Iterations(1)
    ->Repetitions(3)
    ->ReportAggregatesOnly()
    ->Unit(benchmark::kSecond);
}  // namespace

BENCHMARK_MAIN();
