#include "dense.h"
#include "denseKalman.h"

namespace slamot::filters::ekf
{
namespace
{
/// Two robots, one target and landmarks, all correlated.
struct Scene
{
  Belief belief{2, 4};
  math::RandomStream random{7};
  int target = 0;

  Scene()
  {
    target = belief.addTarget();
    belief.set(belief.robot(0), randomMatrix(3, 1, random), randomCov(3, random));
    belief.set(belief.robot(1), randomMatrix(3, 1, random), randomCov(3, random));
    belief.set(belief.target(target), randomMatrix(4, 1, random), randomCov(4, random));
    for (int k = 0; k < 5; ++k) addLandmark(k % 2);
    belief.update({randomRows(belief.robot(0), belief.target(target), random),
                   randomRows(belief.robot(1), belief.target(target), random)});
  }
  int addLandmark(int robot)
  {
    const Gaussian<Point2D> place{{random.normal(), random.normal()}, randomCov(2, random)};
    return belief.addLandmark(belief.robot(robot), place, randomMatrix(2, 3, random));
  }
};

double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
  return (a - b).cwiseAbs().maxCoeff();
}
}  // namespace

TEST(Belief, UpdateIsTheKalmanFilters)
{
  Scene s;
  const Eigen::MatrixXd P = dense(s.belief.P());
  const Eigen::VectorXd x = s.belief.x();
  const int n = s.belief.P().size();
  std::vector<SightingRows> rows;
  for (int k = 0; k < 5; ++k)
    rows.push_back(randomRows(s.belief.robot(k < 3 ? 0 : 1), s.belief.landmark(k), s.random));
  rows.push_back(randomRows(s.belief.robot(1), s.belief.target(s.target), s.random));
  rows.push_back(randomRows(s.belief.robot(0), s.belief.robot(1), s.random));

  const Eigen::MatrixXd H = denseRows(rows, n);
  Eigen::VectorXd nu(H.rows()), R(H.rows());
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    nu.segment<2>(static_cast<Eigen::Index>(2 * k)) = rows[k].innovation;
    R.segment<2>(static_cast<Eigen::Index>(2 * k)) = rows[k].variance;
  }
  const test::DenseUpdate expected(P, H, R.asDiagonal(), nu);
  s.belief.update(rows);
  EXPECT_LT(distance(dense(s.belief.P()), expected.cov), 1e-12);
  EXPECT_LT(distance(s.belief.x(), x + test::times(expected.gain, nu)), 1e-12);
}

TEST(Belief, LawWithoutOutliersIsTheKalmanFilters)
{
  const models::NoiseLaw normal({0, models::NoiseLaw::Tail::kStudent, 3, 2});
  Scene plain, lawful;
  std::vector<SightingRows> rows;
  for (int k = 0; k < 4; ++k)
    rows.push_back(randomRows(plain.belief.robot(0), plain.belief.landmark(k), plain.random));
  const double expected = plain.belief.update(rows);
  for (SightingRows& r : rows) r.law = &normal;
  EXPECT_NEAR(lawful.belief.update(rows), expected, 1e-9);
  EXPECT_LT(distance(dense(lawful.belief.P()), dense(plain.belief.P())), 1e-11);
  EXPECT_LT(distance(lawful.belief.x(), plain.belief.x()), 1e-11);
}

// Of two Gaussians each, the first sighting's posterior has four: by hand, for one sighting.
TEST(Belief, GlintIsTheMixtureOfItsUpdates)
{
  const models::NoiseLaw law({0.4, models::NoiseLaw::Tail::kGaussian, 4, 2});
  Scene s;
  const Eigen::MatrixXd P = dense(s.belief.P());
  const Eigen::VectorXd x = s.belief.x();
  SightingRows row = randomRows(s.belief.robot(0), s.belief.landmark(1), s.random);
  row.law = &law;
  const Eigen::MatrixXd H = denseRows({row}, s.belief.P().size());
  double total = 0;
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(x.size());
  Eigen::MatrixXd second = Eigen::MatrixXd::Zero(x.size(), x.size());
  for (const auto& g : law.components())
  {
    const Eigen::Matrix2d R = (g.factor * row.variance).asDiagonal();
    const test::DenseUpdate one(P, H, R, row.innovation);
    const double p = g.weight * std::exp(one.logDensity);
    const Eigen::VectorXd d = test::times(one.gain, row.innovation);
    total += p;
    mean += p * d;
    second += p * (one.cov + test::times(d, d.transpose()));
  }
  mean /= total;
  EXPECT_NEAR(s.belief.update({row}), std::log(total), 1e-10);
  EXPECT_LT(distance(s.belief.x(), x + mean), 1e-11);
  EXPECT_LT(distance(dense(s.belief.P()), second / total - test::times(mean, mean.transpose())),
            1e-11);
}

