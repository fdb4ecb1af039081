#include "LogDetection.h"

#include "cameraOf.h"
#include "seenObservations.h"

#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <slamot/core/Error.h>
#include <slamot/mrpt/timestamp.h>

#include <cmath>
#include <cstdio>

namespace slamot::apps
{
using ::mrpt::obs::CObservation;
using ::mrpt::obs::CObservationImage;
using ::mrpt::obs::CObservationOdometry;

namespace
{
constexpr double kPeriodWithoutTimes = 0.1;  // [s]
constexpr double kJitter = 0.1;              // [s]: sensors hand in a little late
constexpr std::size_t kMostWaiting = 10000;  // entries
constexpr std::size_t kMostWaitingBytes = 256u << 20;
}  // namespace

LogDetection::LogDetection(perception::Pipeline& pipeline, mrpt::RawlogEditor& editor,
                           const std::string& log)
    : pipeline_(pipeline),
      editor_(editor),
      images_(mrpt::RawlogEditor::imagesFolder(log)),
      log_(log)
{
}

// Of a log whose clock stands still, nothing would ever have waited long enough.
bool LogDetection::isLong() const
{
  return waiting_.size() > kMostWaiting || waitingBytes_ > kMostWaitingBytes;
}

bool LogDetection::advance()
{
  auto entry = editor_.next();
  const bool more = entry.has_value();
  if (more) take(std::move(*entry));
  // An image waits for the scan after it; what leaves the queue, for the images after it.
  const double apart = pipeline_.mostApart();
  for (Item& item : waiting_)
  {
    if (more && item.last + apart >= now_) break;
    if (!item.ranged) range(item);
  }
  while (!waiting_.empty() && (!more || isLong() || waiting_.front().last + 2 * apart < now_))
  {
    release(waiting_.front());
    waitingBytes_ -= waiting_.front().entry.size();
    waiting_.pop_front();
  }
  double oldest = now_;
  for (const Item& item : waiting_) oldest = std::min(oldest, item.first);
  pipeline_.forgetBefore(oldest - 2 * apart);
  return more;
}

// By what was sensed: an action's clock, or a comment's, may be another.
void LogDetection::setTimes(Item& item)
{
  bool known = false;
  for (const mrpt::SensedEntry& seen : item.entry.sensed)
    if (const auto t = mrpt::toSeconds(seen.observation->timestamp))
    {
      item.first = known ? std::min(item.first, *t) : *t;
      item.last = known ? std::max(item.last, *t) : *t;
      known = true;
    }
  if (!known)
  {
    // Pairs without times: each is a step of its own; so is each observation.
    if (!timed_ && !item.entry.isFrame()) now_ += kPeriodWithoutTimes;
    item.first = item.last = now_;
    return;
  }
  if (timed_ && item.first < now_ - 2 * pipeline_.mostApart() - kJitter)
  {
    char what[96];
    std::snprintf(what, sizeof what, "time %.6f s follows %.6f s", item.first, now_);
    throw core::Error(core::ExitStatus::kNonsense, log_ + " entry " + std::to_string(entries_ - 1),
                      what, "sort it with RawLogViewer (Re-sort by timestamp)");
  }
  now_ = timed_ ? std::max(now_, item.last) : item.last;
  timed_ = true;
}

void LogDetection::take(mrpt::EditedEntry entry)
{
  ++entries_;
  Item& item = waiting_.emplace_back();
  waitingBytes_ += entry.size();
  item.entry = std::move(entry);
  setTimes(item);
  if (item.entry.increment)
  {
    hasActions_ = true;
    moved_ = math::compose(moved_.value_or(Pose2D()), *item.entry.increment);
  }
  else if (moved_ && !item.entry.sensed.empty())  // where the robot was when that was sensed
  {
    pipeline_.odometry().add(item.first, math::compose(pipeline_.odometry().last(), *moved_));
    moved_.reset();
  }
  for (std::size_t i = 0; i < item.entry.sensed.size(); ++i) takeObservation(item, i);
}

void LogDetection::takeObservation(Item& item, std::size_t index)
{
  const mrpt::SensedEntry& seen = item.entry.sensed[index];
  const auto stamp = mrpt::toSeconds(seen.observation->timestamp);
  Sensed sensed{stamp ? *stamp : item.first, index, std::nullopt};
  if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(seen.observation.get()))
    takeOdometry(sensed.time, odometry->sensorLabel, odometry->odometry.asTPose());
  else if (seen.laser)
  {
    pipeline_.addScan(sensed.time, seen.laser);
    item.sensed.push_back(std::move(sensed));
  }
  else if (dynamic_cast<const CObservationImage*>(seen.observation.get()) != nullptr &&
           pipeline_.wantsImages())
  {
    takeImage(sensed, item, seen);
    if (sensed.look) item.sensed.push_back(std::move(sensed));
  }
}

