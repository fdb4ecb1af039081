#include <slamot/models/TargetState.h>

namespace slamot::models
{
template <int N>
void TargetTransition<N>::applyTo(Eigen::Matrix<double, N, N>& P) const
{
  P = (F * P * F.transpose() + Q).eval();
  P = (0.5 * (P + P.transpose())).eval();
}

template void TargetTransition<4>::applyTo(Eigen::Matrix<double, 4, 4>&) const;
template void TargetTransition<5>::applyTo(Eigen::Matrix<double, 5, 5>&) const;
template void TargetTransition<6>::applyTo(Eigen::Matrix<double, 6, 6>&) const;
}  // namespace slamot::models
