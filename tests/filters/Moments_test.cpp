#include "sighting/Moments.h"

#include <gtest/gtest.h>
#include <slamot/math/random.h>

namespace slamot::filters
{
namespace
{
using math::RandomStream;

struct Part
{
  double weight;
  Pose2D mean;
  Matrix3 cov;
};

std::vector<Part> draw(RandomStream& random, std::size_t n, double spread)
{
  std::vector<Part> parts(n);
  for (Part& p : parts)
  {
    p.weight = random.uniform() < 0.2 ? 0 : random.uniform();
    p.mean = {100 + spread * random.normal(), -50 + spread * random.normal(),
              math::wrapToPi(3.1 + 0.1 * spread * random.normal())};
    Matrix3 A;
    for (double& a : A.reshaped()) a = random.normal();
    p.cov = 0.1 * A * A.transpose();
  }
  parts[0].weight = 0.5;
  return parts;
}

Gaussian<Pose2D> moments(const std::vector<Part>& parts)
{
  PoseMoments m;
  for (const Part& p : parts) m.add(p.weight, p.mean, p.cov);
  return m.gaussian();
}
}  // namespace

TEST(PoseMoments, EqualTheirDefinition)
{
  RandomStream random{1};
  for (int trial = 0; trial < 100; ++trial)
  {
    const auto parts = draw(random, 1 + trial % 30, 1.0);
    const auto got = moments(parts);
    double sum = 0;
    Vector3 mean = Vector3::Zero();
    const auto offset = [&](const Part& p, const Vector3& from)
    {
      return Vector3(p.mean.x - 100 - from[0], p.mean.y + 50 - from[1],
                     math::wrapToPi(p.mean.phi - 3.1 - from[2]));
    };
    for (const Part& p : parts) sum += p.weight, mean += p.weight * offset(p, Vector3::Zero());
    mean /= sum;
    Matrix3 cov = Matrix3::Zero();
    for (const Part& p : parts)
      cov += p.weight / sum * (p.cov + offset(p, mean) * offset(p, mean).transpose());
    EXPECT_NEAR(got.mean.x - 100, mean[0], 1e-11);
    EXPECT_NEAR(got.mean.y + 50, mean[1], 1e-11);
    EXPECT_NEAR(math::wrapToPi(got.mean.phi - 3.1 - mean[2]), 0, 1e-11);
    EXPECT_TRUE(got.cov.isApprox(cov, 1e-9));
  }
}

// All the weight on one of many far apart: the rest is rounding, but never below zero.
TEST(PoseMoments, OfOneHeavyParticleAreNeverNegative)
{
  RandomStream random{2};
  for (const double light : {1e-12, 1e-17, 1e-40, 1e-300})
    for (std::size_t heavy = 0; heavy < 20; ++heavy)
    {
      auto parts = draw(random, 20, 1.0);
      for (std::size_t i = 0; i < 20; ++i)
      {
        parts[i].weight = i == heavy ? 1 : light;
        parts[i].cov.setZero();
      }
      const auto g = moments(parts);
      EXPECT_NEAR(g.mean.x, parts[heavy].mean.x, 1e-9);
      EXPECT_GE(math::smallestEigenvalue(g.cov), -1e-14 * g.cov.trace());
      EXPECT_GE(g.cov.diagonal().minCoeff(), 0);
    }
}
}  // namespace slamot::filters
