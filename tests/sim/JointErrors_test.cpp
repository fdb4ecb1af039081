#include <gtest/gtest.h>
#include <slamot/math/gaussian.h>
#include <slamot/math/random.h>

#include "JointErrors.h"
#include "denseKalman.h"

namespace slamot::sim
{
namespace
{
using Matrix = Eigen::MatrixXd;

Matrix randomMatrix(math::RandomStream& random, int rows, int columns)
{
  Matrix out(rows, columns);
  for (double& v : out.reshaped()) v = random.normal();
  return out;
}

Matrix randomCovariance(math::RandomStream& random, int n)
{
  const Matrix L = randomMatrix(random, n, n);
  return test::transformed(L, Matrix::Identity(n, n)) + 0.1 * Matrix::Identity(n, n);
}

Eigen::VectorXd randomVector(math::RandomStream& random, int n)
{
  return randomMatrix(random, n, 1);
}

/// The information about all states at all times, from what is said of each.
class Batch
{
 public:
  explicit Batch(int size)
      : information_(Matrix::Zero(size, size)), vector_(Eigen::VectorXd::Zero(size))
  {
  }

  /// Of the errors: a sum of jacobian times part is a draw of a noise.
  void say(const std::vector<JointErrors::Part>& parts, const Matrix& noiseCovariance,
           const Eigen::VectorXd& noise)
  {
    Matrix H = Matrix::Zero(noise.size(), information_.rows());
    for (const auto& p : parts) H.middleCols(p.at, p.jacobian.cols()) += p.jacobian;
    const Matrix weight = test::inverse(noiseCovariance);
    information_ += test::transformed(H.transpose(), weight);
    vector_ += test::times(H.transpose(), test::times(weight, noise));
  }
  [[nodiscard]] Matrix covariance() const { return test::inverse(information_); }
  [[nodiscard]] Eigen::VectorXd errors() const { return test::times(covariance(), vector_); }

