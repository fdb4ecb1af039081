#include <gtest/gtest.h>
#include <slamot/live/Peers.h>

namespace slamot::live
{
using News = Peers::News;

TEST(Peers, TellWhoComesFallsSilentAndComesBack)
{
  Peers peers(0, {0, 1, 2});
  EXPECT_FALSE(peers.areAllHeard());
  EXPECT_EQ(peers.hear(1, 5, 100), News::kCame);
  EXPECT_EQ(peers.hear(1, 5, 101), News::kNone);
  EXPECT_EQ(peers.hear(2, 9, 103), News::kCame);
  EXPECT_TRUE(peers.areAllHeard());
  EXPECT_TRUE(peers.fallSilent(104).empty());
  EXPECT_EQ(peers.fallSilent(104.5), std::vector<int>{1});
  EXPECT_TRUE(peers.fallSilent(105).empty());
  EXPECT_EQ(peers.hear(1, 5, 105), News::kCame);
  EXPECT_EQ(peers.sessions(), (std::map<int, int>{{1, 1}, {2, 1}}));
}

TEST(Peers, CountStartsAndForgetEarlierOnes)
{
  Peers peers(0, {0, 1});
  EXPECT_EQ(peers.hear(1, 5, 100), News::kCame);
  EXPECT_EQ(peers.hear(1, 8, 101), News::kRestarted);
  EXPECT_EQ(peers.hear(1, 5, 102), News::kNone);
  EXPECT_EQ(peers.hear(1, 8, 103), News::kNone);
  EXPECT_EQ(peers.sessions().at(1), 2);
}

TEST(Peers, NameStrangersAndDoublesOnce)
{
  Peers peers(0, {0, 1});
  EXPECT_EQ(peers.hear(7, 5, 100), News::kStranger);
  EXPECT_EQ(peers.hear(7, 5, 101), News::kNone);
  EXPECT_EQ(peers.hear(0, 5, 102), News::kDouble);
  EXPECT_EQ(peers.hear(0, 5, 103), News::kNone);
  EXPECT_TRUE(peers.sessions().empty());
  EXPECT_TRUE(peers.isOfTeam(1));
  EXPECT_FALSE(peers.isOfTeam(0));
  EXPECT_FALSE(peers.isOfTeam(7));
}
}  // namespace slamot::live
