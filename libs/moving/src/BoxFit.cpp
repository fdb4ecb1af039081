#include "BoxFit.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace slamot::moving
{
namespace
{
using B = BoxState;

constexpr double kLinear = 2.0;  // deviations from which an error's weight falls

double huberWeight(double normalised)
{
  const double a = std::abs(normalised);
  return a <= kLinear ? 1.0 : kLinear / a;
}

/// Half the negative log probability, but for a constant, of a residual of so many deviations.
double huberLoss(double normalised)
{
  const double a = std::abs(normalised);
  return a <= kLinear ? 0.5 * a * a : kLinear * (a - 0.5 * kLinear);
}

struct Problem
{
  const BoxState& prior;
  const BoxView& view;
  const MovingOptions& options;
  B::Matrix information;  // of the prior

  [[nodiscard]] B::Vector fromPrior(const BoxState& at) const
  {
    B::Vector out = at.x - prior.x;
    out[B::kPhi] = math::wrapToPi(out[B::kPhi]);
    return out;
  }
};

/// Cost, its gradient and information at a state.
struct Normal
{
  double cost;
  B::Vector g;
  B::Matrix H;
};

Normal normalAt(const Problem& p, const BoxState& at)
{
  const B::Vector d = p.fromPrior(at);
  Normal out{0.5 * d.dot(p.information * d), p.information * d, p.information};
  for (const Residual& r : residualsOf(at, p.view, p.options))
  {
    const double normalised = r.value / std::sqrt(r.variance);
    const double w = huberWeight(normalised) / r.variance;
    out.cost += huberLoss(normalised);
    out.g += w * r.value * r.jacobian;
    out.H += w * r.jacobian * r.jacobian.transpose();
  }
  return out;
}

struct Fit
{
  BoxState box;
  double cost;
};

BoxState stepped(const BoxState& from, const B::Vector& step)
{
  constexpr double kSmallest = 0.02;  // [m] of a side
  BoxState out = from;
  out.x += step;
  out.x[B::kPhi] = math::wrapToPi(out.x[B::kPhi]);
  for (const int side : {B::kLength, B::kWidth}) out.x[side] = std::max(out.x[side], kSmallest);
  return out;
}

// A return that changes its face makes steps too long now and then: those are halved.
Fit descend(const Problem& p, BoxState at)
{
  constexpr int kMost = 15;
  constexpr double kLongest = 0.3, kShortest = 1e-4;  // [m, rad] a step
  Normal n = normalAt(p, at);
  for (int i = 0; i < kMost; ++i)
  {
    B::Vector step = n.H.llt().solve(-n.g);
    double length = step.head<3>().norm();
    if (length > kLongest) step *= kLongest / length;
    BoxState next = stepped(at, step);
    Normal there = normalAt(p, next);
    for (int halved = 0; there.cost > n.cost && halved < 4; ++halved)
    {
      step *= 0.5, length *= 0.5;
      next = stepped(at, step);
      there = normalAt(p, next);
    }
    if (there.cost > n.cost) break;
    at = next, n = there;
    if (length < kShortest) break;
  }
  at.P = n.H.llt().solve(B::Matrix::Identity());
  at.P = (0.5 * (at.P + at.P.transpose())).eval();
  return {at, n.cost};
}

/// The box moved to where its returns are nearest to its outline, whichever face they are of.
BoxState laidOn(const BoxView& view, BoxState box)
{
  constexpr int kTimes = 5;
  for (int i = 0; i < kTimes && !view.points.empty(); ++i)
  {
    Vector2 sum(0, 0);
    for (const Point2D& p : view.points)
    {
      const Point2D on = nearestOnOutline(box, p);
      sum += Vector2(p.x - on.x, p.y - on.y);
    }
    box.x.head<2>() += sum / static_cast<double>(view.points.size());
  }
  return box;
}
}  // namespace

// Which faces are seen changes with the box, and so does the minimum that is found.
BoxState correct(const BoxState& predicted, const BoxView& view, const MovingOptions& options)
{
  const Problem p{predicted, view, options, predicted.P.llt().solve(B::Matrix::Identity())};
  const double turn = std::min(std::sqrt(predicted.P(B::kPhi, B::kPhi)), 0.6);
  Fit best = descend(p, predicted);
  for (const double other : {0.0, -turn, turn})
  {
    BoxState start = predicted;
    start.x[B::kPhi] = math::wrapToPi(start.x[B::kPhi] + other);
    Fit fit = descend(p, laidOn(view, start));
    if (fit.cost < best.cost) best = std::move(fit);
  }
  return best.box;
}
}  // namespace slamot::moving