TEST(Belief, MoveIsLinearInTheMovedCoordinates)
{
  Scene s;
  const Eigen::MatrixXd P = dense(s.belief.P());
  const int j = s.belief.target(s.target);
  const Eigen::MatrixXd F = randomMatrix(4, 4, s.random), Q = randomCov(4, s.random);
  const Eigen::VectorXd mean = randomMatrix(4, 1, s.random);
  s.belief.move(j, mean, F, Q);
  Eigen::MatrixXd T = Eigen::MatrixXd::Identity(P.rows(), P.rows());
  T.block<4, 4>(j, j) = F;
  Eigen::MatrixXd expected = test::transformed(T, P);
  expected.block<4, 4>(j, j) += Q;
  EXPECT_LT(distance(dense(s.belief.P()), expected), 1e-12);
  EXPECT_LT(distance(s.belief.x().segment<4>(j), mean), 1e-15);
}

TEST(Belief, ANewLandmarkIsCorrelatedThroughItsRobot)
{
  Scene s;
  const Eigen::MatrixXd P = dense(s.belief.P());
  const Eigen::Matrix<double, 2, 3> J = randomMatrix(2, 3, s.random);
  const Gaussian<Point2D> place{{3, 4}, randomCov(2, s.random)};
  const int slot = s.belief.addLandmark(s.belief.robot(1), place, J);
  const int n = static_cast<int>(P.rows()), j = s.belief.landmark(slot);
  ASSERT_EQ(j, n);
  const Eigen::MatrixXd now = dense(s.belief.P());
  const Eigen::MatrixXd across = J * P.middleRows<3>(s.belief.robot(1));
  EXPECT_LT(distance(now.topLeftCorner(n, n), P), 1e-15);
  EXPECT_LT(distance(now.bottomLeftCorner(2, n), across), 1e-13);
  EXPECT_LT(distance(now.bottomRightCorner<2, 2>(),
                     across.middleCols<3>(s.belief.robot(1)) * J.transpose() + place.cov),
            1e-13);
  EXPECT_EQ(s.belief.x()[j], 3);
  EXPECT_EQ(s.belief.x()[j + 1], 4);
}

TEST(Belief, TargetsComeAndGoWithoutAChangeOfTheRest)
{
  Scene s;
  const int l = s.belief.landmark(2);
  const Matrix2 before = s.belief.P().block<2, 2>(l, l);
  const double correlation = s.belief.P()(l, 1);
  std::vector<int> slots;
  for (int k = 0; k < 6; ++k) slots.push_back(s.belief.addTarget());
  for (const int slot : slots)
    s.belief.set(s.belief.target(slot), Eigen::VectorXd::Ones(4), Eigen::MatrixXd::Identity(4, 4));
  s.belief.removeTarget(slots[3]);
  const int now = s.belief.landmark(2);
  EXPECT_GT(now, l);
  EXPECT_EQ(s.belief.P()(now, 1), correlation);
  EXPECT_EQ(distance(s.belief.P().block<2, 2>(now, now), before), 0);
  EXPECT_EQ(s.belief.P()(s.belief.target(slots[3]), s.belief.target(slots[3])), 0);
  EXPECT_EQ(s.belief.addTarget(), slots[3]);
}

TEST(Belief, AFreedLandmarkSlotIsUsedAgain)
{
  Scene s;
  const int n = s.belief.P().size();
  s.belief.removeLandmark(1);
  EXPECT_EQ(s.addLandmark(0), 1);
  EXPECT_EQ(s.belief.P().size(), n);
  EXPECT_GT(math::smallestEigenvalue(dense(s.belief.P())), 0);
}

TEST(Belief, StaysPositiveDefiniteOverManyPreciseUpdates)
{
  Scene s;
  for (int k = 0; k < 2000; ++k)
  {
    SightingRows row = randomRows(s.belief.robot(k % 2), s.belief.landmark(k % 5), s.random);
    row.variance = Vector2(1e-6, 1e-6);
    s.belief.update({row});
    Eigen::MatrixXd Q = 1e-4 * Eigen::MatrixXd::Identity(3, 3);
    s.belief.move(s.belief.robot(k % 2), s.belief.x().segment<3>(s.belief.robot(k % 2)),
                  Eigen::MatrixXd::Identity(3, 3), Q);
  }
  EXPECT_GT(math::smallestEigenvalue(dense(s.belief.P())), -1e-12);
}
}  // namespace slamot::filters::ekf
