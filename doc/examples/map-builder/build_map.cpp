// build-map CONFIG.ini X.rawlog OUT: runs a filter of slamot's from a program that knows MRPT only.
// Writes OUT.tum, the path; OUT_landmarks.csv, the map; OUT.simplemap; OUT.png, a picture of it
// all.
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <slamot/mrpt/MapBuilder.h>

#include <cmath>
#include <cstdio>
#include <exception>

namespace
{
/// Where a log's comment text says that the robot starts.
slamot::core::Starts startsOf(const mrpt::obs::CRawlog& log)
{
  std::string comment;
  log.getCommentText(comment);
  if (comment.find("[start]") == std::string::npos) return {};
  auto ini = slamot::core::Config::parse(comment, "the log's comment");
  return slamot::core::Starts::from(ini);
}

/// The time of a frame's first observation [s].
double timeOf(const mrpt::obs::CSensoryFrame& frame, const mrpt::obs::CActionCollection& actions)
{
  const auto stamp = frame.empty() ? actions.get(0).timestamp : (*frame.begin())->timestamp;
  return mrpt::Clock::toDouble(stamp);
}

/// One line of the path, in TUM's format.
void write(std::FILE* path, double time, const slamot::mrpt::MapBuilder& builder)
{
  const auto pose = builder.getCurrentPoseEstimation()->getMeanVal();
  std::fprintf(path, "%.9f %.9f %.9f 0 0 0 %.9f %.9f\n", time, pose.x(), pose.y(),
               std::sin(pose.yaw() / 2), std::cos(pose.yaw() / 2));
}

/// Of a log of actions and frames.
void processPairs(slamot::mrpt::MapBuilder& builder, mrpt::obs::CRawlog& log, std::FILE* path)
{
  mrpt::obs::CActionCollection::Ptr actions;
  mrpt::obs::CSensoryFrame::Ptr frame;
  for (std::size_t at = 0; at < log.size() && log.getActionObservationPair(actions, frame, at);)
  {
    builder.processActionObservation(*actions, *frame);
    write(path, timeOf(*frame, *actions), builder);
  }
}

/// Of a log of observations only.
void processObservations(slamot::mrpt::MapBuilder& builder, mrpt::obs::CRawlog& log,
                         std::FILE* path)
{
  for (const auto& object : log)
    if (const auto o = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object))
    {
      builder.processObservation(o);
      write(path, mrpt::Clock::toDouble(o->timestamp), builder);
    }
  builder.flush();
}

void run(const char* config, const char* rawlog, const std::string& out)
{
  mrpt::obs::CRawlog log;
  if (!log.loadFromRawLogFile(rawlog) || log.size() == 0)
    throw std::runtime_error("the rawlog can't be read");
  slamot::mrpt::MapBuilder builder(slamot::core::Config::load(config), startsOf(log));
  std::FILE* path = std::fopen((out + ".tum").c_str(), "w");
  if (path == nullptr) throw std::runtime_error("the output can't be written");
  if (log.getType(0) == mrpt::obs::CRawlog::TEntryType::etObservation)
    processObservations(builder, log, path);
  else
    processPairs(builder, log, path);
  std::fclose(path);

  const auto* map = builder.getCurrentlyBuiltMetricMap();
  std::printf("ends at %s with %s\n",
              builder.getCurrentPoseEstimation()->getMeanVal().asString().c_str(),
              map->maps.front()->asString().c_str());
  map->saveMetricMapRepresentationToFile(out);
  builder.saveCurrentMapToFile(out + ".simplemap");
  builder.saveCurrentEstimationToImage(out + ".png");
}
}  // namespace

int main(int argc, char** argv)
{
  if (argc != 4)
  {
    std::fprintf(stderr, "usage: build-map CONFIG.ini X.rawlog OUT\n");
    return 1;
  }
  try
  {
    run(argv[1], argv[2], argv[3]);
    return 0;
  }
  catch (const std::exception& e)
  {
    std::fprintf(stderr, "build-map: error: %s\n", e.what());
    return 1;
  }
}
