#include <slamot/mrpt/Scene.h>

#include "Legend.h"
#include "Mesh.h"
#include "SceneFrame.h"
#include "view.h"

#include <array>
#include <filesystem>

#include SLAMOT_SCENE_HEADER
#include SLAMOT_VIZ(CGridPlaneXY.h)
#include SLAMOT_VIZ(CPointCloud.h)

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include "GzWriter.h"

namespace slamot::mrpt
{
namespace
{
using Colour = ::mrpt::img::TColor;

// The colours of the report's plots.
const Colour kRobot(0x00, 0x72, 0xb2), kLandmark(0x00, 0x9e, 0x73), kTruth(0x24, 0x29, 0x2f);
const Colour kFaint(0xad, 0xb5, 0xbd), kLaser(0x8c, 0x95, 0x9f), kParticle(0x56, 0xb4, 0xe9);
constexpr std::size_t kNamedTargets = 6;  // more do not fit the legend
const std::array<Colour, 5> kTargets{Colour(0xd5, 0x5e, 0x00), Colour(0xb0, 0x57, 0x8d),
                                     Colour(0xe6, 0x9f, 0x00), Colour(0x56, 0xb4, 0xe9),
                                     Colour(0x00, 0x9e, 0x73)};

// Of a team's robots; the landmarks' green is not among them.
const std::array<Colour, 5> kTeam{kRobot, kTargets[0], kTargets[1], kTargets[2], kTargets[3]};

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

class SceneBuilder
{
 public:
  explicit SceneBuilder(const SceneData& data) : data_(data), frame_(data) {}

  MrptScene build()
  {
    addGround();
    addPoints("laser points", data_.laserPoints, kLaser, kLaserLayer, 2);
    addLandmarks();
    if (data_.team.empty()) addTrack(data_.robot, kRobot);
    addTeam();
    for (std::size_t i = 0; i < data_.targets.size(); ++i)
      addTrack(data_.targets[i], kTargets[i % kTargets.size()]);
    addTruth(data_.robot, kTruth);
    for (std::size_t i = 0; i < data_.targets.size(); ++i)
      addTruth(data_.targets[i], darkened(kTargets[i % kTargets.size()]));
    addParticles();
    scene_.getViewport()->setCustomBackgroundColor({1.0f, 1.0f, 1.0f});
    addLegend();
    if (!shownByDefault()) addOverview();
    return scene_;
  }

 private:
  void addLegend()
  {
    Legend legend(scene_, data_.title);
    if (data_.team.empty()) legend.line(data_.robot.name, kRobot);
    addTeamLegend(legend);
    for (std::size_t i = 0; i < std::min<std::size_t>(data_.targets.size(), kNamedTargets); ++i)
      legend.line(data_.targets[i].name, kTargets[i % kTargets.size()]);
    if (hasTruePaths()) legend.thinLine("true paths", kTruth);
    if (!data_.landmarks.empty()) legend.ellipse("landmarks, 95%", kLandmark);
    if (!data_.trueLandmarks.empty()) legend.cross("true landmarks", kTruth);
    if (!data_.laserPoints.empty()) legend.dots("laser points", kLaser);
    if (!data_.particles.empty()) legend.dots("particles", kParticle);
    legend.thinLine("grid of " + frame_.gridText(), kFaint);
    legend.finish();
  }

  void addTeamLegend(Legend& legend)
  {
    for (std::size_t i = 0; i < std::min<std::size_t>(data_.team.size(), kNamedTargets); ++i)
      legend.line(data_.team[i].robot.name, kTeam[i % kTeam.size()]);
    if (data_.team.empty()) return;
    legend.thinLine("target, by each", kTeam[0]);
    const bool any = std::any_of(data_.team.begin(), data_.team.end(),
                                 [](const SceneMember& m) { return !m.fusions.empty(); });
    if (any)
      legend.ellipse("fusions, " + std::to_string(std::lround(data_.fusionScale)) + ":1", kTeam[0]);
  }

  [[nodiscard]] bool hasTruePaths() const
  {
    return !data_.robot.truth.empty() ||
           std::any_of(data_.team.begin(), data_.team.end(),
                       [](const SceneMember& m) { return !m.robot.truth.empty(); });
  }

  /// Whether SceneViewer3D's first view, of 20 m about the origin, has most of the ground in it.
  [[nodiscard]] bool shownByDefault() const
  {
    return std::max({-frame_.xMin, frame_.xMax, -frame_.yMin, frame_.yMax}) < 10;
  }

  /// The whole map, small, in a corner: the user sees where to go.
  void addOverview()
  {
    auto view = scene_.createViewport("overview");
    view->setCloneView("main");
    view->setViewportPosition(0.01, 0.01, 0.4, 0.4);
    view->setBorderSize(1);
    view->setCustomBackgroundColor({1.0f, 1.0f, 1.0f});
    const double height = std::max(frame_.yMax - frame_.yMin, (frame_.xMax - frame_.xMin) / 1.3);
    auto camera = slamot_viz::CCamera::Create();
    camera->setPointingAt((frame_.xMin + frame_.xMax) / 2, (frame_.yMin + frame_.yMax) / 2, 0);
    camera->setZoomDistance(static_cast<float>(kOrthogonalZoom * 1.05 * height));
    camera->setAzimuthDegrees(-90);
    camera->setElevationDegrees(90);
    camera->setProjectiveModel(false);
    view->insert(camera);
  }

