#include "ScaledCarsMotion.h"

#include <slamot/importers/CarMotion.h>

#include <algorithm>

namespace slamot::importers::scaled_cars
{
namespace
{
constexpr double kShortestRest = 0.5, kBeforeMoving = 0.1;  // [s]

/// Goes to the last row that is not after `time`; when the next one begins, if there is one.
template <class Row>
double advance(const std::vector<Row>& rows, std::size_t& row, double time)
{
  while (row + 1 < rows.size() && rows[row + 1].time <= time) ++row;
  return row + 1 < rows.size() ? rows[row + 1].time : 1e300;
}
}  // namespace

Motion::Motion(const std::string& folder, const ScaledCarsOptions& options)
    : options_(&options), wheels_(readWheels(folder)), rates_(readTurnRates(folder))
{
  begin_ = std::max(wheels_.front().time, rates_.front().time);
  end_ = std::min(wheels_.back().time, rates_.back().time);
  if (end_ <= begin_)
    throw core::Error(core::ExitStatus::kNonsense, folder,
                      "wheel_speeds.csv and imu.csv have no time in common",
                      "give the tables of one run");
  estimateBias();
}

void Motion::estimateBias()
{
  if (options_->gyroBias) bias_ = *options_->gyroBias;
  if (options_->gyroBias || options_->heading != ScaledCarsOptions::Heading::kImu) return;
  const auto moves = [](const WheelSpeeds& row)
  { return std::any_of(row.speed.begin(), row.speed.end(), [](double v) { return v != 0; }); };
  const auto moving = std::find_if(wheels_.begin(), wheels_.end(), moves);
  const double until = (moving == wheels_.end() ? end_ : moving->time) - kBeforeMoving;
  double sum = 0;
  int n = 0;
  for (const TurnRate& row : rates_)
    if (row.time >= begin_ && row.time < until) sum += row.rate, ++n;
  biasKnown_ = until - begin_ >= kShortestRest && n > 0;
  if (biasKnown_) bias_ = sum / n;
}

Gaussian<Pose2D> Motion::held(double dt) const
{
  const auto& speed = wheels_[wheel_].speed;
  const double front = options_->wheelRadius * 0.5 * (speed[0] + speed[1]);
  const double rate = options_->heading == ScaledCarsOptions::Heading::kImu
                          ? rates_[rate_].rate - bias_
                          : options_->wheelRadius * (speed[1] - speed[0]) / options_->track;
  // Wheels that stand still while the gyro trembles do not roll backwards.
  const double across = options_->wheelbase * rate;
  const double rear = std::sqrt(std::max(0.0, front * front - across * across));
  return options_->wheels.held(std::copysign(rear, front), rate, dt);
}

Gaussian<Pose2D> Motion::between(double from, double to)
{
  Gaussian<Pose2D> axle;
  while (from < to)
  {
    const double next =
        std::min({to, advance(wheels_, wheel_, from), advance(rates_, rate_, from)});
    axle = math::compose(axle, held(next - from));
    from = next;
  }
  return carriedTo({options_->ahead, 0}, axle);
}
}  // namespace slamot::importers::scaled_cars
