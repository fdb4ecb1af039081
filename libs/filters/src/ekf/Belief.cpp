#include "Belief.h"

#include "Rest.h"
#include "updateOneByOne.h"

#include <slamot/core/Error.h>
#include <slamot/math/eigensystem.h>

#include <Eigen/Cholesky>

namespace slamot::filters::ekf
{
void failOverflow()
{
  throw core::Error(core::ExitStatus::kNonsense, "filter", "the estimate overflowed at a step",
                    "look for absurd values of odometry or deviations in the log");
}

Belief::Belief(int robots, int targetSize) : robots_(robots), targetSize_(targetSize)
{
  x_.setZero(front());
  P_.grow(front());
}
Belief::Belief(const Belief& other)
    : robots_(other.robots_),
      targetSize_(other.targetSize_),
      targetSlots_(other.targetSlots_),
      freeTargets_(other.freeTargets_),
      freeLandmarks_(other.freeLandmarks_),
      offset_(other.offset_),
      x_(other.x_),
      P_(other.P_),
      rest_(other.rest_ ? std::make_unique<Rest>(*other.rest_) : nullptr)
{
}
Belief::~Belief() = default;

Gaussian<Point2D> Belief::place(int slot) const
{
  const int j = landmark(slot);
  if (j < 0) return rest_->place(front() + 2 * slot);
  return {{x_[j], x_[j + 1]}, P_.block<2, 2>(j, j)};
}

int Belief::addTarget()
{
  if (freeTargets_.empty()) makeRoomForTargets();
  const int slot = freeTargets_.back();
  freeTargets_.pop_back();
  return slot;
}

void Belief::makeRoomForTargets()
{
  spread();
  const int before = front(), more = std::max(1, targetSlots_);
  for (int s = targetSlots_ + more; s-- > targetSlots_;) freeTargets_.push_back(s);
  targetSlots_ += more;
  const int shift = front() - before, n = P_.size();
  LowerMatrix wider;
  wider.grow(n + shift);
  for (int j = 0; j < n; ++j)
    for (int i = j; i < n; ++i)
      wider.set(i < before ? i : i + shift, j < before ? j : j + shift, P_(i, j));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n + shift);
  x.head(before) = x_.head(before);
  x.tail(n - before) = x_.tail(n - before);
  x_.swap(x);
  std::swap(P_, wider);
  for (int& o : offset_) o += shift;
}

void Belief::removeTarget(int slot)
{
  const int j = target(slot);
  set(j, Eigen::VectorXd::Zero(targetSize_), Eigen::MatrixXd::Zero(targetSize_, targetSize_));
  freeTargets_.push_back(slot);
}

int Belief::addLandmark(int robot, const Gaussian<Point2D>& place,
                        const Eigen::Matrix<double, 2, 3>& byRobot)
{
  const auto local = [&](int slot) { return landmark(slot) >= 0; };
  const auto it = std::find_if(freeLandmarks_.begin(), freeLandmarks_.end(), local);
  int slot = landmarks();
  if (it != freeLandmarks_.end())
  {
    slot = *it;
    freeLandmarks_.erase(it);
  }
  else
  {
    offset_.push_back(P_.size());
    P_.grow(P_.size() + 2);
    x_.conservativeResize(P_.size());
    if (rest_) rest_->grow(2);
  }
  const int j = landmark(slot);
  set(j, Vector2(place.mean.x, place.mean.y), place.cov);
  correlate(j, robot, byRobot);
  return slot;
}

void Belief::correlate(int j, int robot, const Eigen::Matrix<double, 2, 3>& byRobot)
{
  column_.resize(P_.size(), 3);
  P_.columns(robot, 3, column_);
  Eigen::MatrixXd rows = column_ * byRobot.transpose();
  const Matrix2 own =
      P_.block<2, 2>(j, j) + byRobot * P_.block<3, 3>(robot, robot) * byRobot.transpose();
  rows.middleRows<2>(j) = 0.5 * (own + own.transpose());
  P_.setColumns(j, 2, rows);
  if (rest_) rest_->phi.middleRows<2>(j) = byRobot * rest_->phi.middleRows<3>(robot);
}

void Belief::removeLandmark(int slot)
{
  set(landmark(slot), Vector2::Zero(), Matrix2::Zero());
  freeLandmarks_.push_back(slot);
}

void Belief::set(int j, const Eigen::Ref<const Eigen::VectorXd>& mean,
                 const Eigen::Ref<const Eigen::MatrixXd>& cov)
{
  const int k = static_cast<int>(mean.size());
  x_.segment(j, k) = mean;
  P_.clear(j, k);
  P_.add(j, cov);
  if (rest_) rest_->phi.middleRows(j, k).setZero();
}

