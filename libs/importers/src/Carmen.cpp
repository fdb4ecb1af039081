#include <slamot/core/Error.h>
#include <slamot/eval/Evaluation.h>
#include <slamot/importers/Carmen.h>

#include <cstdio>

#include "CarmenScans.h"
#include "Relations.h"

namespace slamot::importers
{
namespace
{
using carmen::Message;

constexpr double kJump = 5, kFastest = 10;  // [m], [m/s]: together, of an odometer that was reset

constexpr std::size_t kMostAtOnce = 100;  // scans of a clock that stands still

std::string timeText(double time)
{
  char text[64];
  std::snprintf(text, sizeof text, "%.6f s", time);
  return text;
}

class Carmen : public Import
{
 public:
  Carmen(const std::string& path, const CarmenOptions& options)
      : options_(options), path_(path), scans_(path, options_)
  {
    if (!options.relations.empty()) truth_.relations = readRelations(options.relations);
    next_ = scans_.next();
    if (!next_)
      throw core::Error(core::ExitStatus::kUnreadable, path,
                        scans_.unplaced() ? "no scan lies between ODOM lines less than 1 s apart"
                                          : "holds no FLASER, RLASER or ROBOTLASER message",
                        scans_.unplaced() ? "import without --odometry lines"
                                          : "give a CARMEN log with laser scans");
    starts_.time = counts_.start = next_->time;
  }

  std::optional<core::Step> next() override
  {
    if (!next_) return std::nullopt;
    const Message message = std::move(*next_);
    core::Step step;
    step.time = message.time;
    if (last_) step.odometry = motion(*last_, message);
    for (next_ = message; next_ && next_->time == step.time; next_ = scans_.next())
      if (next_->scan) add(step, next_->scan);
    last_ = message;
    if (!truth_.relations.empty()) drive_.poses.push_back({step.time, {}, true});
    if (!next_) finish();
    return deliver(std::move(step));
  }

  [[nodiscard]] double progress() const override { return scans_.log().table().progress(); }
  [[nodiscard]] const core::Starts& starts() const override { return starts_; }
  [[nodiscard]] const eval::Truth& truth() const override { return truth_; }

 private:
  void add(core::Step& step, const std::shared_ptr<const core::LaserScan>& scan) const
  {
    if (step.lasers.size() == kMostAtOnce)
      throw core::Error(core::ExitStatus::kNonsense, path_,
                        "over 100 scans are of one time, " + timeText(step.time),
                        "mend the times, the last field but two of each line");
    step.lasers.push_back(scan);
  }

  Gaussian<Pose2D> motion(const Message& from, const Message& to)
  {
    const Pose2D moved = math::between(from.odometry, to.odometry);
    const double distance = std::hypot(moved.x, moved.y);
    if (distance > kJump && distance > kFastest * (to.time - from.time))
      firstJump_ = jumps_++ == 0 ? to.time : firstJump_;
    return options_.noise.of(moved);
  }

  void warn(std::size_t n, const std::string& what)
  {
    if (n > 0) warnings_.push_back(path_ + ": " + std::to_string(n) + " " + what);
  }

  void finish()
  {
    counts_.outOfTime += scans_.unplaced();
    std::string kinds;
    for (const std::string& kind : scans_.log().unknownKinds())
      kinds += (kinds.empty() ? "" : ", ") + kind;
    warn(scans_.log().unknown(), "messages of unknown kind were left out, as " + kinds);
    warn(jumps_, "steps of odometry are over 5 m and faster than 10 m/s, the first at " +
                     timeText(firstJump_));
    if (truth_.relations.empty()) return;
    if (eval::evaluateRelations(drive_, truth_.relations)->count == 0)
      warn(truth_.relations.size(), "relations are all of times at which there is no scan");
  }

  CarmenOptions options_;
  std::string path_;
  carmen::Scans scans_;
  std::optional<Message> last_, next_;
  core::Starts starts_;
  eval::Truth truth_;
  eval::Trajectory drive_;  // times only
  std::size_t jumps_ = 0;
  double firstJump_ = 0;
};
}  // namespace

std::unique_ptr<Import> openCarmen(const std::string& path, const CarmenOptions& options)
{
  return std::make_unique<Carmen>(path, options);
}
}  // namespace slamot::importers
