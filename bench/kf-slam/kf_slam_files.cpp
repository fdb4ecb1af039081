// What bench/kf-slam.sh needs of MRPT's binary files.
//   kf-slam-files forget-ids IN.rawlog OUT.rawlog   the log without landmarks' identities, which
//                                                   kf-slam can't be told to leave aside
//   kf-slam-files map X.3Dscene                     kf-slam's landmarks, a line `x y` for each in
//   the
//                                                   order of its state: its other files lack them
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/opengl/CEllipsoid2D.h>
#include <mrpt/opengl/COpenGLScene.h>

#include <cstdio>
#include <string>

namespace
{
void forget(mrpt::obs::CObservation& observation)
{
  if (auto* o = dynamic_cast<mrpt::obs::CObservationBearingRange*>(&observation))
    for (auto& sighting : o->sensedData) sighting.landmarkID = -1;
}

bool forgetIds(const std::string& in, const std::string& out)
{
  mrpt::obs::CRawlog log;
  if (!log.loadFromRawLogFile(in)) return false;
  for (const auto& entry : log)
    if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry))
      for (const auto& observation : *frame) forget(*observation);
  return log.saveToRawLogFile(out);
}

bool printMap(const std::string& path)
{
  mrpt::opengl::COpenGLScene scene;
  if (!scene.loadFromFile(path)) return false;
  bool isRobot = true;  // whose ellipse comes first
  scene.visitAllObjects(
      [&](const mrpt::opengl::CRenderizable::Ptr& object)
      {
        if (!dynamic_cast<const mrpt::opengl::CEllipsoid2D*>(object.get())) return;
        if (!isRobot) std::printf("%.9f %.9f\n", object->getPoseX(), object->getPoseY());
        isRobot = false;
      });
  return !isRobot;
}
}  // namespace

int main(int argc, char** argv)
{
  const std::string verb = argc > 2 ? argv[1] : "";
  if (verb == "forget-ids" && argc == 4) return forgetIds(argv[2], argv[3]) ? 0 : 2;
  if (verb == "map" && argc == 3) return printMap(argv[2]) ? 0 : 2;
  std::fprintf(stderr, "usage: kf-slam-files forget-ids IN.rawlog OUT.rawlog | map X.3Dscene\n");
  return 1;
}