// Beside movements of actions, odometry is the same again; of several odometers the first counts.
void LogDetection::takeOdometry(double time, const std::string& sensor, const Pose2D& pose)
{
  if (hasActions_ || !std::isfinite(pose.x + pose.y + pose.phi)) return;
  if (!odometer_) odometerLabel_ = sensor;
  if (sensor != odometerLabel_) return;
  if (odometer_)
    pipeline_.odometry().add(
        time, math::compose(pipeline_.odometry().last(), math::between(*odometer_, pose)));
  else
    pipeline_.odometry().add(time, pipeline_.odometry().last());
  odometer_ = pose;
}

void LogDetection::takeImage(Sensed& sensed, const Item& item, const mrpt::SensedEntry& seen)
{
  const auto& observation = dynamic_cast<const CObservationImage&>(*seen.observation);
  try
  {
    const perception::Mount mount = mountOf(observation.cameraPose);
    const cv::Mat image = pixelsOf(item.entry, seen, images_);
    const perception::Camera camera = cameraOf(observation, pipeline_.defaultCamera());
    if (!camera.makesSense())
      throw core::Error(core::ExitStatus::kConfig, observation.sensorLabel,
                        "the log's camera has no focal length, or none that makes sense",
                        "set focal_length_px, image_width_px and image_height_px in [camera]");
    if (image.channels() == 1) ++blind_;
    sensed.look = pipeline_.look(sensed.time, observation.sensorLabel, image, camera, mount);
  }
  catch (const NoImage& e)
  {
    ++unreadable_;
    unreadableWhat_ = e.what();
  }
}

void LogDetection::range(Item& item)
{
  for (Sensed& sensed : item.sensed)
    if (sensed.look) pipeline_.range(*sensed.look);
  item.ranged = true;
}

void LogDetection::release(Item& item)
{
  if (!item.ranged) range(item);
  std::vector<std::shared_ptr<CObservation>> added;
  for (const Sensed& sensed : item.sensed)
  {
    const mrpt::SensedEntry& source = item.entry.sensed[sensed.index];
    if (sensed.look)
      added.push_back(blobsObservation(*sensed.look, *source.observation, pipeline_));
    else if (pipeline_.wantsLandmarks())
      added.push_back(landmarksObservation(pipeline_.landmarks(sensed.time, *source.laser),
                                           *source.laser, *source.observation, pipeline_));
  }
  editor_.write(item.entry, added);
}

std::vector<std::string> LogDetection::warnings() const
{
  std::vector<std::string> out;
  if (unreadable_ > 0)
    out.push_back(std::to_string(unreadable_) +
                  " images can't be read, and count as not looked at: " + unreadableWhat_);
  if (blind_ > 0)
    out.push_back(std::to_string(blind_) + " images are grey, where no colour can be found");
  if (pipeline_.wantsImages() && counts().images == 0)
    out.emplace_back("the log holds no image that can be looked through");
  if (pipeline_.wantsLandmarks() && counts().scans == 0)
    out.emplace_back("the log holds no laser scan");
  return out;
}
}  // namespace slamot::apps
