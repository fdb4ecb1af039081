#include <slamot/math/eigensystem.h>
#include <slamot/math/random.h>
#include <slamot/models/ManoeuvringTarget.h>
#include <slamot/models/PolynomialTarget.h>
#include <slamot/models/stretch.h>

#include <gtest/gtest.h>

namespace slamot::models
{
namespace
{
using Target = ManoeuvringTarget;
using Mode = Target::Mode;
using Vector = Target::Vector;
using Matrix = Target::Matrix;

Target::Params params(std::vector<Mode> modes)
{
  Target::Params p{};
  p.modes = std::move(modes);
  p.modeTime = 2;
  p.velocityStd = 1;
  p.accelerationStd = 0.7;
  p.turnRate = 0.5;
  p.turnRateStd = 0.4;
  p.velocityNoise = 0.05;
  p.headingWalk = 0.1;
  p.accelerationNoise = 0.2;
  p.jerkNoise = 0.3;
  p.turnRateNoise = 0.1;
  return p;
}

const Gaussian<Point2D> kPlace{{1, 2}, (Matrix2() << 0.2, 0.05, 0.05, 0.1).finished()};

/// A blob of two coordinates near the place, seen with deviation 0.3.
struct Seen
{
  Vector2 nu;
  Matrix2 S, H;
  Seen(const Target::State& s, const Vector2& at)
  {
    H << 0.8, 0.6, -0.6, 0.8;
    nu = H * (at - s.x.head<2>());
    S = H * s.P.topLeftCorner<2, 2>() * H.transpose() + 0.09 * Matrix2::Identity();
  }
  void correct(Target::State& s) const { s.correct<2>(nu, S, H, Matrix2::Zero()); }
};

/// Some way through a drive, all modes in play.
Target::State some(const Target& motion, int steps = 6)
{
  Target::State s = motion.birth(kPlace);
  math::RandomStream random{3};
  for (int k = 1; k <= steps; ++k)
  {
    motion.predict(s, 0.2);
    const Vector2 at(1 + 0.3 * k + 0.2 * random.normal(), 2 + 0.1 * k * k + 0.2 * random.normal());
    Seen(s, at).correct(s);
  }
  return s;
}

double weights(const Target::State& s)
{
  double sum = 0;
  for (int j = 0; j < s.modes; ++j) sum += s.bank[static_cast<std::size_t>(j)].weight;
  return sum;
}

const std::vector<Mode> kAll{Mode::kVelocity, Mode::kLeftTurn, Mode::kRightTurn, Mode::kTurn,
                             Mode::kAcceleration};
}  // namespace

TEST(ManoeuvringTarget, OneModeOfConstantVelocityIsThatModel)
{
  auto p = params({Mode::kVelocity});
  p.velocityNoise = p.headingWalk = 0;
  const Target motion(p);
  const ConstantVelocityTarget plain({1.0, 0, 0.2});
  Target::State s = motion.birth(kPlace);
  ConstantVelocityTarget::State t = plain.birth(kPlace);
  for (int k = 0; k < 5; ++k)
  {
    motion.predict(s, 0.3);
    plain.predict(t, 0.3);
    const Seen seen(s, {1.5, 2.5});
    seen.correct(s);
    t.correct<2>(seen.nu, seen.S, seen.H);
    EXPECT_LT((s.x.head<4>() - t.x).norm(), 1e-12);
    EXPECT_LT((s.P.topLeftCorner<4, 4>() - t.P).norm(), 1e-12);
    EXPECT_EQ(s.x.tail<2>().norm(), 0);
  }
}

TEST(ManoeuvringTarget, OneModeOfConstantAccelerationIsThatModel)
{
  auto p = params({Mode::kAcceleration});
  p.velocityNoise = p.headingWalk = 0;
  const Target motion(p);
  const ConstantAccelerationTarget plain({1.0, 0.7, 0.3});
  Target::State s = motion.birth(kPlace);
  ConstantAccelerationTarget::State t = plain.birth(kPlace);
  for (int k = 0; k < 5; ++k)
  {
    motion.predict(s, 0.3);
    plain.predict(t, 0.3);
    const Seen seen(s, {1.5, 2.5});
    seen.correct(s);
    t.correct<2>(seen.nu, seen.S, seen.H);
    EXPECT_LT((s.x - t.x).norm(), 1e-12);
    EXPECT_LT((s.P - t.P).norm(), 1e-12);
  }
}

// Without noise, one mode's covariance goes on by the derivative of its motion.
TEST(ManoeuvringTarget, CovarianceGoesOnByTheDerivative)
{
  for (const Mode mode : kAll)
  {
    auto p = params({mode});
    p.velocityNoise = p.headingWalk = p.accelerationNoise = p.jerkNoise = p.turnRateNoise = 0;
    const Target motion(p);
    Target::State s;
    s.modes = 1;
    s.bank[0].x << 1, 2, 1.5, -0.5, 0.3, 0.8;
    s.bank[0].P = 0.1 * Matrix::Identity();
    s.bank[0].weight = 1;
    s.combine();
    const Target::State start = s;
    motion.predict(s, 0.4);
    Matrix F;
    constexpr double kStep = 1e-6;
    for (int i = 0; i < 6; ++i)
    {
      Target::State up = start, down = start;
      up.bank[0].x[i] += kStep;
      down.bank[0].x[i] -= kStep;
      up.combine();
      down.combine();
      motion.predict(up, 0.4);
      motion.predict(down, 0.4);
      F.col(i) = (up.x - down.x) / (2 * kStep);
    }
    EXPECT_LT((s.P - F * start.P * F.transpose()).norm(), 1e-8)
        << "mode " << static_cast<int>(mode);
  }
}

TEST(ManoeuvringTarget, CoordinatedTurnDrivesACircle)
{
  const Target motion(params({Mode::kTurn}));
  Target::State s;
  s.modes = 1;
  s.bank[0].x << 0, 0, 2, 0, 0, 1;  // 2 m/s at half a radian a second: a circle of 4 m
  s.bank[0].P = 1e-6 * Matrix::Identity();
  s.bank[0].weight = 1;
  s.combine();
  for (int k = 0; k < 10; ++k) motion.predict(s, 0.1);
  EXPECT_NEAR(s.x[0], 4 * std::sin(0.5), 3e-3);  // the least speed that it divides by shows
  EXPECT_NEAR(s.x[1], 4 * (1 - std::cos(0.5)), 3e-3);
  EXPECT_NEAR(std::hypot(s.x[2], s.x[3]), 2, 1e-9);
}

TEST(ManoeuvringTarget, CorrectionHasTheMomentsOfItsModels)
{
  const Target motion(params(kAll));
  Target::State s = some(motion);
  const Seen seen(s, s.x.head<2>() + Vector2(0.4, -0.3));
  double total = 0;
  Vector mean = Vector::Zero();
  Matrix second = Matrix::Zero();
  for (int j = 0; j < s.modes; ++j)
  {
    const Target::Member& m = s.bank[static_cast<std::size_t>(j)];
    Eigen::Matrix<double, 2, 6> H = Eigen::Matrix<double, 2, 6>::Zero();
    H.leftCols<2>() = seen.H;
    const Vector2 nu = seen.nu - H * (m.x - s.x);
    const Matrix2 S = H * m.P * H.transpose() + 0.09 * Matrix2::Identity();
    const Eigen::Matrix<double, 6, 2> K = m.P * H.transpose() * S.inverse();
    const double p =
        m.weight * std::exp(-0.5 * nu.dot(S.inverse() * nu)) / std::sqrt(S.determinant());
    const Vector x = m.x + K * nu;
    total += p;
    mean += p * x;
    second += p * (m.P - K * S * K.transpose() + x * x.transpose());
  }
  mean /= total;
  seen.correct(s);
  EXPECT_LT((s.x - mean).norm(), 1e-10);
  EXPECT_LT((s.P - (second / total - mean * mean.transpose())).norm(), 1e-9);
  EXPECT_NEAR(weights(s), 1, 1e-12);
}

TEST(ManoeuvringTarget, TransitionGivesTheWholesCovariance)
{
  const Target motion(params(kAll));
  Target::State s = some(motion);
  const Matrix before = s.P;
  auto t = motion.move(s, 0.2);
  Matrix P = before;
  t.applyTo(P);
  EXPECT_LT((P - s.P).norm(), 1e-9 * P.norm());
  EXPECT_GE(math::eigensystem<6>(t.Q).values[0], -1e-12);
}

TEST(ManoeuvringTarget, BankFollowsWhatOthersDoToTheWhole)
{
  const Target motion(params(kAll));
  Target::State s = some(motion);
  const Vector shift = Vector::LinSpaced(0.1, -0.2);
  s.x += shift;
  s.P = (1.3 * s.P + 0.01 * Matrix::Identity()).eval();
  const Target::State wanted = s;
  s.conform();
  s.combine();
  EXPECT_LT((s.x - wanted.x).norm(), 1e-9);
  EXPECT_LT((s.P - wanted.P).norm(), 1e-8);
}

// As from a log that tells a start without deviations.
TEST(ManoeuvringTarget, StartThatIsKnownExactlyStaysFinite)
{
  using Start = core::ObjectStart;
  Start told;
  for (const auto& [field, value] :
       {std::pair{Start::kX, 5.0}, {Start::kY, 0.5}, {Start::kVx, 1.0}, {Start::kVy, 0.0}})
    told.value[field] = value;
  for (const auto& modes :
       {kAll, std::vector{Mode::kVelocity}, std::vector{Mode::kVelocity, Mode::kAcceleration}})
  {
    const Target motion(params(modes));
    Target::State s = motion.start(told);
    EXPECT_EQ(s.P.topLeftCorner(4, 4).norm(), 0);
    for (int k = 0; k < 3; ++k)
    {
      const auto t = motion.move(s, 0.1);
      EXPECT_TRUE(t.F.allFinite() && t.Q.allFinite() && s.x.allFinite() && s.P.allFinite());
    }
    EXPECT_NEAR(s.x[0], 5.3, 1e-3);
    EXPECT_GE(math::eigensystem<6>(s.P).values[0], -1e-12);
  }
  const Stretch<4> none = stretch<4>(Eigen::Matrix4d::Zero(), Eigen::Matrix4d::Zero(), true);
  EXPECT_TRUE(none.T.allFinite() && none.left.isZero());
}

TEST(ManoeuvringTarget, StretchLeadsFromOneCovarianceToTheOther)
{
  math::RandomStream random{5};
  const auto cov = [&](int rank)
  {
    Matrix A = Matrix::Zero();
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < rank; ++j) A(i, j) = random.normal();
    return Matrix(A * A.transpose());
  };
  for (int k = 0; k < 40; ++k)
  {
    const Matrix from = cov(k % 2 ? 6 : 4), to = cov(6);
    for (const bool shrinkOnly : {false, true})
    {
      const Stretch<6> by = stretch<6>(from, to, shrinkOnly);
      EXPECT_LT((by.T * from * by.T.transpose() + by.left - to).norm(), 1e-6 * to.norm());
      EXPECT_GT(math::eigensystem<6>(by.left).values[0], -1e-9 * to.norm());
    }
  }
}