void Belief::move(int j, const Eigen::Ref<const Eigen::VectorXd>& mean,
                  const Eigen::Ref<const Eigen::MatrixXd>& F,
                  const Eigen::Ref<const Eigen::MatrixXd>& Q)
{
  x_.segment(j, mean.size()) = mean;
  P_.transform(j, F);
  P_.add(j, Q);
  if (rest_)
    rest_->phi.middleRows(j, mean.size()) = (F * rest_->phi.middleRows(j, F.cols())).eval();
}

namespace
{
/// H M.
Eigen::MatrixXd times(const std::vector<SightingRows>& rows, const Eigen::MatrixXd& M)
{
  Eigen::MatrixXd out(2 * static_cast<Eigen::Index>(rows.size()), M.cols());
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    auto two = out.middleRows<2>(2 * static_cast<Eigen::Index>(k));
    two.noalias() = rows[k].byRobot * M.middleRows<3>(rows[k].robot);
    two.noalias() += rows[k].byObject * M.middleRows<2>(rows[k].object);
  }
  return out;
}
}  // namespace

// W = P Hᵀ into W_.
void Belief::spanOf(const std::vector<SightingRows>& rows)
{
  const auto m = static_cast<Eigen::Index>(2 * rows.size());
  const int n = P_.size();
  W_.resize(n, m);
  column_.resize(n, 5);
  int robot = -1;
  for (Eigen::Index k = 0; k < m; k += 2)
  {
    const SightingRows& row = rows[static_cast<std::size_t>(k / 2)];
    if (row.robot != robot) P_.columns(robot = row.robot, 3, column_.leftCols<3>());
    P_.columns(row.object, 2, column_.rightCols<2>());
    W_.middleCols<2>(k).noalias() = column_.leftCols<3>() * row.byRobot.transpose();
    W_.middleCols<2>(k).noalias() += column_.rightCols<2>() * row.byObject.transpose();
  }
}

double Belief::update(const std::vector<SightingRows>& rows)
{
  if (rows.empty()) return 0;
  if (std::any_of(rows.begin(), rows.end(), [](const auto& r) { return r.law != nullptr; }))
    return updateByLaw(rows);
  spanOf(rows);
  const Eigen::Index m = W_.cols();
  Eigen::VectorXd nu(m), variance(m);
  for (Eigen::Index k = 0; k < m; k += 2)
  {
    nu.segment<2>(k) = rows[static_cast<std::size_t>(k / 2)].innovation;
    variance.segment<2>(k) = rows[static_cast<std::size_t>(k / 2)].variance;
  }
  Eigen::MatrixXd S = times(rows, W_);
  S.diagonal() += variance;
  const Eigen::LLT<Eigen::MatrixXd> llt(S);
  if (llt.info() != Eigen::Success)
    throw core::Error(core::ExitStatus::kNonsense, "ekf-slamot",
                      "the sightings of a step have no covariance that makes sense",
                      "look for absurd deviations in the log");
  // V = W L⁻ᵀ: then W S⁻¹ Wᵀ = V Vᵀ, of which one triangle is enough.
  llt.matrixU().solveInPlace<Eigen::OnTheRight>(W_);
  llt.matrixL().solveInPlace(nu);
  x_.noalias() += W_ * nu;
  P_.update(W_, -1);
  const double logDensity = -0.5 * (nu.squaredNorm() + m * std::log(math::kTwoPi)) -
                            llt.matrixLLT().diagonal().array().log().sum();
  if (!rest_) return logDensity;
  Eigen::MatrixXd U = times(rows, rest_->phi);
  llt.matrixL().solveInPlace(U);
  rest_->take(U, nu);
  addProduct(-1, ReadOnly::of(W_), ReadOnly::transposeOf(U), rest_->phi.data(),
             rest_->phi.outerStride(), false);
  return logDensity;
}

double Belief::updateByLaw(const std::vector<SightingRows>& rows)
{
  spanOf(rows);
  const Eigen::MatrixXd C = times(rows, W_);
  const LawUpdate all = updateOneByOne(rows, 0.5 * (C + C.transpose()));
  take(W_, rest_ ? times(rows, rest_->phi) : Eigen::MatrixXd(), all.gain, all.reduction, 1);
  return all.logDensity;
}

Eigen::MatrixXd Belief::product(const Rows& H) const
{
  const Eigen::Index m = H.columns.front().rows();
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(P_.size(), m);
  for (std::size_t b = 0; b < H.at.size(); ++b)
  {
    const auto k = static_cast<int>(H.columns[b].cols());
    Eigen::MatrixXd columns(P_.size(), k);
    P_.columns(H.at[b], k, columns);
    W.noalias() += columns * H.columns[b].transpose();
  }
  return W;
}

namespace
{
Eigen::MatrixXd times(const Belief::Rows& H, const Eigen::MatrixXd& M)
{
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(H.columns.front().rows(), M.cols());
  for (std::size_t b = 0; b < H.at.size(); ++b)
    out.noalias() += H.columns[b] * M.middleRows(H.at[b], H.columns[b].cols());
  return out;
}
}  // namespace

