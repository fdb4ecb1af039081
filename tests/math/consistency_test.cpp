// Exact recursions of error covariances, without sampling: in a linear world the true covariance of
// all agents' errors together follows from the gains that they use.
#include <gtest/gtest.h>
#include <slamot/math/intersection.h>
#include <slamot/math/random.h>

#include <ostream>

#include "Dense.h"

namespace slamot::math
{
namespace
{
using Eigen::VectorXd;

enum class TeamRule
{
  kNone,
  kCi,
  kSplitCi,
  kIci,
  kPaper
};

struct TeamPlan
{
  TeamRule rule;
  int agents, every;
  std::optional<double> omega;
};

std::ostream& operator<<(std::ostream& out, const TeamPlan& p)
{
  return out << "rule " << int(p.rule) << " agents " << p.agents << " every " << p.every
             << " omega " << p.omega.value_or(-1);
}

Dense byPose(double dx, double dy)
{
  Dense F(2, 3);
  F << 1, 0, -dy, 0, 1, dx;
  return F;
}

// Each agent estimates its own robot (x, y, heading), a target (x, y, vx, vy) and landmarks, in one
// world: one target, moved by one process noise.  All begin with the same knowledge of the target.
class LinearTeam
{
 public:
  explicit LinearTeam(const TeamPlan& plan) : plan_(plan), truth_(zeros(size(), size()))
  {
    Dense P = 400.0 * identity(kState);
    P.topLeftCorner(3, 3) = diagonal({0.01, 0.01, 1e-4});
    P.block(kTarget, kTarget, 4, 4) = diagonal({4, 4, 0.3, 0.3});
    claimed_.assign(plan.agents, P);
    for (int i = 0; i < plan.agents; ++i)
      for (int k = 0; k < plan.agents; ++k)
      {
        Dense common = zeros(kState, kState);
        common.block(kTarget, kTarget, 4, 4) = P.block(kTarget, kTarget, 4, 4);
        setTruth(i, k, i == k ? P : common);
      }
  }

  // The largest ratio at any time; `fused` counts the messages taken in.
  double run(int steps)
  {
    for (int t = 0; t < steps; ++t)
    {
      predict();
      for (int i = 0; i < plan_.agents; ++i) observe(i, t);
      check();
      if (plan_.rule == TeamRule::kNone || t % plan_.every) continue;
      exchange(t);
      check();
    }
    return worst_;
  }
  [[nodiscard]] int fused() const { return fused_; }

 private:
  static constexpr int kTarget = 3, kMap = 7, kLandmarks = 4, kState = kMap + 2 * kLandmarks;

  [[nodiscard]] int size() const { return kState * plan_.agents; }
  [[nodiscard]] Dense truth(int i, int k) const
  {
    return truth_.block(kState * i, kState * k, kState, kState);
  }
  void setTruth(int i, int k, const Dense& P)
  {
    truth_.block(kState * i, kState * k, kState, kState) = P;
  }

  void check()
  {
    for (int i = 0; i < plan_.agents; ++i)
      worst_ = std::max(worst_, largestRatio(truth(i, i), claimed_[i]));
  }

  void predict()
  {
    Dense F = identity(kState), common = zeros(kState, kState), own = common;
    F(3, 5) = F(4, 6) = 1;
    F(0, 2) = 0.5;
    common.block(kTarget, kTarget, 4, 4) = diagonal({0.01, 0.01, 0.02, 0.02});
    own.topLeftCorner(3, 3) = diagonal({0.01, 0.02, 1e-4});
    for (int i = 0; i < plan_.agents; ++i)
    {
      for (int k = 0; k < plan_.agents; ++k)
        setTruth(i, k, F * truth(i, k) * F.transpose() + (i == k ? common + own : common));
      claimed_[i] = F * claimed_[i] * F.transpose() + common + own;
    }
  }

