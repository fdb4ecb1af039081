#include <slamot/fusion/Radio.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace slamot::fusion
{
namespace
{
Bytes message(int number)
{
  return {static_cast<std::uint8_t>(number & 0xff), static_cast<std::uint8_t>(number >> 8)};
}
int numberOf(const Bytes& bytes)
{
  return bytes[0] | bytes[1] << 8;
}

/// The numbers, in order of arrival, of n messages that 1 sent to 2, one each 0.1 s.
std::vector<int> arrivals(const Radio::Options& options, int n)
{
  Radio radio(options);
  for (int i = 0; i < n; ++i) radio.send(1, 2, 0.1 * i, message(i));
  std::vector<int> out;
  for (const Bytes& bytes : radio.receive(2, 1e9)) out.push_back(numberOf(bytes));
  return out;
}
}  // namespace

TEST(Radio, WithoutFaultsDeliversAllAtOnceInOrder)
{
  Radio radio({});
  for (int i = 0; i < 50; ++i)
  {
    radio.send(1, 2, i, message(i));
    const auto heard = radio.receive(2, i);
    ASSERT_EQ(heard.size(), 1u);
    EXPECT_EQ(heard.front(), message(i));
    EXPECT_TRUE(radio.receive(1, i).empty()) << "it is for the other";
  }
}

TEST(Radio, LosesAndDoublesTheShareAskedFor)
{
  constexpr int kSent = 20000;
  for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0})
  {
    // Five deviations of a binomial: never by chance.
    const double room = 5 * std::sqrt(kSent * share * (1 - share));
    Radio::Options lossy;
    lossy.loss = share;
    EXPECT_NEAR(static_cast<double>(arrivals(lossy, kSent).size()), kSent * (1 - share), room);
    Radio::Options doubling;
    doubling.duplication = share;
    EXPECT_NEAR(static_cast<double>(arrivals(doubling, kSent).size()), kSent * (1 + share), room);
  }
}

TEST(Radio, DeliversNothingBeforeItsDelayAndAllAfterItsSpread)
{
  Radio::Options options;
  options.delay = 0.5, options.delaySpread = 0.25;
  Radio radio(options);
  for (int i = 0; i < 100; ++i) radio.send(1, 2, 10, message(i));
  EXPECT_TRUE(radio.receive(2, 10.4999).empty());
  const std::size_t early = radio.receive(2, 10.6).size();
  EXPECT_GT(early, 10u);
  EXPECT_LT(early, 90u);
  EXPECT_EQ(early + radio.receive(2, 10.75).size(), 100u);
}

TEST(Radio, MessagesOvertakeEachOtherOnlyWithASpread)
{
  Radio::Options options;
  options.delay = 1;
  const auto steady = arrivals(options, 200);
  EXPECT_TRUE(std::is_sorted(steady.begin(), steady.end()));
  options.delaySpread = 1;
  auto mixed = arrivals(options, 200);
  EXPECT_FALSE(std::is_sorted(mixed.begin(), mixed.end()));
  std::sort(mixed.begin(), mixed.end());
  EXPECT_EQ(mixed, steady) << "all arrive once";
}

TEST(Radio, AMessagesFateFollowsFromSeedLinkAndNumberAlone)
{
  Radio::Options options;
  options.loss = 0.5, options.delaySpread = 1, options.duplication = 0.3, options.seed = 7;
  const auto first = arrivals(options, 300);
  EXPECT_EQ(first, arrivals(options, 300));
  Radio busy(options);  // the same link among others
  for (int i = 0; i < 300; ++i)
  {
    busy.send(3, 2, 0.1 * i, message(1000));
    busy.send(1, 2, 0.1 * i, message(i));
    busy.send(1, 3, 0.1 * i, message(i));
  }
  std::vector<int> among;
  for (const Bytes& bytes : busy.receive(2, 1e9))
    if (numberOf(bytes) != 1000) among.push_back(numberOf(bytes));
  EXPECT_EQ(first, among);
  std::vector<int> otherLink;
  for (const Bytes& bytes : busy.receive(3, 1e9)) otherLink.push_back(numberOf(bytes));
  EXPECT_NE(first, otherLink);
  options.seed = 8;
  EXPECT_NE(first, arrivals(options, 300));
}
}  // namespace slamot::fusion