  [[nodiscard]] double u() const { return frame_.unit; }
  [[nodiscard]] double z(int layer) const { return 0.5 * u() * layer; }

  void addGround()
  {
    auto grid = slamot_viz::CGridPlaneXY::Create(
        static_cast<float>(frame_.xMin), static_cast<float>(frame_.xMax),
        static_cast<float>(frame_.yMin), static_cast<float>(frame_.yMax),
        static_cast<float>(z(kGridLayer)), static_cast<float>(frame_.gridStep));
    grid->setColor_u8(kFaint);
    grid->setName("grid");
    scene_.insert(grid);
  }

  void addPoints(const std::string& name, const std::vector<Point2D>& points, const Colour& colour,
                 int layer, float size)
  {
    if (points.empty()) return;
    auto cloud = slamot_viz::CPointCloud::Create();
    for (const Point2D& p : points)
      cloud->insertPoint(static_cast<float>(p.x), static_cast<float>(p.y),
                         static_cast<float>(z(layer)));
    cloud->setColor_u8(colour);
    cloud->setPointSize(size);
    cloud->setName(name);
    scene_.insert(cloud);
  }

  void addLandmarks()
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
      scene_.insert(ellipses.object("landmark ellipses"));
      scene_.insert(posts.object("landmarks"));
    }
    if (!data_.trueLandmarks.empty()) scene_.insert(crosses.object("true landmarks"));
  }

  void addTeam()
  {
    for (std::size_t i = 0; i < data_.team.size(); ++i)
    {
      const SceneMember& member = data_.team[i];
      const Colour& colour = kTeam[i % kTeam.size()];
      addTrack(member.robot, colour);
      // What overlaps lies on top of each other, not at one height, where it would flicker.
      const double lift =
          0.4 * u() * static_cast<double>(i) / static_cast<double>(data_.team.size());
      addPath(member.target, colour, 0.25, lift);
      addTruth(member.robot, kTruth);
      addTruth(member.target, kTruth);
      Mesh ellipses(colour);
      for (const SceneFusion& f : member.fusions)
      {
        ellipses.ellipse(scaled(f.before), 0.1 * u(), z(kEllipseLayer) + lift, false);
        ellipses.ellipse(scaled(f.after), 0.1 * u(), z(kEllipseLayer) + lift);
      }
      if (!member.fusions.empty()) scene_.insert(ellipses.object(member.robot.name + " fusions"));
    }
  }

  [[nodiscard]] Gaussian<Point2D> scaled(const Gaussian<Point2D>& g) const
  {
    return {g.mean, data_.fusionScale * data_.fusionScale * g.cov};
  }

  /// \param width of the ribbon [in the frame's unit]
  void addPath(const SceneTrack& track, const Colour& colour, double width, double lift = 0)
  {
    Mesh path(colour);
    for (const Polyline& piece : track.path) path.ribbon(piece, width * u(), z(kPathLayer) + lift);
    scene_.insert(path.object(track.name + " path"));
  }

  void addTrack(const SceneTrack& track, const Colour& colour)
  {
    addPath(track, colour, 0.5);
    if (!track.now) return;
    const Gaussian<Pose2D>& now = *track.now;
    const Point2D place{now.mean.x, now.mean.y};
    addEllipse(track.name + " ellipse", {place, now.cov.topLeftCorner<2, 2>()}, colour);
    Mesh body(colour);
    body.prism(place, dart(now.mean, 3.5 * u()), z(kBodyLayer), z(kBodyLayer) + 1.5 * u());
    scene_.insert(body.object(track.name));
  }

  /// Where a track is at the end; one that may be almost anywhere must not hide the map.
  void addEllipse(const std::string& name, const Gaussian<Point2D>& g, const Colour& colour)
  {
    const double size = std::sqrt(g.cov.trace());
    if (size > 20 * u()) return;
    Mesh ellipse(colour);
    ellipse.ellipse(g, 0.15 * u(), z(kEllipseLayer), size < 4 * u());
    scene_.insert(ellipse.object(name));
  }

  void addTruth(const SceneTrack& track, const Colour& colour)
  {
    if (track.truth.empty()) return;
    Mesh lines(colour);
    for (const Polyline& piece : track.truth) lines.ribbon(piece, 0.18 * u(), z(kTruthLayer));
    scene_.insert(lines.object(track.name + " truth"));
  }

  void addParticles()
  {
    std::vector<Point2D> places;
    for (const auto& p : data_.particles) places.push_back({p.pose.x, p.pose.y});
    addPoints("particles", places, kParticle, kBodyLayer + 4, 3);
  }

  const SceneData& data_;
  SceneFrame frame_;
  MrptScene scene_;
};
}  // namespace

void saveScene(const std::string& path, const SceneData& data)
{
  const MrptScene scene = SceneBuilder(data).build();
  ::mrpt::io::CMemoryStream bytes;
  auto archive = ::mrpt::serialization::archiveFrom(bytes);
  archive << scene;
  GzWriter file(path);
  file.write(bytes.getRawBufferData(), bytes.getTotalBytesCount());
  file.close();
}
}  // namespace slamot::mrpt
