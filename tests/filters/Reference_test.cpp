#include "ReferenceFilter.h"
#include "filterRig.h"

#include <slamot/math/random.h>
#include <slamot/math/statistics.h>

namespace slamot::filters
{
namespace
{
using math::RandomStream;
using models::RangeBearing;
using test::ReferenceFilter;

constexpr double kRangeStd = 0.1, kBearingStd = 0.03, kInner = 0.99, kOuter = 0.99999;
constexpr std::size_t kParticles = 25;

struct Case
{
  bool informed, knownIds;
  int resampleAt;  // steps; 0: never
};

/// The filter beside the reference, on a small noisy world with near neighbours and clutter.
class SideBySide
{
 public:
  SideBySide(const Case& c, std::uint64_t seed)
      : case_(c),
        random_{seed, 11},
        reference_({c.informed, c.knownIds, math::chiSquareQuantile(kInner, 2),
                    math::chiSquareQuantile(kOuter, 2), 0.02},
                   kParticles)
  {
    core::FilterContext context;
    context.seed = seed;
    context.starts.time = 0.0;
    context.starts.robot.emplace().value = {1.0, -2.0, 2.0};
    context.starts.robot->std = {0.2, 0.3, 0.1};
    filter_ = test::makeFilter(
        "rbpf-slamot",
        std::string("particles = 25\nnew_density_per_m_rad = 0.02\nconfirm_sightings = 1\n") +
            "proposal = " + (c.informed ? "informed" : "motion") + "\n" +
            "association = " + (c.knownIds ? "known" : "nn") + "\n" +
            "resample_below_ess = " + (c.resampleAt ? "0.6" : "0") + "\n" +
            "target_velocity_std_mps = 1\ntarget_velocity_time_s = 1\n",
        context);
    truth_ = {1.0, -2.0, 2.0};
    for (int i = 0; i < 10; ++i) marks_.push_back({random_.uniform(-6, 6), random_.uniform(-6, 6)});
    if (c.informed)
      reference_.pending.cov = math::poseRotation(-2.0) *
                               Matrix3(Vector3(0.04, 0.09, 0.01).asDiagonal()) *
                               math::poseRotation(2.0);
    for (auto& p : reference_.particles) p.pose = truth_;
    if (!c.informed) takePoses();
  }

  void drive()
  {
    const double v = 1, w = 0.5, dt = 0.1;
    core::Step step;
    step.time = time_ += dt;
    step.odometry = math::turnThenMove(v, w, dt, 0.4, 0.3);
    truth_ = math::compose(
        truth_,
        math::turnThenMove(v + 0.4 * random_.normal(), w + 0.3 * random_.normal(), dt, 0, 0).mean);
    (void)filter_->process(step);
    if (case_.informed)
      reference_.pending = math::compose(reference_.pending, *step.odometry);
    else
      takePoses();
  }

  void scan()
  {
    core::Step step;
    step.time = time_;
    step.landmarks.emplace().sightings = see();
    const auto priors = poses();
    update_ = filter_->process(step);
    if (update_.diagnostics.resampled)
      reference_.scan(*step.landmarks, priors, priors);  // motion: a scan moves no pose
    else
      reference_.scan(*step.landmarks, priors, poses());
    compare();
    if (update_.diagnostics.resampled) followResampling();
  }

  /// Squared lengths of the sampled poses' deviations from the Gaussians they are of.
  [[nodiscard]] double sampleSquares() const
  {
    double sum = 0;
    for (const auto& p : reference_.particles)
    {
      const Pose2D& m = p.belief.mean;
      sum += math::mahalanobisSquared(
          Vector3(p.pose.x - m.x, p.pose.y - m.y, math::wrapToPi(p.pose.phi - m.phi)),
          p.belief.cov);
    }
    return sum;
  }
  [[nodiscard]] int near() const { return reference_.near; }
  [[nodiscard]] int far() const { return reference_.far; }
  [[nodiscard]] bool resampled() const { return update_.diagnostics.resampled; }
  int known = 0, fresh = 0, rejected = 0;  // outcomes over all particles

