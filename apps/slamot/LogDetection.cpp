#include "LogDetection.h"

#include "cameraOf.h"
#include "seenObservations.h"

#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <slamot/core/Error.h>
#include <slamot/mrpt/timestamp.h>

#include <cmath>

namespace slamot::apps
{
using ::mrpt::obs::CObservation;
using ::mrpt::obs::CObservationImage;
using ::mrpt::obs::CObservationOdometry;

namespace
{
constexpr double kPeriodWithoutTimes = 0.1;   // [s]
constexpr std::size_t kMostWaiting = 100000;  // entries, of a log whose clock stands still
}  // namespace

LogDetection::LogDetection(perception::Pipeline& pipeline, mrpt::RawlogEditor& editor,
                           const std::string& log)
    : pipeline_(pipeline), editor_(editor), images_(mrpt::RawlogEditor::imagesFolder(log))
{
}

bool LogDetection::advance()
{
  auto entry = editor_.next();
  const bool more = entry.has_value();
  if (more) take(std::move(*entry));
  // An image waits for the scan after it; what leaves the queue, for the images after it.
  const double apart = pipeline_.mostApart();
  for (Item& item : waiting_)
    if (!item.ranged && (!more || item.time + apart < now_)) range(item);
  while (!waiting_.empty() &&
         (!more || waiting_.size() > kMostWaiting || waiting_.front().time + 2 * apart < now_))
  {
    release(waiting_.front());
    waiting_.pop_front();
  }
  pipeline_.forgetBefore((waiting_.empty() ? now_ : waiting_.front().time) - 2 * apart);
  return more;
}

void LogDetection::take(mrpt::EditedEntry entry)
{
  ++entries_;
  // Pairs without times: each is a step of its own.
  if (entry.time)
    now_ = timed_ ? std::max(now_, *entry.time) : *entry.time, timed_ = true;
  else if (entry.increment && !timed_)
    now_ += kPeriodWithoutTimes;
  if (entry.increment)
    pipeline_.odometry().add(now_, math::compose(pipeline_.odometry().last(), *entry.increment));
  Item& item = waiting_.emplace_back();
  item.time = now_;
  item.entry = std::move(entry);
  for (std::size_t i = 0; i < item.entry.sensed.size(); ++i) takeObservation(item, i);
}

void LogDetection::takeObservation(Item& item, std::size_t index)
{
  const mrpt::SensedEntry& seen = item.entry.sensed[index];
  const auto stamp = mrpt::toSeconds(seen.observation->timestamp);
  Sensed sensed{timed_ && stamp ? *stamp : item.time, index, std::nullopt};
  if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(seen.observation.get()))
    takeOdometry(sensed.time, odometry->odometry.asTPose());
  else if (seen.laser)
  {
    pipeline_.addScan(sensed.time, seen.laser);
    item.sensed.push_back(std::move(sensed));
  }
  else if (dynamic_cast<const CObservationImage*>(seen.observation.get()) &&
           pipeline_.wantsImages())
  {
    takeImage(sensed, seen);
    if (sensed.look) item.sensed.push_back(std::move(sensed));
  }
}

// Beside movements of actions, odometry is the same again; of a log with observations only, poses
// from anywhere.
void LogDetection::takeOdometry(double time, const Pose2D& pose)
{
  if (!std::isfinite(pose.x + pose.y + pose.phi)) return;
  if (odometer_)
    pipeline_.odometry().add(
        time, math::compose(pipeline_.odometry().last(), math::between(*odometer_, pose)));
  else
    pipeline_.odometry().add(time, pipeline_.odometry().last());
  odometer_ = pose;
}

void LogDetection::takeImage(Sensed& sensed, const mrpt::SensedEntry& entry)
{
  const auto& observation = dynamic_cast<const CObservationImage&>(*entry.observation);
  try
  {
    const perception::Mount mount = mountOf(observation.cameraPose);
    const cv::Mat image = pixelsOf(observation.image, images_);
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
  observation.unload();
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