 private:
  Matrix information_;
  Eigen::VectorXd vector_;
};
}  // namespace

// Pose, move, landmark seen first, seen again, all with the matrices of no special kind: what is
// left of the recursion must be what the inverse of the whole information says.
TEST(JointErrors, OfTwoStepsAndALandmarkIsTheInverseOfTheWholeInformation)
{
  math::RandomStream random{1};
  for (int trial = 0; trial < 20; ++trial)
  {
    const Matrix P0 = randomCovariance(random, 3), Q = randomCovariance(random, 3);
    const Matrix F = randomMatrix(random, 3, 3), I3 = Matrix::Identity(3, 3);
    const Matrix Hx = randomMatrix(random, 2, 3), Hm = randomMatrix(random, 2, 2);
    const Matrix Gx = randomMatrix(random, 2, 3), Gm = randomMatrix(random, 2, 2);
    const Eigen::Vector2d r0(0.3, 0.7), r1(0.2, 0.5);
    const Matrix R0 = r0.asDiagonal(), R1 = r1.asDiagonal();

    const auto e0 = randomVector(random, 3), w = randomVector(random, 3);
    const auto n0 = randomVector(random, 2), n1 = randomVector(random, 2);

    JointErrors recursion;
    const int pose = recursion.add(P0, e0);
    const Matrix inverse = test::inverse(Hm);
    const int landmark =
        recursion.addFrom({{pose, -test::times(inverse, Hx)}}, test::transformed(inverse, R0),
                          test::times(inverse, n0));
    recursion.move(pose, F, Q, w);
    recursion.observe({{{{pose, Gx}, {landmark, Gm}}, r1, n1}});

    Batch batch(8);  // pose at 0, pose at 1, landmark
    batch.say({{0, I3}}, P0, e0);
    batch.say({{0, Hx}, {6, Hm}}, R0, n0);
    batch.say({{3, I3}, {0, -F}}, Q, -w);
    batch.say({{3, Gx}, {6, Gm}}, R1, n1);
    const Matrix expected = batch.covariance();
    const double scale = expected.cwiseAbs().maxCoeff();
    EXPECT_LT((recursion.block(pose, 3) - expected.block(3, 3, 3, 3)).norm(), 1e-10 * scale);
    EXPECT_LT((recursion.block(landmark, 2) - expected.block(6, 6, 2, 2)).norm(), 1e-10 * scale);
    const Eigen::VectorXd errors = batch.errors();
    for (int i = 0; i < 5; ++i)
      EXPECT_NEAR(recursion.error(i), errors[3 + i], 1e-10 * errors.cwiseAbs().maxCoeff());
  }
}

// Many states of other sizes, moved and seen in a mixed order, against plain dense formulas.
TEST(JointErrors, EqualsTheDenseFormulas)
{
  math::RandomStream random{2};
  JointErrors recursion;
  Matrix dense(0, 0);
  std::vector<std::pair<int, int>> states;  // first coordinate, size
  const auto grow = [&](const Matrix& cross, const Matrix& own)
  {
    const Eigen::Index n = dense.rows(), k = own.rows();
    dense.conservativeResize(n + k, n + k);
    dense.bottomLeftCorner(k, n) = cross;
    dense.topRightCorner(n, k) = cross.transpose();
    dense.bottomRightCorner(k, k) = own;
  };
  for (int i = 0; i < 60; ++i)
  {
    const auto pick = [&]
    { return states[static_cast<std::size_t>(random.uniform(0, double(states.size())))]; };
    const int size = 2 + i % 5, kind = states.size() < 3 ? 0 : i % 4;
    if (kind == 0)
    {
      const Matrix P = randomCovariance(random, size);
      states.emplace_back(recursion.add(P, Eigen::VectorXd::Zero(size)), size);
      grow(Matrix::Zero(size, dense.rows()), P);
    }
    else if (kind == 1)
    {
      const auto [at, n] = pick();
      const Matrix J = randomMatrix(random, 2, n), R = randomCovariance(random, 2);
      states.emplace_back(recursion.addFrom({{at, J}}, R, Eigen::Vector2d::Zero()), 2);
      const Matrix cross = test::times(J, dense.middleRows(at, n));
      grow(cross, test::times(cross.middleCols(at, n), J.transpose()) + R);
    }
    else if (kind == 2)
    {
      const auto [at, n] = pick();
      const Matrix F = randomMatrix(random, n, n), Q = randomCovariance(random, n);
      recursion.move(at, F, Q, Eigen::VectorXd::Zero(n));
      Matrix all = Matrix::Identity(dense.rows(), dense.rows());
      all.block(at, at, n, n) = F;
      dense = test::transformed(all, dense);
      dense.block(at, at, n, n) += Q;
    }
    else
    {
      const auto a = states[0], b = states[states.size() - 1], c = states[states.size() / 2];
      const Matrix Ja = randomMatrix(random, 2, a.second), Jb = randomMatrix(random, 2, b.second);
      const Matrix Jc = randomMatrix(random, 1, c.second);
      const Eigen::Vector2d r(0.5, 2);
      recursion.observe(
          {{{{a.first, Ja}, {b.first, Jb}}, r, Eigen::Vector2d::Zero()},
           {{{c.first, Jc}}, Eigen::VectorXd::Constant(1, 0.3), Eigen::VectorXd::Zero(1)}});
      Matrix H = Matrix::Zero(3, dense.rows());
      H.block(0, a.first, 2, a.second) = Ja;
      H.block(0, b.first, 2, b.second) += Jb;
      H.block(2, c.first, 1, c.second) = Jc;
      const Matrix R = Eigen::Vector3d(0.5, 2, 0.3).asDiagonal();
      dense = test::DenseUpdate(dense, H, R, Eigen::VectorXd::Zero(3)).cov;
    }
    const double scale = dense.cwiseAbs().maxCoeff();
    for (const auto& [at, n] : states)
      EXPECT_LT((recursion.block(at, n) - dense.block(at, at, n, n)).norm(), 1e-9 * scale) << i;
  }
  EXPECT_EQ(recursion.size(), dense.rows());
}

TEST(JointErrors, AKnownLandmarkAddsTheInformationOfItsSighting)
{
  const Matrix P = Vector3(0.04, 0.09, 0.01).asDiagonal();
  Matrix J(2, 3);
  J << -0.6, -0.8, 0, 0.16, -0.12, -1;
  const Eigen::Vector2d r(0.01, 0.0004);
  JointErrors recursion;
  const int pose = recursion.add(P, Vector3::Zero());
  const int landmark = recursion.add(Matrix::Zero(2, 2), Vector2::Zero());
  recursion.observe({{{{pose, J}, {landmark, -J.leftCols(2)}}, r, Vector2::Zero()}});
  const Matrix R = r.asDiagonal();
  const Matrix expected =
      test::inverse(test::inverse(P) + test::transformed(J.transpose(), test::inverse(R)));
  EXPECT_LT((recursion.block(pose, 3) - expected).norm(), 1e-14);
  EXPECT_EQ(recursion.block(landmark, 2).norm(), 0);
}
}  // namespace slamot::sim