 private:
  [[nodiscard]] std::vector<Pose2D> poses() const
  {
    std::vector<Pose2D> out;
    for (const auto& p : filter_->particles()) out.push_back(p.pose);
    return out;
  }
  void takePoses()
  {
    const auto now = poses();
    for (std::size_t i = 0; i < now.size(); ++i) reference_.particles[i].pose = now[i];
  }

  std::vector<core::Sighting> see()
  {
    std::vector<core::Sighting> out;
    for (std::size_t i = 0; i < marks_.size(); ++i)
    {
      Vector2 z = RangeBearing::predict(truth_, marks_[i]);
      // Half of them by a coarse range: then many are near in terms of their deviations.
      const double rangeStd = i % 2 ? 4 * kRangeStd : kRangeStd;
      z += Vector2(rangeStd * random_.normal(), kBearingStd * random_.normal());
      if (z[0] < 0.1 || z[0] > 6 || random_.uniform() < 0.2) continue;
      if (case_.knownIds && random_.uniform() < 0.05) z[0] += 3;  // out of every gate
      out.push_back({z[0], math::wrapToPi(z[1]), rangeStd, kBearingStd, id(i)});
    }
    // Never none at all: weights may then be equal, and no particle the best.
    for (int n = random_.poisson(1.0) + out.empty(); n > 0; --n)
      out.push_back({random_.uniform(0.5, 6), random_.uniform(-3, 3), kRangeStd, kBearingStd,
                     case_.knownIds ? 100 + clutter_++ : core::kNoId});
    return out;
  }
  [[nodiscard]] int id(std::size_t i) const
  {
    return case_.knownIds ? static_cast<int>(i) : core::kNoId;
  }

  void compare()
  {
    const auto& particles = reference_.particles;
    double most = -1e300, sum = 0;
    for (const auto& p : particles) most = std::max(most, p.logWeight);
    for (const auto& p : particles) sum += std::exp(p.logWeight - most);
    Gaussian<Pose2D> mean = moments(most, sum);
    const auto& robot = update_.estimate.robot;
    EXPECT_NEAR(robot.mean.x, mean.mean.x, 1e-9);
    EXPECT_NEAR(robot.mean.y, mean.mean.y, 1e-9);
    EXPECT_NEAR(math::wrapToPi(robot.mean.phi - mean.mean.phi), 0, 1e-9);
    EXPECT_LE((robot.cov - mean.cov).norm(), 1e-9);
    for (const auto& p : particles)
      for (const std::int32_t m : p.matches)
        ++(m >= 0 ? known : m == filters::kNew ? fresh : rejected);
    std::size_t best = 0;
    for (std::size_t i = 0; i < particles.size(); ++i)
      if (particles[i].logWeight > particles[best].logWeight) best = i;
    if (!update_.diagnostics.resampled) compareWeights(most + std::log(sum), best);
    compareBest(particles[best]);
  }

  /// Also the best particle, where several are equal but for rounding.
  void compareWeights(double scale, std::size_t& best)
  {
    const auto weighted = filter_->particles();
    best = 0;
    for (std::size_t i = 0; i < weighted.size(); ++i)
    {
      if (weighted[i].weight > weighted[best].weight) best = i;
      if (weighted[i].weight < 1e-200) continue;
      ASSERT_NEAR(std::log(weighted[i].weight), reference_.particles[i].logWeight - scale, 1e-6);
    }
  }

  [[nodiscard]] Gaussian<Pose2D> moments(double most, double sum) const
  {
    const Pose2D o = reference_.particles[0].belief.mean;
    Vector3 first = Vector3::Zero();
    Matrix3 second = Matrix3::Zero();
    for (const auto& p : reference_.particles)
    {
      const double w = std::exp(p.logWeight - most) / sum;
      const Vector3 d(p.belief.mean.x - o.x, p.belief.mean.y - o.y,
                      math::wrapToPi(p.belief.mean.phi - o.phi));
      first += w * d;
      second += w * (d * d.transpose() + p.belief.cov);
    }
    const Pose2D mean{o.x + first[0], o.y + first[1], o.phi + first[2]};
    return {mean, second - first * first.transpose() + reference_.frameCovAt(mean.x, mean.y)};
  }

