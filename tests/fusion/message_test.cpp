#include "FakeTeamFilter.h"

#include <gtest/gtest.h>
#include <slamot/fusion/Sender.h>
#include <slamot/math/random.h>

#include <limits>

namespace slamot::fusion
{
namespace
{
Message someMessage(int targetSize, int candidates)
{
  Message m;
  m.sender = 2;
  m.receiver = 1;
  m.session = 0xFEDCBA9876543210u;
  m.sequence = 42;
  m.frame = "field";
  m.estimate = someEstimate(targetSize);
  for (int i = 0; i < candidates; ++i)
    m.candidates.push_back({2.5 + i, -0.25 * i, 0.1, 0.02, i - 1});
  return m;
}

Outcome outcomeOf(const Bytes& bytes)
{
  const auto decoded = decode(bytes);
  const auto* outcome = std::get_if<Outcome>(&decoded);
  return outcome ? *outcome : Outcome::kFused;
}

void sign(Bytes& bytes)
{
  const std::uint32_t sum = checksum(bytes);
  for (int i = 0; i < 4; ++i)
    bytes[bytes.size() - 4 + i] = static_cast<std::uint8_t>(sum >> (8 * i));
}

template <class M>
bool sameBits(const M& a, const M& b)
{
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}
}  // namespace

TEST(TeamMessage, FitsInto700BytesWithThreeCandidates)
{
  EXPECT_EQ(encode(someMessage(6, 3)).size(), 620u);
  EXPECT_EQ(encode(someMessage(6, 3)).size(), encodedSize(9, 3));
  EXPECT_EQ(encode(someMessage(0, 0)).size(), encodedSize(3, 0));
  EXPECT_LE(encodedSize(9, kMaxCandidates), 1472u);  // one UDP datagram in one Ethernet frame
}

TEST(TeamMessage, ComesBackToTheBit)
{
  math::RandomStream random{1};
  for (const int size : {0, 4, 6})
    for (int candidates = 0; candidates <= kMaxCandidates; ++candidates)
    {
      Message m = someMessage(size, candidates);
      for (double& x : m.estimate.mean) x = random.normal() * std::exp(20 * random.normal());
      m.estimate.mean[0] = -0.0;
      m.estimate.mean[1] = std::numeric_limits<double>::denorm_min();
      m.estimate.mean[2] = std::numeric_limits<double>::quiet_NaN();
      m.receiver = kAll;
      m.frame = std::string(candidates * 2, 'x');
      const auto decoded = decode(encode(m));
      ASSERT_TRUE(std::holds_alternative<Message>(decoded));
      const Message& back = std::get<Message>(decoded);
      EXPECT_EQ(back.sender, m.sender);
      EXPECT_EQ(back.receiver, kAll);
      EXPECT_EQ(back.session, m.session);
      EXPECT_EQ(back.sequence, m.sequence);
      EXPECT_EQ(back.frame, m.frame);
      EXPECT_EQ(back.estimate.time, m.estimate.time);
      EXPECT_EQ(back.estimate.target, m.estimate.target);
      EXPECT_TRUE(sameBits(back.estimate.mean, m.estimate.mean));
      EXPECT_TRUE(sameBits(back.estimate.cov, m.estimate.cov));
      ASSERT_EQ(back.candidates.size(), m.candidates.size());
      for (std::size_t i = 0; i < m.candidates.size(); ++i)
      {
        const Candidate &a = m.candidates[i], &b = back.candidates[i];
        EXPECT_EQ(a.range, b.range);
        EXPECT_EQ(a.bearing, b.bearing);
        EXPECT_EQ(a.rangeStd, b.rangeStd);
        EXPECT_EQ(a.bearingStd, b.bearingStd);
        EXPECT_EQ(a.id, b.id);
      }
    }
}

// Golden: doc/team.md's table; other programs read these bytes.
TEST(TeamMessage, HasTheDocumentedLayout)
{
  const Bytes b = encode(someMessage(6, 3));
  EXPECT_EQ(std::string(b.begin(), b.begin() + 4), "SLTM");
  EXPECT_EQ(b[4], 1);  // version
  EXPECT_EQ(b[5], 0);
  EXPECT_EQ(b[6], 9);
  EXPECT_EQ(b[7], 3);
  EXPECT_EQ(b[8], 2);      // sender
  EXPECT_EQ(b[12], 1);     // receiver
  EXPECT_EQ(b[16], 0x10);  // session, lowest byte first
  EXPECT_EQ(b[24], 42);    // sequence
  EXPECT_EQ(b[39], 0x40);  // time 10.0 = 0x4024000000000000
  EXPECT_EQ(b[38], 0x24);
  EXPECT_EQ(std::string(b.begin() + 40, b.begin() + 46), std::string("field\0", 6));
  EXPECT_EQ(b[72], 7);          // target
  EXPECT_EQ(b[76 + 7], 0x3F);   // mean[0] = 1.0
  EXPECT_EQ(b[508 + 7], 0x40);  // first candidate's range 2.5
  Bytes check = {'1', '2', '3', '4', '5', '6', '7', '8', '9', 0, 0, 0, 0};
  EXPECT_EQ(checksum(check), 0xCBF43926u);  // the standard's check value
}

TEST(TeamMessage, SaysWhyItIsNone)
{
  const Bytes good = encode(someMessage(6, 3));
  EXPECT_EQ(outcomeOf(good), Outcome::kFused);
  for (std::size_t n = 0; n < good.size(); ++n)
    EXPECT_EQ(outcomeOf(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(n))),
              Outcome::kWrongLength);
  Bytes b = good;
  b.push_back(0);
  EXPECT_EQ(outcomeOf(b), Outcome::kWrongLength);
  for (std::size_t i = 0; i < good.size(); ++i)
    for (int bit = 0; bit < 8; ++bit)
    {
      b = good;
      b[i] = static_cast<std::uint8_t>(b[i] ^ (1 << bit));
      EXPECT_EQ(outcomeOf(b), i < 6   ? Outcome::kWrongVersion
                              : i < 8 ? Outcome::kWrongLength
                                      : Outcome::kWrongChecksum)
          << "byte " << i;
    }
  b = good;
  b[72] = b[73] = b[74] = b[75] = 0xFF;  // no target
  sign(b);
  EXPECT_EQ(outcomeOf(b), Outcome::kContradictory);
}

