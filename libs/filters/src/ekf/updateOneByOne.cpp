#include "updateOneByOne.h"

#include "sighting/soften.h"

#include <slamot/core/Error.h>

#include <Eigen/LU>

#include <algorithm>
#include <numeric>

namespace slamot::filters::ekf
{
namespace
{
/// The innovation nu with prior covariance C, softened by the row's law.
Innovation innovationOf(const SightingRows& row, const Vector2& nu, const Matrix2& C)
{
  Innovation o{};
  o.nuR = nu[0];
  o.nuB = nu[1];
  o.s11 = C(0, 0) + row.variance[0];
  o.s12 = C(0, 1);
  o.s22 = C(1, 1) + row.variance[1];
  o.det = o.s11 * o.s22 - o.s12 * o.s12;
  if (!(o.det > 0))
    throw core::Error(core::ExitStatus::kNonsense, "ekf-slamot",
                      "the sightings of a step have no covariance that makes sense",
                      "look for absurd deviations in the log");
  o.factor = 1;
  o.d2 = o.form();
  Ray z;
  z.varRange = row.variance[0];
  z.varBearing = row.variance[1];
  z.hasRange = row.hasRange;
  z.law = row.law;
  soften(z, 1, nullptr, o);
  return o;
}
}  // namespace

LawUpdate updateOneByOne(const std::vector<SightingRows>& rows, Eigen::MatrixXd C)
{
  const Eigen::Index m = C.rows();
  Eigen::VectorXd nu(m);
  std::vector<double> fit;
  for (Eigen::Index k = 0; k < m; k += 2)
  {
    const SightingRows& row = rows[static_cast<std::size_t>(k / 2)];
    nu.segment<2>(k) = row.innovation;
    fit.push_back(innovationOf(row, row.innovation, C.block<2, 2>(k, k)).d2);
  }
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return fit[a] < fit[b]; });
  LawUpdate out;
  out.gain = Eigen::VectorXd::Zero(m);
  out.reduction = Eigen::MatrixXd::Zero(m, m);
  // Columns of `basis` times W give P Hᵀ as it is now.
  Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(m, m);
  for (const std::size_t i : order)
  {
    const auto k = static_cast<Eigen::Index>(2 * i);
    const Innovation o = innovationOf(rows[i], nu.segment<2>(k), C.block<2, 2>(k, k));
    out.logDensity -= 0.5 * (o.d2 + std::log(o.det)) + std::log(math::kTwoPi);
    Matrix2 S, E;
    S << o.s11, o.s12, o.s12, o.s22;
    E << o.e11, o.e12, o.e12, o.e22;
    const Matrix2 M = S.inverse(), reduction = M - E;
    const Vector2 gain = M * nu.segment<2>(k);
    const Eigen::MatrixXd B = basis.middleCols<2>(k), U = C.middleCols<2>(k);
    out.gain += B * gain;
    out.reduction += B * reduction * B.transpose();
    nu -= U * gain;
    basis -= B * reduction * U.transpose();
    C -= U * reduction * U.transpose();
  }
  out.reduction = (0.5 * (out.reduction + out.reduction.transpose())).eval();
  return out;
}
}  // namespace slamot::filters::ekf