TEST(ManoeuvringTarget, AnotherFrameOfTheMapRotatesIt)
{
  const Target motion(params(kAll));
  const double angle = 0.7;
  Matrix2 R;
  R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  Matrix all = Matrix::Zero();
  for (int i = 0; i < 6; i += 2) all.block<2, 2>(i, i) = R;
  Target::State a = motion.birth(kPlace);
  const Vector2 there = R * Vector2(kPlace.mean.x, kPlace.mean.y);
  Target::State b = motion.birth({{there[0], there[1]}, R * kPlace.cov * R.transpose()});
  for (int k = 1; k < 12; ++k)
  {
    motion.predict(a, 0.2);
    motion.predict(b, 0.2);
    const Vector2 at(1 + 0.3 * k, 2 + 0.05 * k * k);
    Seen seenA(a, at), seenB(b, R * at);
    seenB.H = seenA.H * R.transpose();
    seenB.S =
        seenB.H * b.P.topLeftCorner<2, 2>() * seenB.H.transpose() + 0.09 * Matrix2::Identity();
    seenB.nu = seenB.H * (R * at - b.x.head<2>());
    seenA.correct(a);
    seenB.correct(b);
    if (k % 3 == 0)  // and after somebody else's change
    {
      a.P *= 1.1;
      b.P *= 1.1;
    }
  }
  EXPECT_LT((b.x - all * a.x).norm(), 1e-8);
  EXPECT_LT((b.P - all * a.P * all.transpose()).norm(), 1e-8);
}

// A target that turns left is soon thought to.
TEST(ManoeuvringTarget, TellsATurnFromAStraightWay)
{
  auto p = params({Mode::kVelocity, Mode::kLeftTurn, Mode::kRightTurn});
  p.modeTime = 4;
  const Target motion(p);
  Target::State s = motion.birth(kPlace);
  double x = 1, y = 2, phi = 0;
  for (int k = 0; k < 40; ++k)
  {
    phi += 0.5 * 0.1;
    x += 0.2 * std::cos(phi);
    y += 0.2 * std::sin(phi);
    motion.predict(s, 0.1);
    const Matrix2 H = Matrix2::Identity();
    const Vector2 nu = Vector2(x, y) - s.x.head<2>();
    s.correct<2>(nu, s.P.topLeftCorner<2, 2>() + 0.0025 * H, H, Matrix2::Zero());
  }
  EXPECT_GT(s.bank[1].weight, 0.8);
  EXPECT_NEAR(std::atan2(s.x[3], s.x[2]), math::wrapToPi(phi), 0.1);
}
}  // namespace slamot::models
