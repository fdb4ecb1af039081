#include "exampleLog.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <slamot/core/Error.h>
#include <slamot/mrpt/LiveSteps.h>

#include <limits>

namespace slamot::mrpt
{
namespace
{
using ::mrpt::obs::CActionCollection;
using ::mrpt::obs::CObservation;
using ::mrpt::obs::CObservationBearingRange;
using ::mrpt::obs::CSensoryFrame;
using Format = RawlogWriter::Format;

::mrpt::obs::CRawlog rawlogOf(const tests::TemporaryFolder& folder, Format format)
{
  ::mrpt::obs::CRawlog log;
  const std::string path =
      tests::writeLog(folder, format, tests::exampleSteps(), tests::exampleStarts());
  EXPECT_TRUE(log.loadFromRawLogFile(path));
  return log;
}

/// The observations, in the log's order.
std::vector<CObservation::Ptr> observationsOf(const ::mrpt::obs::CRawlog& log)
{
  std::vector<CObservation::Ptr> out;
  for (const auto& object : log)
    if (auto o = std::dynamic_pointer_cast<CObservation>(object)) out.push_back(std::move(o));
  return out;
}

CObservationBearingRange::Ptr badSighting(const CObservation::Ptr& like)
{
  auto out = std::make_shared<CObservationBearingRange>();
  out->timestamp = like->timestamp;
  out->sensedData.resize(1);
  out->sensedData[0].range = std::numeric_limits<float>::quiet_NaN();
  return out;
}

std::vector<double> times(const std::vector<core::Step>& steps)
{
  std::vector<double> out;
  for (const core::Step& s : steps) out.push_back(s.time);
  return out;
}
void append(std::vector<core::Step>& all, std::vector<core::Step> more)
{
  for (core::Step& s : more) all.push_back(std::move(s));
}
}  // namespace

TEST(LiveSteps, AreThoseOfTheLog)
{
  const tests::TemporaryFolder folder;
  const auto log = rawlogOf(folder, Format::kObservations);
  RawlogSource source(folder.file("log.rawlog"), tests::model());
  LiveSteps live(tests::model(), 0.0);
  std::vector<core::Step> steps;
  for (const auto& o : observationsOf(log)) append(steps, live.add(o));
  append(steps, live.flush());
  EXPECT_EQ(times(steps), times(tests::readAll(source)));
}

// An observation of a new time both ends the step before it and is wrong itself: at any place.
TEST(LiveSteps, BeforeABadObservationAreAllDelivered)
{
  const tests::TemporaryFolder folder;
  const auto log = rawlogOf(folder, Format::kObservations);
  const auto all = observationsOf(log);
  for (std::size_t bad = 1; bad < all.size(); ++bad)
  {
    LiveSteps clean(tests::model(), 0.0), live(tests::model(), 0.0);
    std::vector<core::Step> expected, steps;
    for (std::size_t i = 0; i < bad; ++i)
    {
      append(expected, clean.add(all[i]));
      append(steps, live.add(all[i]));
    }
    append(expected, clean.flush());
    auto late = badSighting(all[bad]);
    late->timestamp += std::chrono::milliseconds(3);
    append(steps, live.add(late));
    EXPECT_THROW((void)live.flush(), core::Error);
    append(steps, live.complete());
    EXPECT_EQ(times(steps), times(expected)) << bad;
    EXPECT_TRUE(live.complete().empty());
  }
}

// A pair ends what observations began, in one call.
TEST(LiveSteps, BeforeABadPairAreAllDelivered)
{
  const tests::TemporaryFolder folder;
  const auto log = rawlogOf(folder, Format::kObservations);
  const auto all = observationsOf(log);
  for (const bool byNextCall : {false, true})
  {
    LiveSteps clean(tests::model(), 0.0), live(tests::model(), 0.0);
    std::vector<core::Step> expected, steps;
    for (const auto& o : all)
    {
      append(expected, clean.add(o));
      append(steps, live.add(o));
    }
    append(expected, clean.flush());
    ASSERT_LT(steps.size(), expected.size()) << "the last step waits";
    CSensoryFrame frame;
    frame.insert(badSighting(all.back()));
    EXPECT_THROW((void)live.add(CActionCollection(), frame), core::Error);
    append(steps, byNextCall ? live.flush() : live.complete());
    EXPECT_EQ(times(steps), times(expected));
  }
}

TEST(LiveSteps, AfterWhatIsBadGoOn)
{
  const tests::TemporaryFolder folder;
  const auto log = rawlogOf(folder, Format::kObservations);
  const auto all = observationsOf(log);
  LiveSteps live(tests::model(), 0.0);
  const auto bad = badSighting(all.front());
  bad->timestamp -= std::chrono::seconds(1);
  EXPECT_TRUE(live.add(bad).empty());
  EXPECT_THROW((void)live.add(all.front()), core::Error) << "of the one before";
  std::vector<core::Step> steps;
  for (std::size_t i = 1; i < all.size(); ++i) append(steps, live.add(all[i]));
  append(steps, live.flush());
  EXPECT_EQ(steps.size(), tests::exampleSteps().size()) << "the good one was taken";
}
}  // namespace slamot::mrpt
