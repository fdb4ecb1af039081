#include <gtest/gtest.h>
#include <slamot/live/Announcement.h>
#include <slamot/live/Beacon.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace slamot::live
{
namespace
{
Announcement example()
{
  Announcement a;
  a.kind = Announcement::Kind::kStep;
  a.sender = 3;
  a.session = 0x123456789abcdef0u;
  a.sequence = 17;
  a.time = 12.4;
  a.next = std::numeric_limits<double>::infinity();
  a.message = {1, 2, 3};
  return a;
}
}  // namespace

TEST(Beacon, ReadsBackAsWritten)
{
  const auto b = decodeBeacon(encode(Beacon{7, 42, 2.5, 12.25}));
  ASSERT_TRUE(b);
  EXPECT_EQ(b->sender, 7);
  EXPECT_EQ(b->session, 42u);
  EXPECT_EQ(b->speed, 2.5);
  EXPECT_EQ(b->clock, 12.25);
  EXPECT_FALSE(b->hearsAll);
  EXPECT_TRUE(decodeBeacon(encode(Beacon{7, 42, 2.5, {}, true}))->hearsAll);
  EXPECT_FALSE(decodeBeacon(encode(Beacon{7, 42, 2.5, {}}))->clock);
  EXPECT_FALSE(decodeBeacon(encode(Beacon{7, 42, std::nan(""), 12.25})));
  EXPECT_FALSE(decodeBeacon(encode(Beacon{7, 42, 1, std::nan("")})));
}

TEST(Announcement, ReadsBackAsWritten)
{
  const auto a = decodeAnnouncement(encode(example()));
  ASSERT_TRUE(a);
  EXPECT_EQ(a->kind, Announcement::Kind::kStep);
  EXPECT_EQ(a->sender, 3);
  EXPECT_EQ(a->session, 0x123456789abcdef0u);
  EXPECT_EQ(a->sequence, 17u);
  EXPECT_EQ(a->time, 12.4);
  EXPECT_TRUE(std::isinf(a->next));
  EXPECT_EQ(a->message, (Bytes{1, 2, 3}));
}

TEST(Packets, HaveTheLayoutOfTheManual)
{
  const Bytes a = encode(example()), b = encode(Beacon{7, 42, 2.5, 12.25});
  EXPECT_EQ(std::string(a.begin(), a.begin() + 4), "SLS1");
  EXPECT_EQ(a.size(), 45u + 3);
  EXPECT_EQ(a[4], 1);
  EXPECT_EQ(a[5], 3);
  EXPECT_EQ(a[17], 17);
  EXPECT_EQ(a[41], 1);
  EXPECT_EQ(std::string(b.begin(), b.begin() + 4), "SLT1");
  EXPECT_EQ(b.size(), 37u);
  EXPECT_EQ(b[8], 42);
}

TEST(Packets, AreNoneCutShortOrWithAFlippedBit)
{
  for (const Bytes& good : {encode(example()), encode(Beacon{7, 42, 2.5, 12.25})})
  {
    for (std::size_t n = 0; n < good.size(); ++n)
    {
      const Bytes cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(n));
      EXPECT_FALSE(decodeBeacon(cut));
      EXPECT_FALSE(decodeAnnouncement(cut));
    }
    for (std::size_t bit = 0; bit < 8 * good.size(); ++bit)
    {
      Bytes bad = good;
      bad[bit / 8] = static_cast<std::uint8_t>(bad[bit / 8] ^ (1u << (bit % 8)));
      EXPECT_FALSE(decodeBeacon(bad));
      EXPECT_FALSE(decodeAnnouncement(bad));
    }
  }
}

TEST(Packets, OfRandomBytesWithARightChecksumDoNotCrash)
{
  std::mt19937 random(5);
  int read = 0;
  for (int i = 0; i < 100'000; ++i)
  {
    Bytes bytes(8 + random() % 60);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    std::memcpy(bytes.data(), random() % 2 ? "SLS1" : "SLT1", 4);
    if (random() % 2) bytes[4] = static_cast<std::uint8_t>(random() % 4);
    const std::uint32_t sum = fusion::checksum(bytes);
    std::memcpy(bytes.data() + bytes.size() - 4, &sum, 4);
    const auto b = decodeBeacon(bytes);
    EXPECT_TRUE(!b || std::isfinite(b->clock.value_or(0)));
    const auto a = decodeAnnouncement(bytes);
    EXPECT_TRUE(!a || std::isfinite(a->time));
    read += a || b;
  }
  EXPECT_GT(read, 1000);
}
}  // namespace slamot::live
