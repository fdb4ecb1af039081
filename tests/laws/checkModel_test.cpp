#include <slamot/laws/checkModel.h>
#include <slamot/models/RangeBearing.h>

#include <gtest/gtest.h>

namespace
{
using namespace slamot;
using models::RangeBearing;

TEST(RangeBearing, ObeysTheModelLaws)
{
  laws::checkModel(RangeBearing(0.1, 0.02));
}

/// Bearing alone: nothing to invert.
struct Bearing
{
  using Z = Eigen::Matrix<double, 1, 1>;
  struct Jacobians
  {
    Eigen::Matrix<double, 1, 3> pose;
    Eigen::Matrix<double, 1, 2> point;
  };
  [[nodiscard]] static Z predict(const Pose2D& x, const Point2D& m)
  {
    return RangeBearing::predict(x, m).tail<1>();
  }
  [[nodiscard]] static Z residual(const Z& a, const Z& b) { return Z(math::wrapToPi(a[0] - b[0])); }
  [[nodiscard]] static Jacobians jacobians(const Pose2D& x, const Point2D& m)
  {
    const auto J = RangeBearing::jacobians(x, m);
    return {J.pose.bottomRows<1>(), J.point.bottomRows<1>()};
  }
  [[nodiscard]] static Z noise() { return Z(1e-4); }
};

TEST(CheckModel, PassesAModelThatCannotBeInverted)
{
  laws::checkModel(Bearing{});
}

// Each of these has one defect.
struct WrongSign : RangeBearing
{
  using RangeBearing::RangeBearing;
  [[nodiscard]] static Jacobians jacobians(const Pose2D& x, const Point2D& m)
  {
    Jacobians J = RangeBearing::jacobians(x, m);
    J.pose(1, 2) = 1;
    return J;
  }
};
struct NoWrap : RangeBearing
{
  using RangeBearing::RangeBearing;
  [[nodiscard]] static Z residual(const Z& a, const Z& b) { return a - b; }
};
struct Mirrored : RangeBearing
{
  using RangeBearing::RangeBearing;
  [[nodiscard]] static Point2D invert(const Pose2D& x, const Z& z)
  {
    return RangeBearing::invert(x, Z(z[0], -z[1]));
  }
};
struct SwappedColumns : RangeBearing
{
  using RangeBearing::RangeBearing;
  [[nodiscard]] static Matrix2 invertJacobian(const Pose2D& x, const Z& z)
  {
    return RangeBearing::invertJacobian(x, z).rowwise().reverse();
  }
};

template <class Model>
std::string onlyBrokenLaw(const Model& model)
{
  const auto broken = laws::brokenModelLaws(model);
  EXPECT_EQ(broken.size(), 1u);
  return broken.empty() ? "" : broken.front();
}

TEST(CheckModel, FindsAJacobianOfWrongSign)
{
  EXPECT_EQ(onlyBrokenLaw(WrongSign(0.1, 0.02)), "Jacobians equal central differences");
  EXPECT_THROW(laws::checkModel(WrongSign(0.1, 0.02)), laws::LawBroken);
}

TEST(CheckModel, FindsAResidualThatDoesNotWrap)
{
  EXPECT_EQ(onlyBrokenLaw(NoWrap(0.1, 0.02)), "the residual has no jump where an angle wraps");
}

TEST(CheckModel, FindsAnInverseThatIsNone)
{
  const auto broken = laws::brokenModelLaws(Mirrored(0.1, 0.02));
  ASSERT_EQ(broken.size(), 2u);
  EXPECT_EQ(broken[0], "invert() after predict() is the point");
  EXPECT_EQ(broken[1], "invertJacobian() is the derivative of invert()");
}

TEST(CheckModel, FindsAnInverseJacobianWithSwappedColumns)
{
  EXPECT_EQ(onlyBrokenLaw(SwappedColumns(0.1, 0.02)),
            "invertJacobian() is the derivative of invert()");
}

TEST(CheckModel, FindsNoiseThatIsNotPositive)
{
  EXPECT_EQ(onlyBrokenLaw(RangeBearing(0.1, 0.0)), "the noise is symmetric and positive definite");
}
}  // namespace
