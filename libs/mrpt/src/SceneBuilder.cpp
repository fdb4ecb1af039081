#include "SceneBuilder.h"

#include "Mesh.h"
#include "palette.h"

#include SLAMOT_SCENE_HEADER
#include SLAMOT_VIZ(CGridPlaneXY.h)
#include SLAMOT_VIZ(CPointCloud.h)

namespace slamot::mrpt
{
namespace
{
Colour darkened(const Colour& c)
{
  const auto part = [](std::uint8_t v) { return static_cast<std::uint8_t>(v / 2); };
  return {part(c.R), part(c.G), part(c.B)};
}

/// Heights [in the frame's unit]: far enough apart for a depth buffer whose clip planes a file
/// can't tell.
enum Layer
{
  kGridLayer = 0,
  kLaserLayer = 1,
  kEllipseLayer = 2,
  kPathLayer = 3,
  kTruthLayer = 4,
  kBodyLayer = 5
};

}  // namespace

void SceneBuilder::addObjects(MrptScene& scene)
{
  scene_ = &scene;
  addGround();
  addPoints("laser points", data_.laserPoints, kLaser, kLaserLayer, 2);
  addPoints("scan", data_.scanPoints, kScan, kEllipseLayer, 5);
  addLandmarks();
  addSightings();
  if (data_.team.empty()) addTrack(data_.robot, kRobot);
  addTeam();
  for (std::size_t i = 0; i < data_.targets.size(); ++i)
    addTrack(data_.targets[i], targetColour(i));
  addTruth(data_.robot, kTruth);
  for (std::size_t i = 0; i < data_.targets.size(); ++i)
    addTruth(data_.targets[i], darkened(targetColour(i)));
  addParticles();
}

void SceneBuilder::insert(const slamot_viz::CRenderizable::Ptr& object)
{
  scene_->insert(object);
}

void SceneBuilder::addSightings()
{
  if (data_.sightings.empty()) return;
  Mesh rays(kSighting);
  for (const Polyline& ray : data_.sightings) rays.ribbon(ray, 0.14 * u(), z(kEllipseLayer));
  insert(rays.object("sightings"));
}

void SceneBuilder::addGround()
{
  auto grid = slamot_viz::CGridPlaneXY::Create(
      static_cast<float>(frame_.xMin), static_cast<float>(frame_.xMax),
      static_cast<float>(frame_.yMin), static_cast<float>(frame_.yMax),
      static_cast<float>(z(kGridLayer)), static_cast<float>(frame_.gridStep));
  grid->setColor_u8(kFaint);
  grid->setName("grid");
  insert(grid);
}

void SceneBuilder::addPoints(const std::string& name, const std::vector<Point2D>& points,
                             const Colour& colour, int layer, float size)
{
  if (points.empty()) return;
  auto cloud = slamot_viz::CPointCloud::Create();
  for (const Point2D& p : points)
    cloud->insertPoint(static_cast<float>(p.x), static_cast<float>(p.y),
                       static_cast<float>(z(layer)));
  cloud->setColor_u8(colour);
  cloud->setPointSize(size);
  cloud->setName(name);
  insert(cloud);
}

void SceneBuilder::addLandmarks()
{
  Mesh ellipses(kLandmark), posts(kLandmark), crosses(kTruth);
  for (const auto& l : data_.landmarks)
  {
    ellipses.ellipse(l.position, 0.15 * u(), z(kEllipseLayer));
    posts.post(l.position.mean, 0.32 * u(), 0, 3.5 * u());
  }
  for (const Point2D& p : data_.trueLandmarks)
    crosses.cross(p, 0.9 * u(), 0.16 * u(), z(kTruthLayer));
  if (!data_.landmarks.empty())
  {
    insert(ellipses.object("landmark ellipses"));
    insert(posts.object("landmarks"));
  }
  if (!data_.trueLandmarks.empty()) insert(crosses.object("true landmarks"));
}

void SceneBuilder::addTeam()
{
  for (std::size_t i = 0; i < data_.team.size(); ++i)
  {
    const SceneMember& member = data_.team[i];
    const Colour& colour = teamColour(i);
    addTrack(member.robot, colour);
    // What overlaps lies on top of each other, not at one height, where it would flicker.
    const double lift = 0.4 * u() * static_cast<double>(i) / static_cast<double>(data_.team.size());
    addPath(member.target, colour, 0.25, lift);
    if (member.target.now) addTargetBody(member.target, colour, lift);
    addTruth(member.robot, kTruth);
    addTruth(member.target, kTruth);
    Mesh ellipses(colour);
    for (const SceneFusion& f : member.fusions)
    {
      ellipses.ellipse(scaled(f.before), 0.1 * u(), z(kEllipseLayer) + lift, false);
      ellipses.ellipse(scaled(f.after), 0.1 * u(), z(kEllipseLayer) + lift);
    }
    if (!member.fusions.empty()) insert(ellipses.object(member.robot.name + " fusions"));
  }
}

/// Where a robot of a team believes the target to be: small, since others believe it too.
void SceneBuilder::addTargetBody(const SceneTrack& target, const Colour& colour, double lift)
{
  const Pose2D& now = target.now->mean;
  Mesh body(colour);
  body.prism({now.x, now.y}, dart(now, 1.8 * u()), z(kBodyLayer) + lift,
             z(kBodyLayer) + lift + 0.8 * u());
  insert(body.object(target.name));
}

Gaussian<Point2D> SceneBuilder::scaled(const Gaussian<Point2D>& g) const
{
  return {g.mean, data_.fusionScale * data_.fusionScale * g.cov};
}

/// \param width of the ribbon [in the frame's unit]
void SceneBuilder::addPath(const SceneTrack& track, const Colour& colour, double width, double lift)
{
  Mesh path(colour);
  for (const Polyline& piece : track.path) path.ribbon(piece, width * u(), z(kPathLayer) + lift);
  insert(path.object(track.name + " path"));
}

void SceneBuilder::addTrack(const SceneTrack& track, const Colour& colour)
{
  addPath(track, colour, 0.5);
  if (!track.now) return;
  const Gaussian<Pose2D>& now = *track.now;
  const Point2D place{now.mean.x, now.mean.y};
  addEllipse(track.name + " ellipse", {place, now.cov.topLeftCorner<2, 2>()}, colour);
  Mesh body(colour);
  body.prism(place, dart(now.mean, 3.5 * u()), z(kBodyLayer), z(kBodyLayer) + 1.5 * u());
  insert(body.object(track.name));
}

/// Where a track is at the end; one that may be almost anywhere must not hide the map.
void SceneBuilder::addEllipse(const std::string& name, const Gaussian<Point2D>& g,
                              const Colour& colour)
{
  const double size = std::sqrt(g.cov.trace());
  if (size > 20 * u()) return;
  Mesh ellipse(colour);
  ellipse.ellipse(g, 0.15 * u(), z(kEllipseLayer), size < 4 * u());
  insert(ellipse.object(name));
}

void SceneBuilder::addTruth(const SceneTrack& track, const Colour& colour)
{
  if (track.truth.empty()) return;
  Mesh lines(colour);
  for (const Polyline& piece : track.truth) lines.ribbon(piece, 0.18 * u(), z(kTruthLayer));
  insert(lines.object(track.name + " truth"));
}

void SceneBuilder::addParticles()
{
  std::vector<Point2D> places;
  for (const auto& p : data_.particles) places.push_back({p.pose.x, p.pose.y});
  addPoints("particles", places, kParticle, kBodyLayer + 4, 3);
}
}  // namespace slamot::mrpt