TEST(TeamMessage, RefusesToEncodeWhatCannotBeSent)
{
  const auto refused = [](const Message& m) { EXPECT_THROW((void)encode(m), core::Error); };
  Message m = someMessage(6, kMaxCandidates + 1);
  refused(m);
  m = someMessage(6, 0);
  m.frame = std::string(kMaxFrameLength + 1, 'x');
  refused(m);
  m = someMessage(6, 0);
  m.frame = std::string("a\0b", 3);
  refused(m);
  m = someMessage(6, 0);
  m.estimate.mean.conservativeResize(8);
  refused(m);
  m = someMessage(4, 0);
  m.estimate.cov = Eigen::MatrixXd::Identity(6, 6);
  refused(m);
  m = someMessage(4, 0);
  m.estimate.target = core::kNoId;
  refused(m);
}

TEST(TeamSender, TellsEstimateAndPossibleMates)
{
  const FakeTeamFilter filter(someEstimate(6, 12.5));
  core::Step step;
  step.time = 12.5;
  step.blobs.emplace();
  step.blobs->blobs = {{"target", 3.0, 0.1, 0.1, 0.01, 7},
                       {"robot", 4.0, 0.2, 0.1, 0.01, 5},
                       {"robot", std::nullopt, 0.3, 0, 0.01, 6},
                       {"robot", 6.0, -0.4, 0.2, 0.03, core::kNoId}};
  Sender::Options options;
  options.frame = "field";
  options.target = 7;
  options.session = 99;
  Sender sender(4, options);
  const Message m = sender.make(filter, step);
  EXPECT_EQ(m.sender, 4);
  EXPECT_EQ(m.receiver, kAll);
  EXPECT_EQ(m.session, 99u);
  EXPECT_EQ(m.estimate.target, 7);
  EXPECT_EQ(m.estimate.time, 12.5);
  EXPECT_EQ(m.estimate.mean, someEstimate(6).mean);
  ASSERT_EQ(m.candidates.size(), 2u);
  EXPECT_EQ(m.candidates[0].range, 4);
  EXPECT_EQ(m.candidates[0].id, 5);
  EXPECT_EQ(m.candidates[1].bearing, -0.4);
  EXPECT_EQ(m.candidates[1].bearingStd, 0.03);

  const Message next = sender.make(filter, step, 2);
  EXPECT_EQ(next.sequence, m.sequence + 1);
  EXPECT_EQ(next.receiver, 2);
  step.time = 12;  // not what the estimate is of
  EXPECT_TRUE(sender.make(filter, step).candidates.empty());

  step.time = 12.5;
  options.tellIdentities = false;
  options.maxCandidates = 1;
  options.target = 8;  // not followed
  const Message short_ = Sender(4, options).make(filter, step);
  ASSERT_EQ(short_.candidates.size(), 1u);
  EXPECT_EQ(short_.candidates[0].id, core::kNoId);
  EXPECT_EQ(short_.estimate.target, core::kNoId);
  EXPECT_EQ(encode(short_).size(), encodedSize(3, 1));
}
}  // namespace slamot::fusion
