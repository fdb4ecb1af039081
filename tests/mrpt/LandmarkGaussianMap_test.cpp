#include "bytes.h"
#include "temporary.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <slamot/core/Error.h>
#include <slamot/mrpt/CLandmarkGaussianMap.h>

#include <limits>

namespace slamot::maps
{
namespace
{
using Map = CLandmarkGaussianMap;
using ::mrpt::obs::CObservationBearingRange;
using ::mrpt::poses::CPose3D;

Map::Landmark landmark(int id, double x, double y, double variance)
{
  Map::Landmark m;
  m.id = id, m.position.mean = {x, y}, m.position.cov = variance * Matrix2::Identity();
  m.sightings = 1;
  return m;
}

Map twoLandmarks()
{
  Map map;
  auto m = landmark(7, 3.25, -1.5, 0.04);
  m.position.cov(0, 1) = m.position.cov(1, 0) = -0.01;
  m.sightings = 12, m.existence = 0.75;
  map.set(m);
  map.set(landmark(2, 2, 0, 0.03));
  map.insertionOptions.gateProbability = 0.95;
  map.insertionOptions.rangeStd = 0.3;
  return map;
}

CObservationBearingRange seen(int id, float range, float bearing)
{
  CObservationBearingRange o;
  o.sensor_std_range = 0.1f, o.sensor_std_yaw = 0.05f;
  o.sensedData.push_back({range, bearing, 0, id, {}});
  return o;
}

std::unique_ptr<Map> fromBytes(const std::string& bytes)
{
  ::mrpt::io::CMemoryStream memory;
  memory.assignMemoryNotOwn(bytes.data(), bytes.size());
  auto archive = ::mrpt::serialization::archiveFrom(memory);
  auto map = std::make_unique<Map>();
  archive.ReadObject(map.get());
  return map;
}

void expectEqual(const Map& a, const Map& b)
{
  ASSERT_EQ(a.landmarks().size(), b.landmarks().size());
  for (std::size_t i = 0; i < a.landmarks().size(); ++i)
  {
    const auto &m = a.landmarks()[i], &n = b.landmarks()[i];
    EXPECT_EQ(m.id, n.id);
    EXPECT_EQ(m.position.mean, n.position.mean);
    EXPECT_EQ(m.position.cov, n.position.cov);
    EXPECT_EQ(m.sightings, n.sightings);
    EXPECT_EQ(m.existence, n.existence);
  }
}

class ThreeInARow : public core::LandmarkView
{
 public:
  void visit(const std::function<void(const core::LandmarkEstimate&)>& visitor) const override
  {
    for (int i = 0; i < 3; ++i)
      visitor({10 * i, {{1.0 * i, 2.0}, 0.5 * Matrix2::Identity()}, 3 + i});
  }
  [[nodiscard]] std::size_t size() const override { return 3; }
};
}  // namespace

TEST(LandmarkGaussianMap, TakesEveryLandmarkOfAView)
{
  const Map map = Map::fromView(ThreeInARow());
  ASSERT_EQ(map.landmarks().size(), 3u);
  const Map::Landmark* last = map.find(20);
  ASSERT_NE(last, nullptr);
  EXPECT_EQ(last->position.mean, (Point2D{2, 2}));
  EXPECT_EQ(last->position.cov, 0.5 * Matrix2::Identity());
  EXPECT_EQ(last->sightings, 5);
  EXPECT_EQ(last->existence, 1);
  EXPECT_EQ(map.find(5), nullptr);
}

TEST(LandmarkGaussianMap, KeepsEveryFieldThroughAStream)
{
  Map map = twoLandmarks();
  map.insertionOptions.bearingStd = 0.02;
  map.genericMapParams.enableObservationLikelihood = false;
  const auto back = fromBytes(tests::serialized(map));
  expectEqual(*back, map);
  EXPECT_EQ(back->insertionOptions.gateProbability, 0.95);
  EXPECT_EQ(back->insertionOptions.rangeStd, 0.3);
  EXPECT_EQ(back->insertionOptions.bearingStd, 0.02);
  EXPECT_FALSE(back->genericMapParams.enableObservationLikelihood);
}

TEST(LandmarkGaussianMap, EveryTruncationThrows)
{
  const std::string bytes = tests::serialized(twoLandmarks());
  ASSERT_GT(bytes.size(), 100u);
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_THROW(fromBytes(bytes.substr(0, n)), std::exception) << n << " bytes";
}

TEST(LandmarkGaussianMap, DamagedBytesThrowOrGiveASoundMap)
{
  const std::string bytes = tests::serialized(twoLandmarks());
  int thrown = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (const unsigned char flip : {0x01, 0x80, 0xff})
    {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(static_cast<unsigned char>(damaged[i]) ^ flip);
      try
      {
        const auto map = fromBytes(damaged);
        Map copy;
        for (const auto& m : map->landmarks()) EXPECT_NO_THROW(copy.set(m)) << "byte " << i;
        EXPECT_LE(map->landmarks().size(), 2u) << "byte " << i;
      }
      catch (const std::exception&)
      {
        ++thrown;
      }
    }
  EXPECT_GT(thrown, 50);
}

TEST(LandmarkGaussianMap, HugeCountThrowsInsteadOfAllocating)
{
  std::string bytes = tests::serialized(Map());
  const std::size_t count = bytes.size() - 5;  // before the end flag
  bytes.replace(count, 4, "\xff\xff\xff\xff");
  EXPECT_THROW(fromBytes(bytes), std::exception);
  const std::uint32_t most = Map::kMostLandmarks;  // allowed, but the bytes aren't there
  bytes.replace(count, 4, reinterpret_cast<const char*>(&most), 4);
  EXPECT_THROW(fromBytes(bytes), std::exception);
}

TEST(LandmarkGaussianMap, RefusesLandmarksThatMakeNoSense)
{
  Map map;
  auto bad = landmark(1, 0, 0, 1);
  bad.position.cov(0, 1) = bad.position.cov(1, 0) = 1.5;
  EXPECT_THROW(map.set(bad), std::domain_error);
  EXPECT_THROW(map.set(landmark(-1, 0, 0, 1)), std::domain_error);
  EXPECT_THROW(map.set(landmark(1, std::numeric_limits<double>::quiet_NaN(), 0, 1)),
               std::domain_error);
  EXPECT_THROW(map.set(landmark(1, 0, 0, -1)), std::domain_error);
  EXPECT_TRUE(map.isEmpty());
}

TEST(LandmarkGaussianMap, FoundsALandmarkWhereItIsSeen)
{
  Map map;
  // Robot at (1, 2) heading along y; seen 2 m ahead: at (1, 4), the bearing's error along x.
  ASSERT_TRUE(map.insertObservation(seen(4, 2, 0), CPose3D(1, 2, 0, math::kPi / 2, 0, 0)));
  const Map::Landmark* m = map.find(4);
  ASSERT_NE(m, nullptr);
  EXPECT_NEAR(m->position.mean.x, 1, 1e-12);
  EXPECT_NEAR(m->position.mean.y, 4, 1e-12);
  EXPECT_NEAR(m->position.cov(0, 0), 4 * 0.05 * 0.05, 1e-8);
  EXPECT_NEAR(m->position.cov(1, 1), 0.1 * 0.1, 1e-8);
  EXPECT_NEAR(m->position.cov(0, 1), 0, 1e-12);
  EXPECT_EQ(m->sightings, 1);
}

// Robot at the origin, landmark at (2, 0): H = diag(1, 1/2).  P = 0.03 I, R = diag(0.01, 0.0025):
// S = diag(0.04, 0.01), K = diag(0.75, 1.5), P' = diag(0.0075, 0.0075).
TEST(LandmarkGaussianMap, UpdateEqualsHandComputation)
{
  Map map;
  map.set(landmark(2, 2, 0, 0.03));
  map.set(landmark(3, 5, 5, 0.03));
  ASSERT_TRUE(map.insertObservation(seen(2, 2.2f, 0.1f), CPose3D()));
  const Map::Landmark* m = map.find(2);
  EXPECT_NEAR(m->position.mean.x, 2 + 0.75 * 0.2, 1e-6);
  EXPECT_NEAR(m->position.mean.y, 1.5 * 0.1, 1e-6);
  EXPECT_NEAR(m->position.cov(0, 0), 0.0075, 1e-8);
  EXPECT_NEAR(m->position.cov(1, 1), 0.0075, 1e-8);
  EXPECT_EQ(m->sightings, 2);
  EXPECT_EQ(map.find(3)->position.mean, (Point2D{5, 5}));
}

TEST(LandmarkGaussianMap, UnidentifiedSightingsGoToTheNearestWithinTheGate)
{
  Map map;
  map.set(landmark(2, 2, 0, 0.03));
  map.set(landmark(3, 2, 1, 0.03));
  CObservationBearingRange o = seen(-1, 2.2f, 0.1f);  // landmark 2
  o.sensedData.push_back({2.1f, 0.05f, 0, -1, {}});   // too: ambiguous
  o.sensedData.push_back({6.0f, -1.0f, 0, -1, {}});   // far from both
  ASSERT_TRUE(map.insertObservation(o, CPose3D()));
  EXPECT_NEAR(map.find(2)->position.mean.x, 2.15, 1e-6);
  EXPECT_EQ(map.find(3)->sightings, 1);
  ASSERT_EQ(map.landmarks().size(), 3u);
  EXPECT_NEAR(map.find(4)->position.mean.x, 6 * std::cos(1.0), 1e-6);
}

TEST(LandmarkGaussianMap, GateIsTheChiSquareQuantile)
{
  // S = diag(0.04, 0.01) as above; the 0.99 gate is 9.2103: a range off by 0.6069 m is at it.
  for (const bool inside : {true, false})
  {
    Map map;
    map.set(landmark(2, 2, 0, 0.03));
    map.insertObservation(seen(-1, inside ? 2.605f : 2.609f, 0), CPose3D());
    EXPECT_EQ(map.landmarks().size(), inside ? 1u : 2u);
  }
}

TEST(LandmarkGaussianMap, FallsBackToItsDeviationsWhereTheLogHasNone)
{
  Map map;
  map.insertionOptions.rangeStd = 0.5, map.insertionOptions.bearingStd = 0.25;
  CObservationBearingRange o = seen(1, 2, 0);
  o.sensor_std_range = o.sensor_std_yaw = 0;
  map.insertObservation(o, CPose3D());
  EXPECT_NEAR(map.find(1)->position.cov(0, 0), 0.25, 1e-9);
  EXPECT_NEAR(map.find(1)->position.cov(1, 1), 4 * 0.0625, 1e-9);
}

TEST(LandmarkGaussianMap, TakesTheSensorsPlaceOnTheRobotIntoAccount)
{
  Map map;
  CObservationBearingRange o = seen(1, 2, 0);
  o.sensorLocationOnRobot = CPose3D(0.5, 0, 0.3, math::kPi / 2, 0, 0);
  map.insertObservation(o, CPose3D());
  EXPECT_NEAR(map.find(1)->position.mean.x, 0.5, 1e-9);
  EXPECT_NEAR(map.find(1)->position.mean.y, 2, 1e-9);
}

TEST(LandmarkGaussianMap, NonsenseThrowsAndLeavesTheMap)
{
  Map map = twoLandmarks();
  CObservationBearingRange o = seen(2, 2, 0);
  o.sensedData.push_back({std::numeric_limits<float>::quiet_NaN(), 0, 0, 7, {}});
  EXPECT_THROW(map.insertObservation(o, CPose3D()), std::exception);
  expectEqual(map, twoLandmarks());
}

TEST(LandmarkGaussianMap, LikelihoodEqualsClosedForm)
{
  Map map;
  map.set(landmark(2, 2, 0, 0.03));
  // As by hand above: S = diag(0.04, 0.01), innovation (0.2, 0.1); distance² 1 + 1.
  const double constant = -std::log(math::kTwoPi) - 0.5 * std::log(0.04 * 0.01);
  EXPECT_NEAR(map.computeObservationLikelihood(seen(2, 2.2f, 0.1f), CPose3D()), constant - 1, 1e-5);
  EXPECT_NEAR(map.computeObservationLikelihood(seen(-1, 2.2f, 0.1f), CPose3D()), constant - 1,
              1e-5);
  CObservationBearingRange both = seen(2, 2.2f, 0.1f);
  both.sensedData.push_back({2.0f, 0, 0, 2, {}});
  both.sensedData.push_back({9.0f, 0, 0, 55, {}});  // not on the map
  EXPECT_NEAR(map.computeObservationLikelihood(both, CPose3D()), 2 * constant - 1, 1e-5);
  // Without identity, what is out of the gate counts as on it.
  const double gate = 9.210340371976182;
  EXPECT_NEAR(map.computeObservationLikelihood(seen(-1, 9, 0), CPose3D()), constant - gate / 2,
              1e-5);
  EXPECT_EQ(map.landmarks().size(), 1u);
}

TEST(LandmarkGaussianMap, WeighsSightingsOnly)
{
  const Map map = twoLandmarks();
  EXPECT_TRUE(map.canComputeObservationLikelihood(seen(2, 2, 0)));
  EXPECT_FALSE(map.canComputeObservationLikelihood(::mrpt::obs::CObservation2DRangeScan()));
  EXPECT_EQ(Map().computeObservationLikelihood(seen(-1, 2, 0), CPose3D()), 0);
}

TEST(LandmarkGaussianMap, LoadsIntoAMultiMetricMap)
{
  ::mrpt::config::CConfigFileMemory ini(
      std::string("[map]\n"
                  "landmarkGaussianMap_count = 1\n"
                  "[map_landmarkGaussianMap_00_insertOpts]\n"
                  "gate_probability = 0.9 // comment\n"
                  "bearing_std_deg = 2\n"));
  ::mrpt::maps::TSetOfMetricMapInitializers definitions;
  definitions.loadFromConfigFile(ini, "map");
  ::mrpt::maps::CMultiMetricMap maps(definitions);
  const auto map = maps.mapByClass<Map>();
  ASSERT_TRUE(map);
  EXPECT_DOUBLE_EQ(map->insertionOptions.gateProbability, 0.9);
  EXPECT_DOUBLE_EQ(map->insertionOptions.bearingStd, math::degToRad(2));
  EXPECT_DOUBLE_EQ(map->insertionOptions.rangeStd, 0.1);
  EXPECT_TRUE(maps.insertObservation(seen(4, 2, 0), CPose3D()));
  EXPECT_EQ(map->landmarks().size(), 1u);
  map->clear();
  EXPECT_TRUE(map->isEmpty());
}

TEST(LandmarkGaussianMap, OptionsOutOfRangeAreNamed)
{
  for (const std::string line : {"gate_probability = 1", "gate_probability = 0.5x",
                                 "range_std_m = 0", "bearing_std_deg = nan", "gate = 0.5"})
  {
    Map::TInsertionOptions options;
    ::mrpt::config::CConfigFileMemory ini("[opts]\n" + line + "\n");
    const std::string key = line.substr(0, line.find(' '));
    try
    {
      options.loadFromConfigFile(ini, "opts");
      ADD_FAILURE() << line;
    }
    catch (const core::Error& e)
    {
      EXPECT_EQ(e.status(), core::ExitStatus::kConfig);
      EXPECT_EQ(std::string(e.what()).find("[opts] " + key + ":"), 0u) << e.what();
    }
  }
}

TEST(LandmarkGaussianMap, OptionsSurviveAnIniFile)
{
  Map::TInsertionOptions options, back;
  options.gateProbability = 0.875, options.rangeStd = 0.25, options.bearingStd = 0.03;
  ::mrpt::config::CConfigFileMemory ini;
  options.saveToConfigFile(ini, "opts");
  back.loadFromConfigFile(ini, "opts");
  EXPECT_EQ(back.gateProbability, 0.875);
  EXPECT_EQ(back.rangeStd, 0.25);
  EXPECT_DOUBLE_EQ(back.bearingStd, 0.03);
}

TEST(LandmarkGaussianMap, WritesATable)
{
  const tests::TemporaryFolder folder;
  Map map;
  auto m = landmark(7, 3.25, -1.5, 0.5);
  m.position.cov(0, 1) = m.position.cov(1, 0) = -0.25;
  m.existence = 0.75;
  map.set(m);
  map.saveMetricMapRepresentationToFile(folder.file("map"));
  EXPECT_EQ(tests::rawBytes(folder.file("map_landmarks.csv")),
            "id,x,y,cxx,cxy,cyy,sightings,existence\n7,3.25,-1.5,0.5,-0.25,0.5,1,0.75\n");
  EXPECT_THROW(map.saveMetricMapRepresentationToFile("/no/such/folder/map"), core::Error);
}

TEST(LandmarkGaussianMap, DrawsEllipsesAndOneLabelEach)
{
  Map map = twoLandmarks();
  int labels = 0, ellipses = 0;
  const auto drawn = map.getVisualization();
  for (const auto& object : *drawn)
  {
    const std::string name = object->GetRuntimeClass()->className;
    labels += name.find("CText3D") != std::string::npos;
    ellipses += name.find("CSetOfTriangles") != std::string::npos;
  }
  EXPECT_EQ(labels, 2);
  EXPECT_EQ(ellipses, 1);
  map.genericMapParams.enableSaveAs3DObject = false;
  EXPECT_TRUE(map.getVisualization()->empty());
}
}  // namespace slamot::maps
