#include "sighting/Tracks.h"

#include <gtest/gtest.h>

namespace slamot::filters
{
namespace
{
core::Blob blob(const std::string& label, int id = core::kNoId)
{
  return {label, 2.0, 0.0, 0.1, 0.01, id};
}
Tracks tracks()
{
  return Tracks({3, 1.0, 30.0, 5.0});
}
}  // namespace

TEST(Tracks, WithAnIdentityAreBelievedAtOnceAndKeepIt)
{
  Tracks t = tracks();
  t.add(blob("robot", 7), 1.0);
  EXPECT_TRUE(t.list()[0].confirmed);
  EXPECT_TRUE(t.list()[0].identified);
  EXPECT_EQ(t.list()[0].id, 7);
  EXPECT_EQ(t.list()[0].label, "robot");
  EXPECT_EQ(t.list()[0].lastSeen, 1.0);
}

TEST(Tracks, WithoutAreNumberedInOrderOfConfirmation)
{
  Tracks t = tracks();
  t.add(blob("target"), 1.0);
  t.add(blob("target"), 1.0);
  EXPECT_FALSE(t.list()[0].confirmed);
  EXPECT_EQ(t.list()[0].id, core::kNoId);
  t.hit(1, blob("target"), 2.0);
  t.hit(1, blob("target"), 3.0);
  t.hit(0, blob("target"), 3.0);
  t.hit(0, blob("target"), 4.0);
  EXPECT_EQ(t.list()[1].id, 0);
  EXPECT_EQ(t.list()[0].id, 1);
}

TEST(Tracks, NumbersKeepClearOfIdentitiesAndOfLostTracks)
{
  Tracks t = tracks();
  t.addStart(0, 0.0);
  t.add(blob("target", 2), 0.0);
  const auto confirmed = [&]
  {
    t.add(blob("target"), 1.0);
    const std::size_t last = t.list().size() - 1;
    t.hit(last, blob("target"), 2.0);
    t.hit(last, blob("target"), 3.0);
    return t.list()[last].id;
  };
  EXPECT_EQ(confirmed(), 1);
  t.erase(t.list().size() - 1);
  EXPECT_EQ(confirmed(), 3);
}

TEST(Tracks, FitBlobsOfTheirLabelAndIdentity)
{
  Tracks t = tracks();
  t.add(blob("target", 3), 0);
  t.add(blob("target"), 0);
  t.addStart(5, 0);
  const auto fits = [&](std::size_t i, const core::Blob& b)
  { return Tracks::fits(t.list()[i], b); };
  EXPECT_TRUE(fits(0, blob("target", 3)));
  EXPECT_FALSE(fits(0, blob("target", 4)));
  EXPECT_FALSE(fits(0, blob("robot", 3)));
  EXPECT_TRUE(fits(0, blob("target")));
  EXPECT_TRUE(fits(1, blob("target")));
  EXPECT_FALSE(fits(1, blob("target", 3)));
  EXPECT_TRUE(fits(2, blob("anything", 5)));  // a start's label is not known yet
  EXPECT_TRUE(fits(2, blob("anything")));
  t.hit(2, blob("target", 5), 1);
  EXPECT_FALSE(fits(2, blob("anything", 5)));
}

TEST(Tracks, AreLostByTimeOrSpreadAndSoonerWhileTentative)
{
  Tracks t = tracks();
  t.add(blob("target", 1), 10.0);
  t.add(blob("target"), 10.0);
  EXPECT_FALSE(t.isLost(0, 40.0, 4.9));
  EXPECT_TRUE(t.isLost(0, 40.1, 0.1));
  EXPECT_TRUE(t.isLost(0, 10.1, 5.1));
  EXPECT_TRUE(t.isLost(0, 10.1, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(t.isLost(1, 11.0, 0.1));
  EXPECT_TRUE(t.isLost(1, 11.1, 0.1));
}

TEST(Tracks, AreLostWhenTheirIdentityIsSeenElsewhereThriceInARow)
{
  Tracks t = tracks();
  t.add(blob("target", 1), 0);
  t.reject(blob("target", 1));
  t.reject(blob("target", 1));
  t.hit(0, blob("target", 1), 1);
  t.reject(blob("target", 1));
  t.reject(blob("target", 2));
  t.reject(blob("target"));
  t.reject(blob("target", 1));
  EXPECT_FALSE(t.isLost(0, 1, 0.1));
  t.reject(blob("target", 1));
  EXPECT_TRUE(t.isLost(0, 1, 0.1));
}
}  // namespace slamot::filters
