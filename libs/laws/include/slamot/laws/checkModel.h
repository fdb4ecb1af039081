#pragma once

#include <slamot/laws/LawBroken.h>
#include <slamot/laws/ModelSample.h>

#include <algorithm>

namespace slamot::laws
{
/// The laws that an observation model of a point by a robot breaks; empty if it is sound.
/// - Jacobians equal central differences
/// - the residual of equal sightings is zero, and has no jump where an angle wraps
/// - the noise is symmetric and positive definite
/// - invert() after predict() is the point, invertJacobian() its derivative (of a model with both)
///
/// `Model` has Z, predict(pose, point), residual(z, expected), jacobians(pose, point) with members
/// pose and point, noise(); see models::RangeBearing.
template <class Model>
[[nodiscard]] std::vector<std::string> brokenModelLaws(const Model& model,
                                                       const ModelOptions& options = {})
{
  std::vector<std::string> broken;
  const auto require = [&](bool holds, const char* law)
  {
    if (!holds && std::find(broken.begin(), broken.end(), law) == broken.end())
      broken.push_back(law);
  };
  math::RandomStream random{options.seed, 0x6d6f6465};
  for (int i = 0; i < options.samples; ++i)
  {
    const detail::ModelSample<Model> sample(model, options, random);
    require(sample.jacobiansAreDerivatives(), "Jacobians equal central differences");
    require(sample.residualIsContinuous(), "the residual has no jump where an angle wraps");
    if constexpr (detail::kInverts<Model>)
    {
      require(sample.invertAfterPredictIsThePoint(), "invert() after predict() is the point");
      require(sample.invertJacobianIsDerivative(),
              "invertJacobian() is the derivative of invert()");
    }
  }
  const auto R = model.noise();
  require(math::asymmetry(R) == 0 && math::smallestEigenvalue(R) > 0,
          "the noise is symmetric and positive definite");
  return broken;
}

/// For a test: TEST(MyModel, ObeysTheModelLaws) { checkModel(MyModel(0.1, 0.02)); }
/// \throws LawBroken if brokenModelLaws() are any.
template <class Model>
void checkModel(const Model& model, const ModelOptions& options = {})
{
  const auto broken = brokenModelLaws(model, options);
  if (!broken.empty()) throw LawBroken("the model", broken);
}
}  // namespace slamot::laws