  // A landmark, another one each step, and every third step the target.
  void observe(int i, int t)
  {
    correct(i, kMap + 2 * ((t + i) % kLandmarks), 3 - t % 7, i - 2.0 + t % 5);
    if ((t + i) % 3 == 0) correct(i, kTarget, 4 - t % 3, 2.0 * i - 1);
  }
  void correct(int i, int place, double dx, double dy)
  {
    Dense H = zeros(2, kState);
    H.leftCols(3) = -byPose(dx, dy);
    H.block(0, place, 2, 2).setIdentity();
    const Dense R = diagonal({0.04, 0.09});
    Dense& P = claimed_[i];
    const Dense K = P * H.transpose() * (H * P * H.transpose() + R).inverse();
    const Dense rest = identity(kState) - K * H;
    for (int k = 0; k < plan_.agents; ++k)
    {
      if (k == i) continue;
      setTruth(i, k, rest * truth(i, k));
      setTruth(k, i, truth(i, k).transpose());
    }
    setTruth(i, i, rest * truth(i, i) * rest.transpose() + K * R * K.transpose());
    P -= K * H * P;
    P = 0.5 * (P + P.transpose());
  }

  // All tell all at once what they know before: the place where they see the other, and the target.
  void exchange(int t)
  {
    const std::vector<Dense> before = claimed_;
    Dense M = identity(size()), noise = zeros(size(), size());
    for (int i = 0; i < plan_.agents; ++i)
      for (int k = 0; k < plan_.agents; ++k)
      {
        if (i == k) continue;
        Dense F = zeros(6, kState), H = F, own = zeros(6, 6);
        F.topLeftCorner(2, 3) = byPose(5 + i - k, 3 - t % 6);
        F.block(2, kTarget, 4, 4).setIdentity();
        own.topLeftCorner(2, 2) = diagonal({0.05, 0.15});
        const Dense K = take(i, F * before[k] * F.transpose() + own, own);
        H.topLeftCorner(2, 2).setIdentity();
        H.block(2, kTarget, 4, 4).setIdentity();
        const Dense rest = identity(kState) - K * H;
        auto rows = M.middleRows(kState * i, kState);
        rows = rest * Dense(rows);
        rows.middleCols(kState * k, kState) += K * F;
        auto own_i = noise.block(kState * i, kState * i, kState, kState);
        own_i = rest * Dense(own_i) * rest.transpose() + K * own * K.transpose();
      }
    truth_ = M * truth_ * M.transpose() + noise;
  }

  // Changes agent i's claimed covariance; returns the gain.
  Dense take(int i, const Dense& B, const Dense& own)
  {
    if (plan_.rule == TeamRule::kPaper) return takePaper(i, B);
    const Intersection rule = plan_.rule == TeamRule::kCi        ? Intersection::kCovariance
                              : plan_.rule == TeamRule::kSplitCi ? Intersection::kSplit
                                                                 : Intersection::kInverse;
    Dense& P = claimed_[i];
    Dense W(kState, 6), A(6, 6), E = identity(kState);
    W << P.leftCols(2), P.middleCols(kTarget, 4);
    A << W.topRows(2), W.middleRows(kTarget, 4);
    E(2, 2) = 5;                                        // [m]: the heading's lever
    E.block(kTarget + 2, kTarget + 2, 2, 2).setZero();  // velocities don't count
    const IntersectionCriterion criterion{(E * P * E).trace(), W.transpose() * E * E * W};
    IntersectionUpdate u;
    Dense K(kState, 6);
    for (int c = 0; c < 6; ++c)  // the gain is linear in the innovation
    {
      u = intersect(rule, A, VectorXd::Unit(6, c), B, own, criterion, plan_.omega);
      K.col(c) = W * Dense(u.gain);
    }
    fused_ += u.pays;
    P = u.scale * (P - W * Dense(u.reduction) * W.transpose());
    return K;
  }

  Dense takePaper(int i, const Dense& B)
  {
    Dense& P = claimed_[i];
    Dense K = zeros(kState, 6);
    const int first[] = {0, kTarget}, row[] = {0, 2}, count[] = {2, 4};
    for (int b = 0; b < 2; ++b)
    {
      const int at = first[b], m = count[b];
      const PaperBlock block = paperBlock(P.block(at, at, m, m), VectorXd::Zero(m),
                                          B.block(row[b], row[b], m, m), plan_.omega);
      const Dense cross = block.crossFactor;
      K.block(at, row[b], m, m) = identity(m) - cross;
      P.middleRows(at, m) = cross * Dense(P.middleRows(at, m));
      P.middleCols(at, m) = Dense(P.middleRows(at, m)).transpose();
      P.block(at, at, m, m) = block.cov;
    }
    ++fused_;
    return K;
  }

