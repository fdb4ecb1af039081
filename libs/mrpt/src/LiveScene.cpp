#include <slamot/mrpt/LiveScene.h>
#include <slamot/mrpt/scanPoints.h>

#include <cmath>

namespace slamot::mrpt
{
LiveScene::LiveScene(std::string title)
{
  data_.title = std::move(title);
  data_.robot.name = "robot";
  data_.robot.path.emplace_back();
}

void LiveScene::add(const core::Step& step, const core::Update& update)
{
  addEstimate(update.estimate);
  if (!step.lasers.empty()) addLasers(step, update.estimate.robot.mean);
}

void LiveScene::addEstimate(const core::Estimate& estimate)
{
  const Pose2D& robot = estimate.robot.mean;
  data_.robot.path.back().push_back({robot.x, robot.y});
  data_.robot.now = estimate.robot;
  std::set<std::size_t> here;
  for (const core::TargetEstimate& t : estimate.targets)
  {
    const auto [it, isNew] =
        targets_.emplace(std::make_pair(!t.identified, t.id), data_.targets.size());
    if (isNew) data_.targets.emplace_back();
    here.insert(it->second);
    SceneTrack& track = data_.targets[it->second];
    track.name = (t.label.empty() ? "target" : t.label) + " " + std::to_string(t.id);
    if (!track.now) track.path.emplace_back();  // new, or found again
    track.path.back().push_back({t.pose.mean.x, t.pose.mean.y});
    track.now = t.pose;
  }
  for (std::size_t i = 0; i < data_.targets.size(); ++i)
    if (here.count(i) == 0) data_.targets[i].now.reset();
}

void LiveScene::addLasers(const core::Step& step, const Pose2D& robot)
{
  data_.scanPoints.clear();
  for (const auto& scan : step.lasers) appendPoints(data_.scanPoints, *scan, robot);
  for (const Point2D& p : data_.scanPoints)
    if (data_.laserPoints.size() < kMostPoints &&
        cells_.emplace(std::lround(p.x / kCell), std::lround(p.y / kCell)).second)
      data_.laserPoints.push_back(p);
}

SceneData LiveScene::at(const core::Estimate& now, std::vector<core::WeightedPose> particles) const
{
  SceneData data = data_;
  data.particles = std::move(particles);
  if (now.landmarks != nullptr)
    now.landmarks->visit([&](const core::LandmarkEstimate& l) { data.landmarks.push_back(l); });
  return data;
}
}  // namespace slamot::mrpt