  void compareBest(const ReferenceFilter::Particle& p)
  {
    using Outcome = core::Pairing::Outcome;
    std::vector<Outcome> outcomes, expected;
    for (const core::Pairing& pair : update_.pairings) outcomes.push_back(pair.outcome);
    for (const std::int32_t m : p.matches)
      expected.push_back(m >= 0               ? Outcome::kKnown
                         : m == filters::kNew ? Outcome::kNew
                                              : Outcome::kRejected);
    EXPECT_EQ(outcomes, expected);
    auto marks = p.map;
    ASSERT_EQ(update_.estimate.landmarks->size(), marks.size());
    update_.estimate.landmarks->visit(
        [&](const core::LandmarkEstimate& l)
        {
          const auto same = [&](const ReferenceFilter::Mark& m)
          {
            return std::hypot(m.x[0] - l.position.mean.x, m.x[1] - l.position.mean.y) < 1e-9 &&
                   (m.P + reference_.frameCovAt(m.x[0], m.x[1]).topLeftCorner<2, 2>() -
                    l.position.cov)
                           .norm() < 1e-9 &&
                   m.sightings == l.sightings;
          };
          const auto it = std::find_if(marks.begin(), marks.end(), same);
          ASSERT_NE(it, marks.end());
          marks.erase(it);
        });
  }

  /// Poses tell which particle each came from.
  void followResampling()
  {
    const auto before = reference_.particles;
    const auto now = filter_->particles();
    for (std::size_t i = 0; i < now.size(); ++i)
    {
      const auto parent = std::find_if(before.begin(), before.end(),
                                       [&](const auto& p) { return p.pose == now[i].pose; });
      ASSERT_NE(parent, before.end());
      reference_.particles[i] = *parent;
      reference_.particles[i].logWeight = 0;
      EXPECT_DOUBLE_EQ(now[i].weight, 1.0 / kParticles);
    }
  }

  Case case_;
  RandomStream random_;
  ReferenceFilter reference_;
  std::unique_ptr<core::Filter> filter_;
  core::Update update_;
  Pose2D truth_;
  std::vector<Point2D> marks_;
  double time_ = 0;
  int clutter_ = 0;
};

class RbpfSlamotReference : public ::testing::TestWithParam<Case>
{
};
}  // namespace

TEST_P(RbpfSlamotReference, EqualsThePlainFilterNumberByNumber)
{
  double squares = 0;
  int samples = 0, resamplings = 0, known = 0, fresh = 0, rejected = 0;
  int near = 0, far = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
  {
    SCOPED_TRACE(seed);
    SideBySide both(GetParam(), seed);
    for (int scan = 0; scan < 15; ++scan)
    {
      both.scan();
      if (HasFailure()) return;
      resamplings += both.resampled();
      if (GetParam().informed && scan > 0)  // the first scan's pose is that of the map's frame
      {
        squares += both.sampleSquares();
        samples += kParticles;
      }
      for (int i = 0; i < 3; ++i) both.drive();
    }
    known += both.known, fresh += both.fresh, rejected += both.rejected;
    near += both.near(), far += both.far();
  }
  // What it is about did happen.
  EXPECT_GT(known, 10000);
  EXPECT_GT(fresh, 1000);
  EXPECT_GT(rejected, 500);
  EXPECT_GT(near, 2000);
  EXPECT_GT(far, 5000);
  EXPECT_EQ(resamplings > 20, GetParam().resampleAt > 0);
  if (samples == 0) return;
  // Informed: poses are drawn from the Gaussian that takes the scan in.
  EXPECT_LT(squares, math::chiSquareQuantile(0.9999, 3 * samples));
  EXPECT_GT(squares, math::chiSquareQuantile(0.0001, 3 * samples));
}

INSTANTIATE_TEST_SUITE_P(Each, RbpfSlamotReference,
                         ::testing::Values(Case{false, true, 0}, Case{false, false, 0},
                                           Case{true, true, 0}, Case{true, false, 0},
                                           Case{false, true, 1}, Case{false, false, 1}));
}  // namespace slamot::filters
