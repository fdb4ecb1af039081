#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <slamot/core/Error.h>
#include <slamot/core/FilterRegistry.h>
#include <slamot/filters/registerAll.h>
#include <slamot/mrpt/CLandmarkGaussianMap.h>
#include <slamot/mrpt/LiveScene.h>
#include <slamot/mrpt/LiveSteps.h>
#include <slamot/mrpt/MapBuilder.h>
#include <slamot/mrpt/Renderer.h>
#include <slamot/results/RunPlan.h>
#include <slamot/scans/registerAll.h>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace slamot::mrpt
{
namespace
{
using ::mrpt::maps::CMultiMetricMap;
using ::mrpt::maps::CSimpleMap;
using ::mrpt::obs::CSensoryFrame;
using ::mrpt::poses::CPose3DPDFGaussian;
using ::mrpt::poses::CPosePDFGaussian;

// As the maps of slamot run.
constexpr double kFrameDistance = 0.1;              // [m]
constexpr double kFrameTurn = math::degToRad(5.0);  // [rad]

std::shared_ptr<CPose3DPDFGaussian> poseOf(const Gaussian<Pose2D>& g)
{
  const auto pose = std::make_shared<CPose3DPDFGaussian>();
  pose->copyFrom(CPosePDFGaussian(::mrpt::poses::CPose2D(g.mean.x, g.mean.y, g.mean.phi),
                                  ::mrpt::math::CMatrixDouble33(g.cov)));
  return pose;
}

core::ObjectStart startOf(const ::mrpt::poses::CPosePDF& pdf)
{
  const auto [cov, mean] = pdf.getCovarianceAndMean();
  core::ObjectStart start;
  const double values[] = {mean.x(), mean.y(), mean.phi()};
  for (int i = 0; i < 3; ++i)
  {
    start.value[static_cast<std::size_t>(i)] = values[i];
    start.std[static_cast<std::size_t>(i)] = std::sqrt(std::max(0.0, cov(i, i)));
  }
  return start;
}
}  // namespace

struct MapBuilder::Parts
{
  core::Config config;
  results::RunPlan plan;
  RawlogSource::Options options;
  int threads;

  core::Starts starts;
  std::unique_ptr<core::Filter> filter;
  std::unique_ptr<LiveSteps> steps;
  std::unique_ptr<LiveScene> scene;
  core::Estimate estimate;
  CSimpleMap frames;
  std::vector<CSensoryFrame> held;  // observed, in the instant that may still go on
  std::optional<Pose2D> lastFrame;
  CMultiMetricMap metricMap;
  std::shared_ptr<maps::CLandmarkGaussianMap> landmarks;

  Parts(core::Config c, const core::Starts& s, int t)
      : config(std::move(c)),
        plan(results::planRun(config, s)),
        options(RawlogSource::Options::from(config)),
        threads(t),
        landmarks(std::make_shared<maps::CLandmarkGaussianMap>())
  {
    metricMap.maps.push_back(landmarks);
    begin(plan.starts);
    config.requireAllRead(core::FilterRegistry::instance().names());
  }

  void begin(const core::Starts& from)
  {
    core::FilterContext context;
    context.starts = starts = from;
    context.seed = plan.seed;
    context.threads = threads;
    filter = core::FilterRegistry::instance().make(plan.method, config, context);
    steps = std::make_unique<LiveSteps>(options, from.time);
    scene = std::make_unique<LiveScene>(plan.method);
    estimate = filter->estimate();
    scene->begin(estimate);
    frames.clear();
    lastFrame.reset();
    *landmarks = maps::CLandmarkGaussianMap();
  }

  void process(const std::vector<core::Step>& all)
  {
    for (const core::Step& step : all)
    {
      const core::Update update = filter->process(step);
      scene->add(step, update);
      estimate = update.estimate;
    }
    if (!all.empty() && estimate.landmarks != nullptr)
      *landmarks = maps::CLandmarkGaussianMap::fromView(*estimate.landmarks);
  }

  /// \param add gives steps.  Where it throws, those that came before count all the same.
  template <class Add>
  bool processWhat(Add&& add)
  {
    std::vector<core::Step> all;
    try
    {
      all = add();
    }
    catch (...)
    {
      process(steps->complete());
      throw;
    }
    process(all);
    return !all.empty();
  }

  [[nodiscard]] bool isFarFromLastFrame() const
  {
    if (!lastFrame) return true;
    const Pose2D since = math::between(*lastFrame, estimate.robot.mean);
    return std::hypot(since.x, since.y) >= kFrameDistance || std::abs(since.phi) >= kFrameTurn;
  }
  void addFrame(const std::shared_ptr<CSensoryFrame>& frame)
  {
    frames.insert(poseOf(estimate.robot), frame);
    lastFrame = estimate.robot.mean;
  }
};

MapBuilder::MapBuilder(core::Config config, const core::Starts& starts, int threads)
{
  filters::registerAll();
  scans::registerAll();
  parts_ = std::make_unique<Parts>(std::move(config), starts, threads);
}

MapBuilder::~MapBuilder() = default;

void MapBuilder::initialize(const CSimpleMap& initialMap, const ::mrpt::poses::CPosePDF* x0)
{
  if (!initialMap.empty())
    throw core::Error(core::ExitStatus::kConfig, "MapBuilder",
                      "can't begin with a map that was built before", "give an empty one");
  const std::lock_guard lock(critZoneChangingMap);
  core::Starts starts = parts_->plan.starts;
  if (x0 != nullptr) starts.robot = startOf(*x0);
  parts_->begin(starts);
}

void MapBuilder::processActionObservation(::mrpt::obs::CActionCollection& action,
                                          CSensoryFrame& observations)
{
  const std::lock_guard lock(critZoneChangingMap);
  parts_->processWhat([&] { return parts_->steps->add(action, observations); });
  keep(observations);
}

void MapBuilder::processObservation(const ::mrpt::obs::CObservation::Ptr& observation)
{
  const std::lock_guard lock(critZoneChangingMap);
  if (parts_->processWhat([&] { return parts_->steps->add(observation); })) keepHeld();
  // Its instant may go on: where the robot is then, the next one's beginning tells.
  parts_->held.emplace_back().insert(observation);
}

void MapBuilder::keepHeld()
{
  for (const CSensoryFrame& frame : parts_->held) keep(frame);
  parts_->held.clear();
}

void MapBuilder::keep(const CSensoryFrame& frame)
{
  const auto& always = options.alwaysInsertByClass;
  const bool wanted =
      options.debugForceInsertion || parts_->isFarFromLastFrame() ||
      std::any_of(frame.begin(), frame.end(),
                  [&](const auto& o) { return always.contains(o->GetRuntimeClass()); });
  if (options.enableMapUpdating && !frame.empty() && wanted)
    parts_->addFrame(std::make_shared<CSensoryFrame>(frame));
}

void MapBuilder::flush()
{
  const std::lock_guard lock(critZoneChangingMap);
  parts_->process(parts_->steps->flush());
  keepHeld();
}

::mrpt::poses::CPose3DPDF::Ptr MapBuilder::getCurrentPoseEstimation() const
{
  return poseOf(parts_->estimate.robot);
}

void MapBuilder::getCurrentlyBuiltMap(CSimpleMap& out) const
{
  out = parts_->frames;
}

unsigned int MapBuilder::getCurrentlyBuiltMapSize()
{
  return static_cast<unsigned int>(parts_->frames.size());
}

const CMultiMetricMap* MapBuilder::getCurrentlyBuiltMetricMap() const
{
  return &parts_->metricMap;
}

void MapBuilder::saveCurrentEstimationToImage(const std::string& file, bool)
{
  Moment moment;
  moment.scene = parts_->scene->at(parts_->estimate, parts_->filter->particles());
  Renderer renderer(moment.scene, {});
  savePng(file, renderer.draw(moment));
}
}  // namespace slamot::mrpt
