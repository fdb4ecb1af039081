// A program of MRPT's that does not link this project: the map's class comes with the plugin alone.
#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/rtti/CObject.h>
#include <mrpt/system/os.h>

namespace
{
constexpr const char* kClass = "slamot::maps::CLandmarkGaussianMap";

TEST(LandmarkMapPlugin, AddsTheMapToMultiMetricMaps)
{
  ASSERT_EQ(mrpt::rtti::findRegisteredClass(kClass), nullptr);
  mrpt::system::loadPluginModule(SLAMOT_PLUGIN);
  ASSERT_NE(mrpt::rtti::findRegisteredClass(kClass), nullptr);

  mrpt::config::CConfigFileMemory ini(std::string("[map]\nlandmarkGaussianMap_count = 1\n"));
  mrpt::maps::TSetOfMetricMapInitializers definitions;
  definitions.loadFromConfigFile(ini, "map");
  mrpt::maps::CMultiMetricMap maps(definitions);
  ASSERT_EQ(maps.maps.size(), 1u);
  EXPECT_STREQ(maps.maps[0]->GetRuntimeClass()->className, kClass);

  mrpt::obs::CObservationBearingRange o;
  o.sensor_std_range = 0.1f, o.sensor_std_yaw = 0.05f;
  o.sensedData.push_back({2.0f, 0, 0, 4, {}});
  EXPECT_TRUE(maps.insertObservation(o, mrpt::poses::CPose3D()));
  EXPECT_FALSE(maps.isEmpty());
}
}  // namespace
