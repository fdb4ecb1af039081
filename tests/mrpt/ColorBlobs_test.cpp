#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/rtti/CObject.h>
#include <mrpt/serialization/CArchive.h>
#include <slamot/mrpt/CObservationColorBlobs.h>

#include <sstream>

namespace
{
using slamot::obs::CObservationColorBlobs;

CObservationColorBlobs example()
{
  CObservationColorBlobs o;
  o.timestamp = mrpt::Clock::fromDouble(12.5);
  o.sensorLabel = "CAMERA";
  o.sensorPoseOnRobot = mrpt::poses::CPose3D(0.1, 0.2, 0.3, 0.4, 0, 0);
  o.rangeMin = 0.2, o.rangeMax = 6, o.bearingMin = -0.5, o.bearingMax = 0.6;
  o.elevationMin = -0.3, o.elevationMax = 0.2;
  CObservationColorBlobs::Blob ranged;
  ranged.label = "target", ranged.id = 7;
  ranged.centerX = 120.5, ranged.centerY = 80, ranged.boxLeft = 110, ranged.boxTop = 70;
  ranged.boxWidth = 21, ranged.boxHeight = 20, ranged.area = 300;
  ranged.bearing = 0.1, ranged.bearingStd = 0.01, ranged.elevation = -0.05;
  ranged.elevationStd = 0.02, ranged.range = 3.25, ranged.rangeStd = 0.1;
  auto bearingOnly = ranged;
  bearingOnly.label = "robot", bearingOnly.id = -1, bearingOnly.range.reset();
  o.blobs = {ranged, bearingOnly};
  return o;
}

CObservationColorBlobs::Ptr copyThroughStream(const CObservationColorBlobs& o)
{
  mrpt::io::CMemoryStream memory;
  auto archive = mrpt::serialization::archiveFrom(memory);
  archive << o;
  memory.Seek(0);
  return archive.ReadObject<CObservationColorBlobs>();
}

TEST(ColorBlobs, IsRegisteredUnderTheNameThatLogsHold)
{
  const auto* id = mrpt::rtti::findRegisteredClass("slamot::obs::CObservationColorBlobs");
  ASSERT_NE(id, nullptr);
  EXPECT_TRUE(id->derivedFrom(CLASS_ID(mrpt::obs::CObservation)));
}

TEST(ColorBlobs, KeepsEveryFieldThroughAStream)
{
  const CObservationColorBlobs o = example();
  const auto back = copyThroughStream(o);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->timestamp, o.timestamp);
  EXPECT_EQ(back->sensorLabel, o.sensorLabel);
  EXPECT_EQ(back->sensorPoseOnRobot, o.sensorPoseOnRobot);
  EXPECT_EQ(back->exportTxtDataRow(), o.exportTxtDataRow());
  for (auto field : {&CObservationColorBlobs::rangeMin, &CObservationColorBlobs::rangeMax,
                     &CObservationColorBlobs::bearingMin, &CObservationColorBlobs::bearingMax,
                     &CObservationColorBlobs::elevationMin, &CObservationColorBlobs::elevationMax})
    EXPECT_EQ((*back).*field, o.*field);
}

TEST(ColorBlobs, AbsentRangeStaysAbsent)
{
  const auto back = copyThroughStream(example());
  ASSERT_EQ(back->blobs.size(), 2u);
  EXPECT_EQ(back->blobs[0].range, 3.25);
  EXPECT_FALSE(back->blobs[1].range.has_value());
}

TEST(ColorBlobs, EmptyLookIsKept)
{
  CObservationColorBlobs o = example();
  o.blobs.clear();
  EXPECT_TRUE(copyThroughStream(o)->blobs.empty());
}

TEST(ColorBlobs, HugeCountThrowsInsteadOfAllocating)
{
  CObservationColorBlobs o = example();
  o.blobs.clear();
  mrpt::io::CMemoryStream memory;
  auto archive = mrpt::serialization::archiveFrom(memory);
  archive << o;
  auto* bytes = static_cast<unsigned char*>(memory.getRawBufferData());
  const std::size_t count = memory.getTotalBytesCount() - 5;  // before the end flag
  for (std::size_t i = 0; i < 4; ++i) bytes[count + i] = 0xff;
  memory.Seek(0);
  EXPECT_THROW(archive.ReadObject(), std::exception);
}

TEST(ColorBlobs, TextNamesLabelsAndUnknownRange)
{
  std::ostringstream text;
  example().getDescriptionAsText(text);
  EXPECT_NE(text.str().find("target #7"), std::string::npos);
  EXPECT_NE(text.str().find("range unknown"), std::string::npos);
}

TEST(ColorBlobs, DrawsAMarkForEachRangedBlob)
{
  CObservationColorBlobs o = example();
  const auto scene = o.getVisualization();
  const auto marks = [](const slamot_viz::CSetOfObjects& objects)
  {
    int n = 0;
    for (const auto& object : objects)
      if (std::string(object->GetRuntimeClass()->className).find("CSetOfTriangles") !=
          std::string::npos)
        ++n;
    return n;
  };
  EXPECT_EQ(marks(*scene), 1);
  o.blobs.clear();
  EXPECT_EQ(marks(*o.getVisualization()), 0);
}
}  // namespace