  TeamPlan plan_;
  std::vector<Dense> claimed_;
  Dense truth_;
  double worst_ = 0;
  int fused_ = 0;
};

std::vector<TeamPlan> plans(TeamRule rule)
{
  std::vector<TeamPlan> out;
  for (const int agents : {2, 3})
    for (const int every : {1, 5, 20})
      for (const std::optional<double>& omega : {std::optional<double>{}, {0.9}, {0.6}})
        out.push_back({rule, agents, every, omega});
  return out;
}
}  // namespace

TEST(LinearTeam, WithoutMessagesClaimsTheTruth)
{
  EXPECT_NEAR(LinearTeam({TeamRule::kNone, 3, 1, {}}).run(200), 1, 1e-9);
}

TEST(LinearTeam, GuaranteedRulesAreNeverTooSure)
{
  for (const TeamRule rule : {TeamRule::kCi, TeamRule::kSplitCi})
    for (const TeamPlan& plan : plans(rule))
    {
      LinearTeam team(plan);
      EXPECT_LE(team.run(150), 1 + 1e-6) << plan;
      EXPECT_GE(team.fused(), 5) << plan;
    }
}

// What the other two rules cost: little for inverse covariance intersection, much for the paper's.
TEST(LinearTeam, OtherRulesAreTooSure)
{
  for (const TeamPlan& plan : plans(TeamRule::kIci))
  {
    const double worst = LinearTeam(plan).run(150);
    EXPECT_GT(worst, 1.001) << plan;
    EXPECT_LT(worst, 1.5) << plan;
  }
  for (const TeamPlan& plan : plans(TeamRule::kPaper))
  {
    const double worst = LinearTeam(plan).run(150);
    if (plan.every == 1)
    {
      EXPECT_GT(worst, 1.5) << plan;
    }
    if (!plan.omega)
    {
      EXPECT_GT(worst, plan.every == 20 ? 1.3 : 2.5) << plan;
    }
  }
}

TEST(Intersection, StaysConsistentAtEveryCorrelation)
{
  RandomStream random{1};
  double worstInverse = 0;
  for (int i = 0; i < 3000; ++i)
  {
    const int n = 5, m = 1 + i % n;
    // Errors (e, f + g): e and f share a noise up to the last bit, g is independent.
    const Dense rootP = draw(random, n, n), rootF = draw(random, m, m),
                rootG = 0.5 * draw(random, m, m), H = draw(random, n, n).topRows(m);
    const Dense U = orthonormal(draw(random, n, n));
    const double bound = random.uniform() < 0.5 ? 1 : random.uniform();
    const Dense P = rootP * rootP.transpose(), own = rootG * rootG.transpose();
    const Dense B = rootF * rootF.transpose() + own;
    const Dense cross = bound * rootP * Dense(U.leftCols(m)) * rootF.transpose();
    const Dense W = P * H.transpose();
    const IntersectionCriterion criterion{P.trace(), W.transpose() * W};
    for (const Intersection rule :
         {Intersection::kCovariance, Intersection::kSplit, Intersection::kInverse})
    {
      const std::optional<double> omega =
          i % 2 ? std::optional<double>(random.uniform(0.05, 0.95)) : std::nullopt;
      IntersectionUpdate u;
      Dense K(n, m);
      for (int c = 0; c < m; ++c)
      {
        u = intersect(rule, H * W, VectorXd::Unit(m, c), B, own, criterion, omega);
        K.col(c) = W * Dense(u.gain);
      }
      const Dense M = identity(n) - K * H, mixed = M * cross * K.transpose();
      const Dense truth = M * P * M.transpose() + K * B * K.transpose() + mixed + mixed.transpose();
      const double r = largestRatio(truth, u.scale * (P - W * Dense(u.reduction) * W.transpose()));
      if (rule == Intersection::kInverse)
        worstInverse = std::max(worstInverse, r);
      else
        ASSERT_LE(r, 1 + 1e-6) << "case " << i << " rule " << int(rule);
    }
  }
  EXPECT_GT(worstInverse, 1.5);  // it is not guaranteed
}
}  // namespace slamot::math
