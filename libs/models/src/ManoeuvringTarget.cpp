#include <slamot/models/ManoeuvringTarget.h>

#include <slamot/math/eigensystem.h>
#include <slamot/models/stretch.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "headingOf.h"

namespace slamot::models
{
using Start = core::ObjectStart;
using Vector = ManoeuvringTarget::Vector;
using Matrix = ManoeuvringTarget::Matrix;

namespace
{
constexpr double kLeastSpeed = 0.05;  // [m/s] below which no turn rate can be told

const Matrix2& quarterTurn()
{
  static const Matrix2 J = (Matrix2() << 0, -1, 1, 0).finished();
  return J;
}

double squareSpeed(const Vector2& v)
{
  return v.squaredNorm() + kLeastSpeed * kLeastSpeed;
}

/// The rate at which an acceleration turns a velocity [rad/s].
double turnRateOf(const Vector& x)
{
  const Vector2 v = x.segment<2>(2), a = x.segment<2>(4);
  return v.dot(-quarterTurn() * a) / squareSpeed(v);
}

/// The way of a unit velocity that turns at a rate, and its derivative by the rate: for v along x.
struct Arc
{
  double along, across;    ///< [s]
  double dAlong, dAcross;  ///< [s²]
  Arc(double rate, double dt)
  {
    const double a = rate * dt;
    if (std::abs(a) < 1e-3)
    {
      along = dt * (1 - a * a / 6);
      across = dt * a / 2;
      dAlong = -dt * dt * a / 3;
      dAcross = dt * dt * (0.5 - a * a / 8);
      return;
    }
    const double c = std::cos(a), s = std::sin(a);
    along = s / rate;
    across = (1 - c) / rate;
    dAlong = (dt * c - along) / rate;
    dAcross = (dt * s - across) / rate;
  }
};

Matrix2 rotation(double angle)
{
  const double c = std::cos(angle), s = std::sin(angle);
  return (Matrix2() << c, -s, s, c).finished();
}

/// Turns at a known rate; the acceleration is what that takes.
Matrix turnBy(double rate, double dt)
{
  const Arc arc(rate, dt);
  const Matrix2 R = rotation(rate * dt);
  Matrix F = Matrix::Zero();
  F.topLeftCorner<2, 2>().setIdentity();
  F.block<2, 2>(0, 2) << arc.along, -arc.across, arc.across, arc.along;
  F.block<2, 2>(2, 2) = R;
  F.block<2, 2>(4, 2) = rate * quarterTurn() * R;
  return F;
}

/// The same at the rate that x has; how that rate changes with x is in the derivative.
Matrix turnOn(Vector& x, double dt)
{
  const Vector2 v = x.segment<2>(2), a = x.segment<2>(4);
  const double rate = turnRateOf(x), q = squareSpeed(v);
  const Matrix2& J = quarterTurn();
  Eigen::Matrix<double, 1, 4> byVA;  // of the rate, by velocity and acceleration
  byVA.leftCols<2>() = (-J * a).transpose() / q - 2 * rate * v.transpose() / q;
  byVA.rightCols<2>() = (J * v).transpose() / q;
  const Arc arc(rate, dt);
  Matrix2 way;  // of the velocity's, by the rate
  way << arc.dAlong, -arc.dAcross, arc.dAcross, arc.dAlong;
  const Matrix2 R = rotation(rate * dt);
  const Vector2 turned = R * v;
  Matrix F = turnBy(rate, dt);
  F.block<2, 4>(0, 2) += way * v * byVA;
  F.block<2, 4>(2, 2) += dt * J * turned * byVA;
  F.block<2, 4>(4, 2) += (J * turned - dt * rate * turned) * byVA;
  x = (turnBy(rate, dt) * x).eval();
  return F;
}

/// What white noise on the derivative of order `order` (1: velocity) adds up to.
/// \param density its covariance over x and y.
void addNoise(Matrix& Q, int order, const Matrix2& density, double dt)
{
  constexpr double factorial[] = {1, 1, 2};
  for (int i = 0; i < order; ++i)
    for (int j = 0; j < order; ++j)
    {
      const int a = order - 1 - i, b = order - 1 - j;
      Q.block<2, 2>(2 * i, 2 * j) +=
          density * (std::pow(dt, a + b + 1) / ((a + b + 1) * factorial[a] * factorial[b]));
    }
}
void addNoise(Matrix& Q, int order, double density, double dt)
{
  addNoise(Q, order, Matrix2(density * density * Matrix2::Identity()), dt);
}

/// Second moment of the direction of motion: of a velocity that is all doubt, half along each axis.
Matrix2 alongOf(const Matrix2& velocitySquare)
{
  return velocitySquare / std::max(velocitySquare.trace(), kLeastSpeed * kLeastSpeed);
}

Matrix symmetric(const Matrix& M)
{
  return 0.5 * (M + M.transpose());
}

using Rows = Eigen::Matrix<double, 4, 6>;

}  // namespace

ManoeuvringTarget::Params ManoeuvringTarget::Params::from(core::Params& p)
{
  const std::vector<std::string> names{"constant-velocity", "left-turn", "right-turn",
                                       "coordinated-turn", "constant-acceleration"};
  Params out{};
  for (const std::string& name :
       p.list("target_modes", "constant-velocity, left-turn, right-turn, constant-acceleration"))
  {
    const auto it = std::find(names.begin(), names.end(), name);
    if (it == names.end())
      p.fail("target_modes", "'" + name + "' is no mode",
             "list some of constant-velocity, left-turn, right-turn, coordinated-turn, "
             "constant-acceleration");
    const Mode mode = static_cast<Mode>(it - names.begin());
    if (std::count(out.modes.begin(), out.modes.end(), mode) > 0)
      p.fail("target_modes", name + " is named twice", "name it once");
    out.modes.push_back(mode);
  }
  out.modeTime = p.positive("target_mode_time_s", 2.0);
  out.velocityStd = p.positive("target_velocity_std_mps");
  out.accelerationStd = p.positive("target_acceleration_std_mps2", 1.0);
  out.turnRate = p.inRange("target_turn_rate_deg_per_s", 0.01, 3600, math::degToRad(30));
  out.turnRateStd = p.inRange("target_turn_rate_std_deg_per_s", 0.01, 3600, math::degToRad(30));
  out.speed = p.optionalNumber("target_speed_mps", 0);
  out.speedStd = p.nonNegative("target_speed_std_mps", 0.0);
  out.velocityNoise = p.nonNegative("target_velocity_noise_mps_per_sqrt_hz", 0.0);
  out.headingWalk = p.inRange("target_heading_walk_deg_per_sqrt_s", 0, 3600, math::degToRad(5));
  out.accelerationNoise = p.nonNegative("target_acceleration_noise_mps2_per_sqrt_hz", 0.1);
  out.jerkNoise = p.nonNegative("target_jerk_noise_mps3_per_sqrt_hz", 0.5);
  out.turnRateNoise =
      p.inRange("target_turn_rate_walk_deg_per_s_per_sqrt_s", 0, 3600, math::degToRad(5));
  return out;
}

ManoeuvringTarget::State ManoeuvringTarget::bankOf(const TargetState<kSize>& s,
                                                   bool knowsAcceleration) const
{
  State out;
  out.modes = static_cast<int>(params_.modes.size());
  for (int j = 0; j < out.modes; ++j)
  {
    const Mode mode = params_.modes[static_cast<std::size_t>(j)];
    Member m{s.x, s.P, 1.0 / out.modes};
    const bool keeps = knowsAcceleration && mode == Mode::kAcceleration;
    out.bank[static_cast<std::size_t>(j)] = keeps ? m : taking(mode, m);
  }
  out.combine();
  return out;
}

ManoeuvringTarget::State ManoeuvringTarget::start(const Start& start) const
{
  TargetState<kSize> s;
  constexpr Start::Field fields[] = {Start::kX,  Start::kY,  Start::kVx,
                                     Start::kVy, Start::kAx, Start::kAy};
  const double otherwise[] = {0, params_.velocityStd, params_.accelerationStd};
  for (int i = 0; i < kSize; ++i)
  {
    s.x[i] = start.get(fields[i]);
    s.P(i, i) = std::pow(start.value[fields[i]] ? start.getStd(fields[i]) : otherwise[i / 2], 2);
  }
  if (params_.speed && start.value[Start::kTheta] &&
      !(start.value[Start::kVx] && start.value[Start::kVy]))
  {
    const Vector2 along(std::cos(start.get(Start::kTheta)), std::sin(start.get(Start::kTheta)));
    const Vector2 across = quarterTurn() * along;
    const double aside = *params_.speed * start.getStd(Start::kTheta);
    s.x.segment<2>(2) = *params_.speed * along;
    s.P.block<2, 2>(2, 2) = std::pow(params_.speedStd, 2) * along * along.transpose() +
                            aside * aside * across * across.transpose();
  }
  return bankOf(s, start.value[Start::kAx] && start.value[Start::kAy]);
}

ManoeuvringTarget::State ManoeuvringTarget::birth(const Gaussian<Point2D>& place) const
{
  TargetState<kSize> s;
  s.x.head<2>() << place.mean.x, place.mean.y;
  s.P.topLeftCorner<2, 2>() = place.cov;
  s.P(2, 2) = s.P(3, 3) = params_.velocityStd * params_.velocityStd;
  return bankOf(s, false);
}

ManoeuvringTarget::Member ManoeuvringTarget::taking(Mode to, const Member& m) const
{
  // The acceleration is G v plus one of its own.
  const double rate = to == Mode::kLeftTurn    ? params_.turnRate
                      : to == Mode::kRightTurn ? -params_.turnRate
                                               : 0;
  const Matrix2 G = rate * quarterTurn(), velocity = m.P.block<2, 2>(2, 2);
  Matrix2 own = Matrix2::Zero();
  if (to == Mode::kAcceleration) own.diagonal().setConstant(std::pow(params_.accelerationStd, 2));
  if (to == Mode::kTurn)
  {
    const Vector2 v = m.x.segment<2>(2);
    own = std::pow(params_.turnRateStd, 2) * quarterTurn() * (v * v.transpose() + velocity) *
          quarterTurn().transpose();
  }
  Member out = m;
  out.x.tail<2>() = G * m.x.segment<2>(2);
  out.P.bottomLeftCorner<2, 4>() = G * m.P.block<2, 4>(2, 0);
  out.P.topRightCorner<4, 2>() = out.P.bottomLeftCorner<2, 4>().transpose();
  out.P.bottomRightCorner<2, 2>() = G * velocity * G.transpose() + own;
  return out;
}

// What all that takes to a mode comes from is one Gaussian before it does: the same moments as one
// by one, but for the spread of velocities in the rate of a turn.
void ManoeuvringTarget::mix(State& s, double dt) const
{
  const int n = s.modes;
  if (n < 2) return;
  // A chain in continuous time that goes to each other mode at the same rate.
  const double decay = std::exp(-dt * n / ((n - 1) * params_.modeTime));
  const double stay = (1 + (n - 1) * decay) / n, leave = (1 - decay) / n;
  const auto before = s.bank;
  for (int j = 0; j < n; ++j)
  {
    Member to, others;
    for (int i = 0; i < n; ++i)
      if (i != j) others.add(before[static_cast<std::size_t>(i)], leave);
    const auto k = static_cast<std::size_t>(j);
    to.add(before[k], stay);
    to.add(taking(params_.modes[k], others), 1);
    to.P = symmetric(to.P);
    s.bank[k] = to;
  }
}

void ManoeuvringTarget::Member::add(const Member& m, double times)
{
  const double w = times * m.weight;
  if (!(w > 0)) return;
  weight += w;
  const double share = w / weight;
  const Vector d = m.x - x;
  x += share * d;
  P += share * (m.P - P) + share * (1 - share) * d * d.transpose();
}

Matrix ManoeuvringTarget::moveMember(Mode mode, Member& m, double dt) const
{
  Matrix F, Q = Matrix::Zero();
  const Vector2 v = m.x.segment<2>(2);
  const Matrix2 square = v * v.transpose() + m.P.block<2, 2>(2, 2);
  addNoise(Q, 1, std::pow(params_.velocityNoise, 2) * alongOf(square), dt);
  if (mode == Mode::kAcceleration)
  {
    F.setIdentity();
    F.block<4, 4>(0, 2).diagonal().setConstant(dt);
    F.block<2, 2>(0, 4).diagonal().setConstant(0.5 * dt * dt);
    addNoise(Q, 3, params_.jerkNoise, dt);
    m.x = (F * m.x).eval();
  }
  else
  {
    if (mode == Mode::kTurn)
    {
      const Vector2 across = quarterTurn() * v;
      F = turnOn(m.x, dt);
      Q.bottomRightCorner<2, 2>() +=
          std::pow(params_.turnRateNoise, 2) * dt * across * across.transpose();
    }
    else
    {
      F = turnBy(mode == Mode::kLeftTurn    ? params_.turnRate
                 : mode == Mode::kRightTurn ? -params_.turnRate
                                            : 0,
                 dt);
      m.x = (F * m.x).eval();
    }
    addNoise(Q, 2, params_.accelerationNoise, dt);
    addNoise(Q, 2,
             std::pow(params_.headingWalk, 2) * quarterTurn() * square * quarterTurn().transpose(),
             dt);
  }
  m.P = symmetric(F * m.P * F.transpose() + Q);
  return F;
}

TargetTransition<ManoeuvringTarget::kSize> ManoeuvringTarget::move(State& s, double dt) const
{
  s.conform();
  const Matrix before = s.P;
  mix(s, dt);
  s.combine();
  // Taking to other modes leaves places and velocities as they are.
  const Matrix mixing = transitionOf(before, s.P, Matrix::Identity().topRows<4>()).F;
  Rows rows = Rows::Zero();
  for (int j = 0; j < s.modes; ++j)
  {
    Member& m = s.bank[static_cast<std::size_t>(j)];
    const Matrix F = moveMember(params_.modes[static_cast<std::size_t>(j)], m, dt);
    rows += m.weight * F.topRows<4>();
  }
  s.combine();
  return transitionOf(before, s.P, rows * mixing);
}

void ManoeuvringTarget::predict(State& s, double dt) const
{
  s.conform();
  mix(s, dt);
  for (int j = 0; j < s.modes; ++j)
    moveMember(params_.modes[static_cast<std::size_t>(j)], s.bank[static_cast<std::size_t>(j)], dt);
  s.combine();
}

Gaussian<Pose2D> ManoeuvringTarget::pose(const State& s)
{
  return poseOf(s.point(), s.pointCov(), s.x.segment<2>(2), s.P.block<2, 2>(2, 2));
}

Vector2 ManoeuvringTarget::velocity(const State& s, Matrix2& cov)
{
  cov = s.P.block<2, 2>(2, 2);
  return s.x.segment<2>(2);
}

Kinematics<6, 6> ManoeuvringTarget::kinematics(const State& s)
{
  return {s.x, Matrix::Identity()};
}

TargetTransition<ManoeuvringTarget::kSize> ManoeuvringTarget::kinematicTransition(const Vector& x,
                                                                                  double dt) const
{
  TargetTransition<kSize> t;
  t.F = turnBy(0, dt);
  const double turn = x.segment<2>(2).norm() * std::max(params_.turnRate, params_.turnRateStd);
  const double accelerationVar = turn * turn + std::pow(params_.accelerationStd, 2);
  // An acceleration that may be anything, and lasts.
  Eigen::Matrix<double, kSize, 2> G = Eigen::Matrix<double, kSize, 2>::Zero();
  G.topRows<2>().diagonal().setConstant(0.5 * dt * dt);
  G.middleRows<2>(2).diagonal().setConstant(dt);
  G.bottomRows<2>().diagonal().setOnes();
  t.Q = accelerationVar * G * G.transpose();
  addNoise(t.Q, 1, params_.velocityNoise, dt);
  addNoise(t.Q, 2, params_.accelerationNoise, dt);
  return t;
}

void ManoeuvringTarget::widen(State& s, const Matrix3& poseCov)
{
  Eigen::Matrix<double, kSize, 3> G = Eigen::Matrix<double, kSize, 3>::Zero();
  G.topLeftCorner<2, 2>().setIdentity();
  for (int i = 2; i < kSize; i += 2)  // a turn turns velocity and acceleration
  {
    G(i, 2) = -s.x[i + 1];
    G(i + 1, 2) = s.x[i];
  }
  s.P += G * poseCov * G.transpose();
}

void ManoeuvringTarget::State::combine()
{
  Member all;
  for (int j = 0; j < modes; ++j) all.add(bank[static_cast<std::size_t>(j)], 1);
  for (int j = 0; j < modes; ++j) bank[static_cast<std::size_t>(j)].weight /= all.weight;
  x = all.x;
  P = all.P;
  P = symmetric(P);
  known.x = x;
  known.P = P;
}

void ManoeuvringTarget::State::conform()
{
  constexpr double kRounding = 1e-12;
  if ((known.P - P).norm() <= kRounding * P.norm() &&
      (known.x - x).norm() <= kRounding * (1 + x.norm()))
    return;
  const Stretch<6> by = stretch<6>(known.P, P, false);
  for (int j = 0; j < modes; ++j)
  {
    Member& m = bank[static_cast<std::size_t>(j)];
    m.x = (x + by.T * (m.x - known.x)).eval();
    m.P = symmetric(by.T * m.P * by.T.transpose() + by.left);
  }
  known.x = x;
  known.P = P;
}

namespace
{
/// Where models have less in common with all else than was assumed.
Matrix positive(const Matrix& P)
{
  return math::eigensystem<6>(P).values[0] >= 0 ? P : math::withoutNegative<6>(P);
}

/// ln N(nu; 0, S) but for a constant; S is brought back above a tenth of `least` where it is not.
double logDensity(const Vector2& nu, Matrix2& S, const Matrix2& least)
{
  const Matrix2 own = S - 0.1 * least;
  if (!(own.trace() > 0 && own.determinant() > 0))
  {
    const math::Ellipse e = math::ellipse(own);
    const Matrix2 R = rotation(e.direction);
    S = 0.1 * least +
        R * Vector2(e.longer * e.longer, e.shorter * e.shorter).asDiagonal() * R.transpose();
  }
  return -0.5 * (nu.dot(S.inverse() * nu) + std::log(S.determinant()));
}

/// Weights times exp(logs), with sum 1; the smallest stay above what a switch can bring back.
void reweigh(ManoeuvringTarget::State& s,
             const std::array<double, ManoeuvringTarget::kMostModes>& logs)
{
  constexpr double kLeast = 1e-12;
  const double most = *std::max_element(logs.begin(), logs.begin() + s.modes);
  double sum = 0;
  for (int j = 0; j < s.modes; ++j)
  {
    auto& w = s.bank[static_cast<std::size_t>(j)].weight;
    w = std::max(kLeast, w * std::exp(logs[static_cast<std::size_t>(j)] - most));
    sum += w;
  }
  for (int j = 0; j < s.modes; ++j) s.bank[static_cast<std::size_t>(j)].weight /= sum;
}
}  // namespace

void ManoeuvringTarget::State::correct(const Vector2& nu, const Matrix2& S, const Matrix2& H,
                                       const Matrix2& doubt,
                                       const Eigen::Matrix<double, kSize, 2>& across, bool isOwn)
{
  conform();
  std::array<double, kMostModes> logs{};
  for (int j = 0; j < modes; ++j)
  {
    Member& m = bank[static_cast<std::size_t>(j)];
    const Eigen::Matrix<double, kSize, 2> more = (m.P - P).leftCols<2>() * H.transpose();
    const Vector2 own = nu - H * (m.x - x).head<2>();
    Matrix2 ownS = S + H * more.topRows<2>();
    logs[static_cast<std::size_t>(j)] = logDensity(own, ownS, S);
    const Eigen::Matrix<double, kSize, 2> PHt = across + more, K = PHt * ownS.inverse();
    m.x += K * own;
    m.P = symmetric(m.P - K * PHt.transpose() + PHt * doubt * PHt.transpose());
    if (!isOwn) m.P = positive(m.P);
  }
  reweigh(*this, logs);
  combine();
}

TargetTransition<6> transitionOf(const Matrix& from, const Matrix& to, const Rows& rows)
{
  const Eigen::Matrix4d own = to.topLeftCorner<4, 4>(), moved = rows * from * rows.transpose();
  const Stretch<4> by = stretch<4>(0.5 * (moved + moved.transpose()), own, true);
  constexpr double kRounding = 1e-13;
  const Eigen::Matrix4d some = own + kRounding * own.trace() * Eigen::Matrix4d::Identity();
  Eigen::Matrix<double, 6, 4> all;
  all << Eigen::Matrix4d::Identity(), some.ldlt().solve(to.topRightCorner<4, 2>()).transpose();
  TargetTransition<6> out;
  out.F = all * by.T * rows;
  out.Q = symmetric(to - out.F * from * out.F.transpose());
  return out;
}
}  // namespace slamot::models
