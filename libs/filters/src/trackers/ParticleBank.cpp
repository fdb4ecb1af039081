#include "ParticleBank.h"

#include "LogDensity.h"
#include "resampling.h"

#include <mrpt/random/RandomGenerators.h>

namespace slamot::filters::trackers
{
namespace
{
/// L of L Lᵀ = [a b; b c], also singular.
struct Root
{
  double l11, l21, l22;
  Root(double a, double b, double c)
      : l11(std::sqrt(std::max(0.0, a))),
        l21(l11 > 0 ? b / l11 : 0),
        l22(std::sqrt(std::max(0.0, c - l21 * l21)))
  {
  }
};
}  // namespace

ParticleBank::Options ParticleBank::Options::from(core::Params& p)
{
  Options o{};
  o.particles = p.integer("particles", 1, 1'000'000, 300);
  o.weightExponent = p.inRange("weight_exponent", 0, 1, 1.0);
  o.resampling = resamplingFrom(p, o.particles);
  return o;
}

ParticleBank::ParticleBank(const Options& options, const Motion& motion,
                           const core::FilterContext& context)
    : options_(options), motion_(motion), seed_(context.seed), workers_(context.threads)
{
  // Another map frame thus gives the same samples, rotated.
  axes_ = math::poseRotation(context.starts.robotPose().mean.phi).topLeftCorner<2, 2>();
  diagnostics_.particles = options.particles;
}

Cloud& ParticleBank::add()
{
  clouds_.push_back(std::make_unique<Cloud>(static_cast<std::size_t>(options_.particles)));
  clouds_.back()->key = born_++;
  return *clouds_.back();
}

void ParticleBank::predict(double dt)
{
  ++step_;
  diagnostics_ = {};
  diagnostics_.particles = options_.particles;
  if (dt <= 0 || clouds_.empty()) return;
  const auto Q = motion_.kinematicTransition({}, dt).Q;
  const Root root(Q(0, 0), Q(0, 2), Q(2, 2));  // of one axis; the other has the same
  for (auto& cloud : clouds_)
    workers_.forEach(cloud->size(),
                     [&](std::size_t i, int)
                     {
                       math::RandomStream random = stream(kMoveStream, *cloud, i);
                       const double a = random.normal(), b = random.normal();
                       const Vector2 first = axes_ * Vector2(a, b);
                       Sample& s = (*cloud)[i];
                       s.x += dt * s.vx + root.l11 * first.x();
                       s.y += dt * s.vy + root.l11 * first.y();
                       s.vx += root.l21 * first.x();
                       s.vy += root.l21 * first.y();
                       if (!(root.l22 > 1e-6 * root.l21)) return;
                       const double c = random.normal(), d = random.normal();
                       const Vector2 second = root.l22 * axes_ * Vector2(c, d);
                       s.vx += second.x();
                       s.vy += second.y();
                     });
  for (auto& cloud : clouds_) cloud->settle();
}

void ParticleBank::start(const core::ObjectStart& told)
{
  const Motion::State state = motion_.start(told);
  const auto draw = [&](const Matrix2& mapCov, math::RandomStream& random) -> Vector2
  {
    const Matrix2 cov = axes_.transpose() * mapCov * axes_;
    const Root l(cov(0, 0), cov(0, 1), cov(1, 1));
    const double a = random.normal(), b = random.normal();
    return axes_ * Vector2(l.l11 * a, l.l21 * a + l.l22 * b);
  };
  Cloud& cloud = add();
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    math::RandomStream random = stream(kStartStream, cloud, i);
    const Vector2 place = draw(state.P.topLeftCorner<2, 2>(), random);
    const Vector2 velocity = draw(state.P.bottomRightCorner<2, 2>(), random);
    cloud[i] = {state.x[0] + place.x(), state.x[1] + place.y(), state.x[2] + velocity.x(),
                state.x[3] + velocity.y()};
  }
  cloud.settle();
}

void ParticleBank::birth(const Eye& eye, const Seen& z)
{
  const double velocityStd = std::sqrt(motion_.birth({}).P(2, 2));
  Cloud& cloud = add();
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    math::RandomStream random = stream(kStartStream, cloud, i);
    const double a = random.normal(), b = random.normal(), c = random.normal(), d = random.normal();
    // The first observation may be an outlier too.
    const double wide = z.ray.law ? std::sqrt(z.ray.law->drawFactor(random)) : 1.0;
    const double along = z.ray.range + wide * std::sqrt(z.ray.varRange) * a;
    const double across = wide * std::sqrt(z.ray.varBearing) * b;
    const double turn = z.isPlace ? 0 : across, left = z.isPlace ? across : 0;
    const double angle = eye.phi + z.ray.bearing + turn;
    const double cosA = std::cos(angle), sinA = std::sin(angle);
    const Vector2 velocity = velocityStd * axes_ * Vector2(c, d);
    cloud[i] = {eye.x + along * cosA - left * sinA, eye.y + along * sinA + left * cosA,
                velocity.x(), velocity.y()};
  }
  cloud.settle();
}

void ParticleBank::drop(std::size_t target)
{
  clouds_.erase(clouds_.begin() + static_cast<std::ptrdiff_t>(target));
}

void ParticleBank::take(std::size_t target, const Eye& eye, const Seen& z)
{
  Cloud& cloud = *clouds_[target];
  cloud.weigh = [&] { weigh(cloud, eye, z); };
  cloud.resampled = false;
  // MRPT resamples with its thread's own generator: seeded here, it depends on our seed alone.
  math::RandomStream random = stream(kResampleStream, cloud, 0);
  ::mrpt::random::getRandomGenerator().randomize(static_cast<std::uint32_t>(random() >> 32));
  ::mrpt::bayes::CParticleFilter filter;
  filter.m_options = options_.resampling;
  filter.setVerbosityLevel(::mrpt::system::LVL_ERROR);
  filter.executeOn(cloud, nullptr, nullptr, nullptr);
  diagnostics_.resampled = diagnostics_.resampled || cloud.resampled;
}

void ParticleBank::weigh(Cloud& cloud, const Eye& eye, const Seen& z)
{
  const LogDensity logDensity(z);
  workers_.forEach(cloud.size(),
                   [&](std::size_t i, int)
                   {
                     const Vector2 nu = residual(eye, z, cloud[i]);
                     double& w = cloud.logWeight(i);
                     w = options_.weightExponent * w + logDensity(nu[0], nu[1]);
                   });
  cloud.normalizeWeights();  // the largest becomes 1
  cloud.settle();
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i)
  {
    const double w = std::exp(cloud.logWeight(i));
    sum += w;
    squares += w * w;
  }
  // Of several targets the worst is told.
  diagnostics_.ess = std::min(sum * sum / squares, diagnostics_.ess.value_or(1e300));
  diagnostics_.largestWeight = std::max(1 / sum, diagnostics_.largestWeight.value_or(0));
}

bool ParticleBank::innovate(std::size_t target, const Eye& eye, const Seen& z, Innovation& o) const
{
  return innovateSeen(eye, z, clouds_[target]->belief, o);
}

core::TargetEstimate ParticleBank::estimate(std::size_t target, const Track& track) const
{
  TargetMoments<Motion> moments;
  moments.add(1.0, clouds_[target]->belief);
  return moments.estimate(track);
}
}  // namespace slamot::filters::trackers
