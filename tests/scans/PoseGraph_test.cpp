#include <gtest/gtest.h>
#include <slamot/scans/PoseGraph.h>

#include "LoopVotes.h"
#include "reach.h"

namespace slamot::scans
{
namespace
{
Gaussian<Pose2D> increment(double x, double y, double phi, double position = 0.1,
                           double heading = 0.05)
{
  Gaussian<Pose2D> out;
  out.mean = {x, y, phi};
  out.cov = Vector3(position * position, position * position, heading * heading).asDiagonal();
  return out;
}

void expectNear(const Pose2D& a, const Pose2D& b, double tolerance)
{
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(math::wrapToPi(a.phi - b.phi), 0, tolerance);
}

/// A square of 4 m driven twice in steps of 1 m, by increments that are off by `bias`.
PoseGraph squareTwice(double bias)
{
  PoseGraph graph(Pose2D(1, 2, 0.3));
  for (int i = 0; i < 32; ++i)
  {
    const double turn = i % 4 == 3 ? math::kPi / 2 : 0;
    const auto step = increment(1 + bias, bias, turn + bias);
    const std::size_t last = graph.poses().size() - 1;
    graph.relate({last, graph.add(math::compose(graph.pose(last), step.mean)), step});
  }
  return graph;
}

TEST(PoseGraph, MeetsOnALineWhereWeightsSay)
{
  PoseGraph graph(Pose2D(0, 0, 0));
  graph.add({1, 0, 0});
  graph.relate({0, 1, increment(1, 0, 0, 0.1)});
  graph.relate({0, 1, increment(2, 0, 0, 0.2)});
  graph.optimise();
  expectNear(graph.pose(1), {1.2, 0, 0}, 1e-9);  // (1/0.01 + 2/0.04) / (1/0.01 + 1/0.04)
  EXPECT_NEAR(graph.covariance(1)(0, 0), 1 / (1 / 0.01 + 1 / 0.04), 1e-12);
}

TEST(PoseGraph, IsAsUncertainAsOdometryWithoutLoops)
{
  const PoseGraph graph = squareTwice(0);
  Gaussian<Pose2D> sum{graph.pose(0), Matrix3::Zero()};
  for (const Relation& r : graph.relations()) sum = math::compose(sum, r.pose_from_to);
  expectNear(graph.poses().back(), sum.mean, 1e-9);
  EXPECT_LT((graph.covariance(32) - sum.cov).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PoseGraph, LoopsStraightenTheDrive)
{
  PoseGraph graph = squareTwice(0.02);
  EXPECT_GT(math::between(graph.pose(0), graph.pose(16)).norm(), 0.8);
  const std::size_t before = graph.relations().size();
  for (std::size_t i = 0; i <= 16; ++i)
    graph.relate({i, i + 16, increment(0, 0, 0, 0.02, 0.01), true});
  graph.optimise(before);
  graph.optimise();
  for (const Relation& r : graph.relations()) EXPECT_EQ(graph.trust(r), 1);
  expectNear(math::between(graph.pose(0), graph.pose(16)), {0, 0, 0}, 0.05);
  expectNear(math::between(graph.pose(0), graph.pose(8)), {4, 4, math::kPi}, 0.2);
}

TEST(PoseGraph, AWrongLoopLosesItsSay)
{
  PoseGraph graph = squareTwice(0.005);
  const std::size_t before = graph.relations().size();
  for (std::size_t i = 0; i <= 16; i += 2)
    graph.relate({i, i + 16, increment(0, 0, 0, 0.02, 0.01), true});
  graph.optimise(before);
  graph.optimise();
  const auto good = graph.poses();
  const Relation wrong{3, 30, increment(0, 0, 0, 0.02, 0.01), true};  // 4 m apart in truth
  const std::size_t all = graph.relations().size();
  graph.relate(wrong);
  graph.optimise(all);
  graph.optimise();
  EXPECT_LT(graph.trust(wrong), 0.1);
  for (std::size_t i = 0; i < good.size(); ++i) expectNear(graph.pose(i), good[i], 0.1);
  graph.restore(all, good);
  EXPECT_EQ(graph.relations().size(), all);
  expectNear(graph.poses().back(), good.back(), 0);
}

TEST(ReachFrom, IsTheChainsSumWithoutLoops)
{
  const PoseGraph graph = squareTwice(0);
  const auto reach = reachFrom(graph, 5);
  Gaussian<Pose2D> there{{}, Matrix3::Zero()};
  for (std::size_t i = 5; i < 20; ++i)
    there = math::compose(there, graph.relations()[i].pose_from_to);
  expectNear(reach[20].mean, there.mean, 1e-9);
  EXPECT_LT((reach[20].cov - there.cov).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(reach[5].cov, Matrix3::Zero());
  // Backwards along the chain: as the chain from there, turned round.
  const auto back = inverse(reachFrom(graph, 2)[5]);
  expectNear(reach[2].mean, back.mean, 1e-9);
  EXPECT_LT((reach[2].cov - back.cov).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ReachFrom, TakesTheLeastUncertainWay)
{
  PoseGraph graph = squareTwice(0);
  const double before = reachFrom(graph, 0)[17].cov.trace();
  graph.relate({0, 16, increment(0, 0, 0, 0.02, 0.01), true});
  const double after = reachFrom(graph, 0)[17].cov.trace();
  EXPECT_LT(after, 0.1 * before);
  EXPECT_GE(after, graph.covariance(17).trace() * (1 - 1e-9));  // never over-confident
}

TEST(LoopVotes, BelievesWhatThreeSay)
{
  const PoseGraph graph = squareTwice(0);
  LoopVotes votes(3);
  const auto right = [](std::size_t i) { return Relation{i, i + 16, increment(0, 0, 0), true}; };
  EXPECT_TRUE(votes.add(graph, right(0), 16).empty());
  const Relation odd{0, 17, increment(3, 1, 1), true};
  EXPECT_TRUE(votes.add(graph, odd, 17).empty());
  EXPECT_TRUE(votes.add(graph, right(1), 17).empty());
  EXPECT_TRUE(votes.add(graph, right(1), 17).empty());  // of one scan: no new witness
  const auto believed = votes.add(graph, right(2), 18);
  ASSERT_EQ(believed.size(), 4u);
  for (const Relation& r : believed) expectNear(r.pose_from_to.mean, {0, 0, 0}, 0);
  EXPECT_TRUE(votes.add(graph, right(3), 19).empty());  // those that spoke are gone
}

TEST(LoopVotes, ForgetsWhatIsLongAgo)
{
  const PoseGraph graph = squareTwice(0);
  LoopVotes votes(2);
  EXPECT_TRUE(votes.add(graph, {0, 16, increment(0, 0, 0), true}, 16).empty());
  votes.forgetBefore(16.5);
  EXPECT_TRUE(votes.add(graph, {1, 17, increment(0, 0, 0), true}, 17).empty());
  EXPECT_EQ(votes.add(graph, {2, 18, increment(0, 0, 0), true}, 18).size(), 2u);
}
}  // namespace
}  // namespace slamot::scans
