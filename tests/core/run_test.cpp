#include <gtest/gtest.h>
#include <slamot/core/Error.h>
#include <slamot/core/run.h>

#include <string>

namespace slamot::core
{
namespace
{
class Steps : public Source
{
 public:
  explicit Steps(int n) : n_(n) {}
  std::optional<Step> next() override
  {
    if (at_ == throwAt) throw Error(ExitStatus::kTruncated, "log", "ends too early");
    if (at_ == n_) return std::nullopt;
    Step s;
    s.time = ++at_;
    return s;
  }
  [[nodiscard]] double progress() const override { return double(at_) / n_; }
  int throwAt = -1;

 private:
  int n_, at_ = 0;
};

class Clock : public Filter
{
 public:
  Update process(const Step& step) override
  {
    if (step.time == throwAt) throw Error(ExitStatus::kNonsense, "step", "is bad");
    estimate_.time = step.time;
    return {estimate_, {}, {}};
  }
  [[nodiscard]] Estimate estimate() const override { return estimate_; }
  double throwAt = -1;

 private:
  Estimate estimate_;
};

/// Writes down what happens to it.
class Diary : public Sink
{
 public:
  void begin(const Estimate& e) override
  {
    if (refuses) throw Error(ExitStatus::kUnreadable, "sink", "can't begin");
    text += "begin " + std::to_string(int(e.time));
  }
  void accept(const Step& s, const Update& u) override
  {
    EXPECT_EQ(s.time, u.estimate.time);
    text += ", " + std::to_string(int(s.time));
  }
  void finish(bool complete) override { text += complete ? ", complete" : ", incomplete"; }
  std::string text;
  bool refuses = false;
};
}  // namespace

TEST(Run, GivesEveryStepToEverySink)
{
  Steps source(3);
  Clock filter;
  Diary a, b;
  std::vector<double> progress;
  RunOptions options;
  options.onProgress = [&](std::size_t steps, double p)
  { progress.push_back(static_cast<double>(steps) + p); };
  const RunResult r = run(source, filter, {&a, &b}, options);
  EXPECT_EQ(r.steps, 3u);
  EXPECT_FALSE(r.interrupted);
  EXPECT_EQ(a.text, "begin 0, 1, 2, 3, complete");
  EXPECT_EQ(b.text, a.text);
  EXPECT_EQ(progress, (std::vector<double>{1 + 1.0 / 3, 2 + 2.0 / 3, 4}));
}

TEST(Run, OfNothingIsComplete)
{
  Steps source(0);
  Clock filter;
  Diary sink;
  EXPECT_EQ(run(source, filter, {&sink}).steps, 0u);
  EXPECT_EQ(sink.text, "begin 0, complete");
}

TEST(Run, StopsAtAStepsBoundaryAndLeavesSinksIncomplete)
{
  Steps source(5);
  Clock filter;
  Diary sink;
  std::atomic<bool> stop{false};
  RunOptions options;
  options.stop = &stop;
  options.onProgress = [&](std::size_t steps, double) { stop = steps == 2; };
  const RunResult r = run(source, filter, {&sink}, options);
  EXPECT_TRUE(r.interrupted);
  EXPECT_EQ(r.steps, 2u);
  EXPECT_EQ(sink.text, "begin 0, 1, 2, incomplete");
}

TEST(Run, FinishesSinksAsIncompleteWhenTheFilterThrows)
{
  Steps source(5);
  Clock filter;
  filter.throwAt = 3;
  Diary a, b;
  EXPECT_THROW(run(source, filter, {&a, &b}), Error);
  EXPECT_EQ(a.text, "begin 0, 1, 2, incomplete");
  EXPECT_EQ(b.text, a.text);
}

TEST(Run, FinishesSinksAsIncompleteWhenTheInputEndsTooEarly)
{
  Steps source(5);
  source.throwAt = 1;
  Clock filter;
  Diary sink;
  try
  {
    run(source, filter, {&sink});
    FAIL() << "nothing was thrown";
  }
  catch (const Error& e)
  {
    EXPECT_EQ(e.status(), ExitStatus::kTruncated);
  }
  EXPECT_EQ(sink.text, "begin 0, 1, incomplete");
}

TEST(Run, FinishesTheSinksThatBeganWhenAnotherCannot)
{
  Steps source(5);
  Clock filter;
  Diary a, b;
  b.refuses = true;
  EXPECT_THROW(run(source, filter, {&a, &b}), Error);
  EXPECT_EQ(a.text, "begin 0, incomplete");
  EXPECT_EQ(b.text, "");
}
}  // namespace slamot::core
