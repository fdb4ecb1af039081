#include "CsvOdometry.h"

namespace slamot::importers
{
namespace
{
using core::ExitStatus;

const TextTable::Names kVelocities = {"t", "v", "omega", "std_v", "std_omega"};
const TextTable::Names kIncrements = {"t", "dx", "dy", "dphi", "std_x", "std_y", "std_phi"};

constexpr const char* kMendStart =
    "times count in seconds from the start, 0; if they count from an epoch, give --start-time";

// A day without odometry is a clock that doesn't start at 0.
constexpr double kLongestStep = 86400;  // [s]
}  // namespace

CsvOdometry::CsvOdometry(const std::string& folder, double startTime)
    : table_(TextTable::csv(folder + "/odometry.csv")), start_(startTime)
{
  velocities_ = table_.matchHeader({kVelocities, kIncrements}) == 0;
  ahead_ = read();
  if (!ahead_) table_.fail(ExitStatus::kUnreadable, "holds no rows", "write a row for each step");
}

bool CsvOdometry::read()
{
  if (!table_.next()) return false;
  time_ = table_.number(0);
  if (time_ < last_)
    table_.failAt(0, ExitStatus::kNonsense,
                  last_ == start_ ? "the time lies before the start" : "the time goes backwards",
                  last_ == start_ ? kMendStart : "sort the rows by time");
  if (time_ - last_ > kLongestStep)
    table_.failAt(0, ExitStatus::kNonsense, "the step lasts over a day",
                  last_ == start_ ? kMendStart : "remove rows of another day");
  return true;
}

HeldMotion CsvOdometry::rowMotion() const
{
  if (velocities_)
    return HeldMotion::fromVelocities(table_.number(1), table_.number(2), time_ - last_,
                                      table_.nonNegative(3), table_.nonNegative(4));
  Gaussian<Pose2D> increment;
  increment.mean = {table_.number(1), table_.number(2), math::wrapToPi(table_.number(3))};
  const Vector3 std(table_.nonNegative(4), table_.nonNegative(5), table_.nonNegative(6));
  increment.cov = std.cwiseAbs2().asDiagonal();
  return HeldMotion::fromIncrement(increment);
}

bool CsvOdometry::atRest(const Gaussian<Pose2D>& motion) const
{
  return time_ == last_ && motion.mean == Pose2D() && motion.cov.isZero(0);
}

std::optional<OdometryStep> CsvOdometry::next()
{
  // A row at the start itself, before anything has moved, ends no step.
  while (ahead_ && atRest(rowMotion().whole())) ahead_ = read();
  if (!ahead_) return std::nullopt;
  OdometryStep out{last_, time_, rowMotion()};
  last_ = time_;
  while ((ahead_ = read()) && time_ == out.end)
    out.motion = HeldMotion::fromIncrement(math::compose(out.motion.whole(), rowMotion().whole()));
  return out;
}
}  // namespace slamot::importers
