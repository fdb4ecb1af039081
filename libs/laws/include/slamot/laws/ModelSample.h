#pragma once

#include <slamot/math/gaussian.h>
#include <slamot/math/random.h>

#include <type_traits>

namespace slamot::laws
{
/// Where a model is tried.
struct ModelOptions
{
  double rangeMin = 0.5;   ///< least distance of the points from the robot [m]
  double rangeMax = 20.0;  ///< largest distance of the points from the robot [m]
  int samples = 1000;      ///< pairs of a pose and a point
  std::uint64_t seed = 1;  ///< fixes these
};

namespace detail
{
template <class M, class = void>
inline constexpr bool kInverts = false;
template <class M>
inline constexpr bool kInverts<M, std::void_t<decltype(&M::invert), decltype(&M::invertJacobian)>> =
    true;

inline Pose2D shifted(Pose2D pose, int coordinate, double by)
{
  pose[coordinate] += by;
  return pose;
}
inline Point2D shifted(Point2D point, int coordinate, double by)
{
  point[coordinate] += by;
  return point;
}
inline bool close(double a, double b, double scale)
{
  return std::abs(a - b) <= 1e-5 * (1 + scale);
}

/// One pose and one point within the options' ranges, and the laws at them.
template <class Model>
class ModelSample
{
 public:
  using Z = typename Model::Z;  ///< what the model's sensor tells

  /// Draws the pair, uniform in range, bearing and heading.
  ModelSample(const Model& model, const ModelOptions& options, math::RandomStream& random)
      : model_(model)
  {
    pose_ = {random.uniform(-10, 10), random.uniform(-10, 10),
             random.uniform(-math::kPi, math::kPi)};
    const double range = random.uniform(options.rangeMin, options.rangeMax);
    const double bearing = random.uniform(-math::kPi, math::kPi);
    point_ = math::transform(pose_, {range * std::cos(bearing), range * std::sin(bearing)});
  }

  /// Whether jacobians() are the derivatives of predict(), by central differences, to 1e-5.
  [[nodiscard]] bool jacobiansAreDerivatives() const
  {
    const auto J = model_.jacobians(pose_, point_);
    for (int i = 0; i < 3; ++i)
      if (!matches(J.pose.col(i),
                   [&](double h) { return model_.predict(shifted(pose_, i, h), point_); }))
        return false;
    for (int i = 0; i < 2; ++i)
      if (!matches(J.point.col(i),
                   [&](double h) { return model_.predict(pose_, shifted(point_, i, h)); }))
        return false;
    return true;
  }

  /// Whether invert() of predict() is the point, to 1e-9 m.
  [[nodiscard]] bool invertAfterPredictIsThePoint() const
  {
    const Point2D back = model_.invert(pose_, model_.predict(pose_, point_));
    return std::abs(back.x - point_.x) < 1e-9 && std::abs(back.y - point_.y) < 1e-9;
  }

  /// Whether invertJacobian() is the derivative of invert(), by central differences, to 1e-5.
  [[nodiscard]] bool invertJacobianIsDerivative() const
  {
    const Z z = model_.predict(pose_, point_);
    const auto J = model_.invertJacobian(pose_, z);
    constexpr double h = 1e-6;
    for (int i = 0; i < static_cast<int>(z.size()); ++i)
    {
      const Z e = h * Z::Unit(i);
      const Point2D a = model_.invert(pose_, z - e), b = model_.invert(pose_, z + e);
      const double scale = J.cwiseAbs().maxCoeff();
      if (!close((b.x - a.x) / (2 * h), J(0, i), scale) ||
          !close((b.y - a.y) / (2 * h), J(1, i), scale))
        return false;
    }
    return true;
  }

  /// As the robot turns a full circle nothing about the residual may jump, nor may it tell two
  /// equal sightings apart.
  [[nodiscard]] bool residualIsContinuous() const
  {
    constexpr int kParts = 720;
    const double bound = 3 * math::kTwoPi / kParts *
                         (1 + model_.jacobians(pose_, point_).pose.col(2).cwiseAbs().maxCoeff());
    Z last = model_.predict(pose_, point_);
    if (model_.residual(last, last).cwiseAbs().maxCoeff() > 1e-12) return false;
    for (int i = 1; i <= kParts; ++i)
    {
      const Z z = model_.predict(shifted(pose_, 2, i * math::kTwoPi / kParts), point_);
      if (!(model_.residual(z, last).cwiseAbs().maxCoeff() <= bound)) return false;
      last = z;
    }
    return true;
  }

 private:
  template <class Column, class F>
  [[nodiscard]] bool matches(const Column& column, F at) const
  {
    constexpr double h = 1e-6;
    const Z slope = model_.residual(at(h), at(-h)) / (2 * h);
    for (int row = 0; row < static_cast<int>(slope.size()); ++row)
      if (!close(slope[row], column[row], column.cwiseAbs().maxCoeff())) return false;
    return true;
  }

  const Model& model_;
  Pose2D pose_;
  Point2D point_;
};
}  // namespace detail
}  // namespace slamot::laws
