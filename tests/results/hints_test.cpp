#include <gmock/gmock.h>
#include <slamot/results/hints.h>

namespace slamot::results
{
namespace
{
using Outcome = core::Pairing::Outcome;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A run that mapped one landmark and followed one target.
eval::Record goodRun()
{
  eval::Record record;
  record.hasMap = true;
  record.landmarks.resize(1);
  record.targets.resize(1);
  record.steps.resize(1);
  record.steps[0].scan = true;
  return record;
}

void add(eval::Record& record, int count, bool blob, Outcome outcome, int seenId)
{
  eval::PairingRow row;
  row.pairing.isBlob = blob;
  row.pairing.outcome = outcome;
  row.seenId = seenId;
  record.pairings.insert(record.pairings.end(), static_cast<std::size_t>(count), row);
}

TEST(Hints, AreNotGivenForAGoodRun)
{
  eval::Record record = goodRun();
  add(record, 9, false, Outcome::kKnown, 5);
  add(record, 4, false, Outcome::kRejected, core::kNoId);  // clutter
  add(record, 3, true, Outcome::kKnown, core::kNoId);
  EXPECT_THAT(hintsOf(record, "m"), IsEmpty());
  EXPECT_THAT(hintsOf({}, "m"), IsEmpty());
}

TEST(Hints, NameTheSettingWhereSightingsHaveNoIdentity)
{
  eval::Record record = goodRun();
  record.landmarks.clear();
  add(record, 1, false, Outcome::kKnown, 5);
  add(record, 4, false, Outcome::kRejected, core::kNoId);
  EXPECT_THAT(hintsOf(record, "m"),
              ElementsAre(HasSubstr("4 of 5 landmark sightings have no identity")));
  EXPECT_THAT(hintsOf(record, "m"), ElementsAre(HasSubstr("--set m.association=nn")));
  add(record, 5, false, Outcome::kNew, core::kNoId);  // paired by place: identities don't matter
  EXPECT_THAT(hintsOf(record, "m"), ElementsAre(HasSubstr("m.confirm_sightings")));
}

TEST(Hints, TellWhyBlobsMadeNoTarget)
{
  eval::Record record = goodRun();
  record.targets.clear();
  add(record, 4, true, Outcome::kRejected, 3);
  EXPECT_THAT(hintsOf(record, "m"), ElementsAre(HasSubstr("none has a range")));
  add(record, 1, true, Outcome::kNew, 3);
  EXPECT_THAT(hintsOf(record, "m"), ElementsAre(HasSubstr("m.target_tentative_s")));
}

TEST(Hints, TellThatThereWasNothingToMap)
{
  eval::Record record = goodRun();
  record.steps[0].scan = false;
  EXPECT_THAT(hintsOf(record, "m"), ElementsAre(HasSubstr("slamot info")));
  record.hasMap = false;  // dead reckoning wants nothing
  EXPECT_THAT(hintsOf(record, "m"), IsEmpty());
}
}  // namespace
}  // namespace slamot::results