Eigen::MatrixXd Belief::innovationCov(const Rows& H, const Eigen::MatrixXd& W)
{
  const Eigen::MatrixXd A = times(H, W);
  return 0.5 * (A + A.transpose());
}

math::IntersectionCriterion Belief::criterion(const Rows& H, const Eigen::MatrixXd& W, double lever)
{
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(P_.size());
  for (int r = 0; r < robots_; ++r) weight.segment<3>(robot(r)) << 1, 1, lever * lever;
  for (int t = 0; t < targetSlots_; ++t) weight.segment<2>(target(t)).setOnes();
  weight.tail(P_.size() - front()).setOnes();
  double trace = weight.dot(P_.diagonal());
  Eigen::MatrixXd gram = W.transpose() * weight.asDiagonal() * W;
  if (rest_) rest_->addTo(times(H, rest_->phi), trace, gram);
  return {trace, 0.5 * (gram + gram.transpose())};
}

void Belief::fuse(const Rows& H, const Eigen::MatrixXd& W, const math::IntersectionUpdate& update)
{
  take(W, rest_ ? times(H, rest_->phi) : Eigen::MatrixXd(), update.gain, update.reduction,
       update.scale);
}

void Belief::take(const Eigen::MatrixXd& W, const Eigen::MatrixXd& U, const Eigen::VectorXd& gain,
                  const Eigen::MatrixXd& reduction, double scale)
{
  x_.noalias() += W * gain;
  const auto eigen = math::eigensystem<Eigen::Dynamic>(reduction);
  const Eigen::MatrixXd turned = W * eigen.vectors;
  // Inverse covariance intersection and glint can add where they reduce elsewhere.
  const Eigen::VectorXd& values = eigen.values;
  if (values.minCoeff() < 0)
    P_.update(turned * values.cwiseMin(0).cwiseAbs().cwiseSqrt().asDiagonal(), 1);
  P_.update(turned * values.cwiseMax(0).cwiseSqrt().asDiagonal(), -1);
  P_ *= scale;
  if (!rest_) return;
  rest_->theta.noalias() += U.transpose() * gain;
  const Eigen::MatrixXd reduced = reduction * U;
  rest_->psi.noalias() += U.transpose() * reduced / rest_->scale;
  rest_->phi.noalias() -= W * reduced;
  rest_->phi *= scale;
  rest_->scale *= scale;
}

void Belief::reshape(int j, const Eigen::Ref<const Eigen::VectorXd>& shift,
                     const Eigen::Ref<const Eigen::MatrixXd>& T,
                     const Eigen::Ref<const Eigen::MatrixXd>& C)
{
  const auto k = static_cast<int>(shift.size());
  x_.segment(j, k) += shift;
  P_.transform(j, T);
  for (int a = 0; a < k; ++a)
    for (int b = 0; b <= a; ++b) P_.set(j + a, j + b, C(a, b));
  if (rest_) rest_->phi.middleRows(j, k) = (T * rest_->phi.middleRows(j, k)).eval();
}

void Belief::focus(const std::vector<int>& slots)
{
  spread();
  std::vector<int> from(static_cast<std::size_t>(front()));  // where a local coordinate comes from
  for (int i = 0; i < front(); ++i) from[static_cast<std::size_t>(i)] = i;
  for (const int s : slots)
  {
    from.push_back(landmark(s));
    from.push_back(landmark(s) + 1);
  }
  rest_ = std::make_unique<Rest>(std::move(x_), std::move(P_), from);
  const auto n = static_cast<int>(from.size());
  x_.resize(n);
  P_ = LowerMatrix();
  P_.grow(n);
  for (int j = 0; j < n; ++j)
  {
    const int fromJ = from[static_cast<std::size_t>(j)];
    x_[j] = rest_->x[fromJ];
    for (int i = j; i < n; ++i) P_.set(i, j, rest_->P(from[static_cast<std::size_t>(i)], fromJ));
  }
  std::fill(offset_.begin(), offset_.end(), -1);
  for (std::size_t k = 0; k < slots.size(); ++k)
    offset_[static_cast<std::size_t>(slots[k])] = front() + 2 * static_cast<int>(k);
}

void Belief::spread()
{
  if (!rest_) return;
  const int n = front() + 2 * landmarks();
  std::vector<int> to(static_cast<std::size_t>(P_.size()));  // where a local coordinate goes
  for (int i = 0; i < front(); ++i) to[static_cast<std::size_t>(i)] = i;
  for (int s = 0; s < landmarks(); ++s)
  {
    if (landmark(s) >= 0)
    {
      to[static_cast<std::size_t>(landmark(s))] = front() + 2 * s;
      to[static_cast<std::size_t>(landmark(s)) + 1] = front() + 2 * s + 1;
    }
    offset_[static_cast<std::size_t>(s)] = front() + 2 * s;
  }
  rest_->spread(x_, P_, to, n);
  x_ = std::move(rest_->x);
  P_ = std::move(rest_->P);
  rest_.reset();
}
}  // namespace slamot::filters::ekf
