#include <slamot/perception/Pipeline.h>

#include <algorithm>
#include <cmath>

namespace slamot::perception
{
namespace
{
/// "none" is no list.
std::vector<std::string> namesIn(core::Params& p, const std::string& key)
{
  const auto names = p.list(key, "none");
  return names == std::vector<std::string>{"none"} ? std::vector<std::string>{} : names;
}

Camera cameraFrom(core::Params& p)
{
  Camera out;
  if (!p.has("focal_length_px"))
  {
    p.allowUnused({"image_width_px", "image_height_px", "distortion"});
    (void)p.optionalNumber("focal_length_px", 1);
    return out;
  }
  out.fx = out.fy = p.positive("focal_length_px");
  out.width = p.integer("image_width_px", 1, 100000);
  out.height = p.integer("image_height_px", 1, 100000);
  out.cx = 0.5 * (out.width - 1);
  out.cy = 0.5 * (out.height - 1);
  const auto k = p.numbers("distortion", "0, 0, 0, 0, 0");
  if (k.size() > out.distortion.size())
    p.fail("distortion", "has over 8 numbers", "give k1, k2, p1, p2, k3");
  std::copy(k.begin(), k.end(), out.distortion.begin());
  return out;
}

// Sections of what is not asked for are read all the same: so that another choice can be made on
// the command line.
std::vector<ColorClass> colorsIn(core::Config& config, core::Params& detect)
{
  const std::string prefix = "color.";
  std::map<std::string, ColorClass> known;
  for (const std::string& section : config.sections())
    if (section.rfind(prefix, 0) == 0)
    {
      const std::string label = section.substr(prefix.size());
      core::Params p(config, section);
      known[label] = ColorClass::from(p, label);
    }
  std::vector<ColorClass> out;
  for (const std::string& label : namesIn(detect, "colors"))
  {
    if (known.count(label) == 0)
      detect.fail("colors", "names '" + label + "', which has no section [color." + label + "]",
                  "write one; slamot calibrate-color proposes it");
    out.push_back(known[label]);
  }
  return out;
}

std::vector<std::unique_ptr<LandmarkDetector>> detectorsIn(core::Config& config,
                                                           core::Params& detect,
                                                           const LaserOptions& laser)
{
  const auto& registry = LandmarkDetectorRegistry::instance();
  for (const std::string& name : registry.names())
    if (config.has(name)) (void)registry.make(name, config, laser);
  std::vector<std::unique_ptr<LandmarkDetector>> out;
  for (const std::string& name : namesIn(detect, "landmarks"))
    out.push_back(registry.make(name, config, laser));
  return out;
}

Vector3 rayOf(const Camera::Direction& d)
{
  return {std::cos(d.elevation) * std::cos(d.bearing), std::cos(d.elevation) * std::sin(d.bearing),
          std::sin(d.elevation)};
}
Camera::Direction directionOf(const Vector3& ray)
{
  return {std::atan2(ray[1], ray[0]), std::atan2(ray[2], std::hypot(ray[0], ray[1]))};
}

Gaze gazeOf(const Mount& mount, const SeenDirection& seen)
{
  const Vector3 ray = mount.rotation * rayOf(seen.at);
  return {{mount.place[0], mount.place[1]}, std::atan2(ray[1], ray[0]), seen.bearingStd};
}

/// A blob with the range of an object: the line of sight turned, about the vertical, to where the
/// laser and the camera together have the object.
SeenBlob rangedAs(const SeenBlob& blob, const Mount& mount, const RangedObject& object)
{
  const Vector3 ray = mount.rotation * rayOf(blob.seen.at);
  const double level = std::hypot(ray[0], ray[1]);
  const Vector3 turned(level * std::cos(object.bearing), level * std::sin(object.bearing), ray[2]);
  SeenBlob out = blob;
  out.seen.at = directionOf(mount.rotation.transpose() * turned);
  out.seen.bearingStd = object.bearingStd;
  out.range = object.range / level;
  out.rangeStd = object.rangeStd / level;
  return out;
}
}  // namespace

Pipeline::Pipeline(core::Config& config)
{
  core::Params detect(config, "detect"), laser(config, "laser"), blobs(config, "blobs");
  core::Params ranging(config, "ranging"), camera(config, "camera");
  mostApart_ = detect.nonNegative("max_time_apart_s", 0.2);
  laser_ = LaserOptions::from(laser);
  noise_ = BlobNoise::from(blobs);
  blobRange_ = blobs.positive("max_range_m", 10.0);
  hold_ = ranging.nonNegative("keep_out_s", 1.0);
  ranging_ = RangingOptions::from(ranging);
  camera_ = cameraFrom(camera);
  colors_ = colorsIn(config, detect);
  detectors_ = detectorsIn(config, detect, laser_);
  if (colors_.empty() && detectors_.empty())
    detect.fail("landmarks", "and colors are both none: there is nothing to detect",
                "name some, such as landmarks = posts, or colors = target");
}

double Pipeline::landmarkRange() const
{
  double out = 0;
  for (const auto& d : detectors_) out = std::max(out, d->maxRange());
  return std::min(out, laser_.maxRange);
}

void Pipeline::addScan(double time, std::shared_ptr<const core::LaserScan> scan)
{
  auto clusters = clustersOf(*scan, laser_);
  scans_.push_back({time, std::move(scan), std::move(clusters)});
}

Look Pipeline::look(double time, const std::string& sensor, const cv::Mat& image,
                    const Camera& camera, const Mount& mount)
{
  const auto eye = eyes_.try_emplace(sensor, colors_).first;
  Look out{time, mount, camera.scaledTo(image.cols, image.rows), {}};
  for (const ImageBlob& b : eye->second.detect(image))
  {
    const SeenDirection seen = perception::directionOf(b, out.camera, noise_);
    out.blobs.push_back({b, seen, std::nullopt, 0});
    ++counts_.blobs;
    counts_.cut += b.cut ? 1 : 0;
  }
  ++counts_.images;
  return out;
}

// Of each laser, in the scan that is nearest in time; what two see is one.
std::vector<RangedObject> Pipeline::objectsOf(const Look& look, const SeenBlob& blob) const
{
  constexpr double kSame = 0.2;  // [m]
  std::vector<const TimedScan*> nearest;
  for (const TimedScan& s : scans_)
  {
    if (std::abs(s.time - look.time) > mostApart_) continue;
    const auto same = std::find_if(nearest.begin(), nearest.end(),
                                   [&](const TimedScan* n) {
                                     return n->scan->pose_robot_sensor == s.scan->pose_robot_sensor;
                                   });
    if (same == nearest.end())
      nearest.push_back(&s);
    else if (std::abs(s.time - look.time) < std::abs((*same)->time - look.time))
      *same = &s;
  }
  RangingOptions options = ranging_;
  options.object = colors_[blob.image.colorClass].object;
  const Gaze gaze = gazeOf(look.mount, blob.seen);
  std::vector<RangedObject> out;
  for (const TimedScan* s : nearest)
    for (const RangedObject& o : objectsSeen(gaze, odometry_.between(look.time, s->time), *s->scan,
                                             s->clusters, laser_, options))
    {
      const auto isIt = [&](const RangedObject& other)
      {
        return std::hypot(o.center.mean.x - other.center.mean.x,
                          o.center.mean.y - other.center.mean.y) < kSame;
      };
      const bool known = nearest.size() > 1 && std::any_of(out.begin(), out.end(), isIt);
      // Farther than blobs are said to be seen, a reader would drop the bearing too.
      if (!known && o.range <= blobRange_) out.push_back(o);
    }
  std::sort(out.begin(), out.end(),
            [](const RangedObject& a, const RangedObject& b) { return a.range < b.range; });
  return out;
}

void Pipeline::rangeOne(const Look& look, const SeenBlob& blob, std::vector<SeenBlob>& out)
{
  using Ambiguous = RangingOptions::Ambiguous;
  auto objects = objectsOf(look, blob);
  if (objects.empty()) ++counts_.unreached;
  if (objects.size() > 1)
  {
    ++counts_.ambiguous;
    if (ranging_.ambiguous == Ambiguous::kRefuse) objects.clear();
    if (ranging_.ambiguous == Ambiguous::kNearest) objects.resize(1);
  }
  if (objects.empty()) out.push_back(blob);
  const Pose2D robot = odometry_.at(look.time);
  const double radius = colors_[blob.image.colorClass].object.radius;
  for (const RangedObject& object : objects)
  {
    out.push_back(rangedAs(blob, look.mount, object));
    movers_.push_back({look.time, math::transform(robot, object.center.mean), radius});
    ++counts_.ranged;
  }
}

void Pipeline::range(Look& look)
{
  std::vector<SeenBlob> out;
  for (const SeenBlob& blob : look.blobs) rangeOne(look, blob, out);
  look.blobs = std::move(out);
}

bool Pipeline::isMoving(double time, const Cluster& cluster) const
{
  constexpr double kMargin = 0.3;  // [m]: how far it may have gone, and how badly it was seen
  const Pose2D robot = odometry_.at(time);
  const Point2D middle = math::transform(robot, cluster.points[cluster.points.size() / 2].at);
  return std::any_of(movers_.begin(), movers_.end(),
                     [&](const Mover& m)
                     {
                       return std::abs(m.time - time) <= hold_ &&
                              std::hypot(m.at.x - middle.x, m.at.y - middle.y) < m.radius + kMargin;
                     });
}

std::vector<DetectedLandmark> Pipeline::landmarks(double time, const core::LaserScan& scan)
{
  ++counts_.scans;
  std::vector<DetectedLandmark> out;
  const auto known = std::find_if(scans_.begin(), scans_.end(),
                                  [&](const TimedScan& s) { return s.scan.get() == &scan; });
  std::vector<Cluster> still = known != scans_.end() ? known->clusters : clustersOf(scan, laser_);
  const std::size_t all = still.size();
  still.erase(std::remove_if(still.begin(), still.end(),
                             [&](const Cluster& c) { return isMoving(time, c); }),
              still.end());
  counts_.moving += all - still.size();
  for (const auto& detector : detectors_)
    for (DetectedLandmark& l : detector->detect(scan, still)) out.push_back(std::move(l));
  counts_.landmarks += out.size();
  return out;
}

void Pipeline::forgetBefore(double time)
{
  odometry_.forgetBefore(time - hold_);
  const auto forget = [](auto& all, double before)
  {
    all.erase(
        std::remove_if(all.begin(), all.end(), [&](const auto& a) { return a.time < before; }),
        all.end());
  };
  forget(scans_, time);
  forget(movers_, time - hold_);
}
}  // namespace slamot::perception
