#include "FakeTeamFilter.h"

#include <gtest/gtest.h>
#include <slamot/fusion/Receiver.h>
#include <slamot/math/random.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>

namespace slamot::fusion
{
namespace
{
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kNow = 10;

Candidate sightingOf(const Eigen::VectorXd& sender, double x, double y)
{
  const double dx = x - sender[0], dy = y - sender[1];
  return {std::hypot(dx, dy), math::wrapToPi(std::atan2(dy, dx) - sender[2]), 0.05, 0.01,
          core::kNoId};
}

// From robot 2, which stands elsewhere, knows the same target better, and sees robot 1, at (1, 2).
Message goodMessage(int targetSize = 6)
{
  Message m;
  m.sender = 2;
  m.sequence = 5;
  m.frame = "field";
  m.estimate = someEstimate(targetSize);
  m.estimate.mean.head(3) << 5, 3, 2.0;
  m.estimate.mean.tail(targetSize) *= 1.005;
  m.estimate.cov *= 0.2;
  m.candidates = {sightingOf(m.estimate.mean, 1.02, 1.97)};
  return m;
}

Receiver::Options options()
{
  Receiver::Options o;
  o.frame = "field";
  o.senders = {0, 1, 2, 3};
  o.identity = 11;
  return o;
}

// One robot with its receiver.
struct Robot
{
  FakeTeamFilter filter;
  Receiver receiver;

  explicit Robot(const Receiver::Options& o = options(), int targetSize = 6)
      : filter(someEstimate(targetSize)), receiver(1, o)
  {
  }
  Receipt hear(const Message& m, double now = kNow)
  {
    return receiver.receive(encode(m), now, filter);
  }
};

// The message is dropped for this reason, counted once, and leaves no trace in the filter.
void expectDropped(Robot& robot, const Bytes& bytes, Outcome outcome, double now = kNow)
{
  const auto before = robot.filter.bytes();
  const auto told = robot.filter.evidence.size();
  const auto count = robot.receiver.counts().of(outcome), all = robot.receiver.counts().messages();
  EXPECT_STREQ(name(robot.receiver.receive(bytes, now, robot.filter).outcome), name(outcome));
  EXPECT_EQ(robot.filter.bytes(), before) << name(outcome);
  EXPECT_EQ(robot.filter.evidence.size(), told) << name(outcome);
  EXPECT_EQ(robot.receiver.counts().of(outcome), count + 1) << name(outcome);
  EXPECT_EQ(robot.receiver.counts().messages(), all + 1) << name(outcome);
}
}  // namespace

TEST(Receiver, FusesCandidateAndTargetTogether)
{
  for (const int size : {4, 6})
  {
    Robot robot(options(), size);
    const auto before = robot.filter.bytes();
    const Receipt r = robot.hear(goodMessage(size));
    EXPECT_EQ(r.outcome, Outcome::kFused);
    EXPECT_EQ(r.sender, 2);
    EXPECT_EQ(r.candidate, 0);
    EXPECT_EQ(r.candidatesPassed, 1);
    EXPECT_TRUE(r.targetFused);
    EXPECT_LT(r.omega, 1);
    EXPECT_NE(robot.filter.bytes(), before);
    ASSERT_EQ(robot.filter.evidence.size(), 1u);
    const core::Evidence& e = robot.filter.evidence[0];
    EXPECT_EQ(e.target, 7);
    EXPECT_EQ(e.H.rows(), 2 + size);
    EXPECT_EQ(e.H.cols(), 3 + size);
    EXPECT_EQ(e.H.topLeftCorner(2, 2), Eigen::MatrixXd::Identity(2, 2));
    EXPECT_EQ(e.H.bottomRightCorner(size, size), Eigen::MatrixXd::Identity(size, size));
    EXPECT_EQ(e.H.sum(), 2 + size);
    EXPECT_NEAR(e.innovation[0], 0.02, 1e-12);
    EXPECT_NEAR(e.innovation[1], -0.03, 1e-12);
    EXPECT_NEAR(e.innovation[2], 0.02, 1e-12);
    EXPECT_GT(e.independent.topLeftCorner(2, 2).norm(), 0);
    EXPECT_EQ(e.independent.bottomRows(size).norm(), 0);
    EXPECT_GT(e.cov.topRightCorner(2, size).norm(), 0);  // the sender's cross term
    EXPECT_EQ(robot.receiver.counts().of(Outcome::kFused), 1);
    EXPECT_EQ(robot.receiver.counts().of(Note::kCandidateFused), 1);
    EXPECT_EQ(robot.receiver.counts().of(Note::kTargetFused), 1);
  }
}

TEST(Receiver, DropsEveryBadKindAndCountsIt)
{
  struct Bad
  {
    Outcome outcome;
    std::function<void(Message&)> spoil;
  };
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<Bad> kinds = {
      {Outcome::kFromItself, [](Message& m) { m.sender = 1; }},
      {Outcome::kUnknownSender, [](Message& m) { m.sender = 9; }},
      {Outcome::kUnknownSender, [](Message& m) { m.sender = -1; }},
      {Outcome::kToAnother, [](Message& m) { m.receiver = 3; }},
      {Outcome::kToAnother, [](Message& m) { m.receiver = -2; }},
      {Outcome::kOtherFrame, [](Message& m) { m.frame = "fields"; }},
      {Outcome::kOtherFrame, [](Message& m) { m.frame.clear(); }},
      {Outcome::kTooOld, [](Message& m) { m.estimate.time = kNow - 1.1; }},
      {Outcome::kFromTheFuture, [](Message& m) { m.estimate.time = kNow + 0.1; }},
      {Outcome::kNotFinite, [](Message& m) { m.estimate.time = kNaN; }},
      {Outcome::kNotFinite, [](Message& m) { m.estimate.mean[8] = kNaN; }},
      {Outcome::kNotFinite, [=](Message& m) { m.estimate.mean[2] = inf; }},
      {Outcome::kNotFinite, [](Message& m) { m.estimate.cov(8, 0) = kNaN; }},
      {Outcome::kNotFinite, [=](Message& m) { m.estimate.cov(3, 3) = -inf; }},
      {Outcome::kNotFinite, [](Message& m) { m.candidates[0].bearing = kNaN; }},
      {Outcome::kNotFinite, [=](Message& m) { m.candidates[0].rangeStd = inf; }},
      {Outcome::kAbsurd, [](Message& m) { m.estimate.cov(0, 0) = 1e9; }},
      {Outcome::kAbsurd, [](Message& m) { m.estimate.cov(4, 4) = 1e-20; }},
      {Outcome::kAbsurd, [](Message& m) { m.estimate.mean[1] = 1e9; }},
      {Outcome::kAbsurd, [](Message& m) { m.candidates[0].range = -1; }},
      {Outcome::kAbsurd, [](Message& m) { m.candidates[0].rangeStd = 0; }},
      {Outcome::kAbsurd, [](Message& m) { m.candidates[0].bearingStd = -0.01; }},
      {Outcome::kNotPositiveDefinite, [](Message& m) { m.estimate.cov(3, 3) *= -1; }},
      {Outcome::kNotPositiveDefinite, [](Message& m) { m.estimate.cov(0, 0) = 0; }},
      {Outcome::kNotPositiveDefinite, [](Message& m) { m.estimate.cov(4, 3) = 0.1; }},
      {Outcome::kNotPositiveDefinite, [](Message& m) { m.estimate.cov(4, 3) = 1e300; }},
      {Outcome::kNotPositiveDefinite, [](Message& m) { m.estimate.cov.bottomRows(6).setZero(); }},
      {Outcome::kTargetGateFailed, [](Message& m) { m.estimate.mean[3] += 3; }},
      {Outcome::kTargetGateFailed, [](Message& m) { m.estimate.mean[8] += 3; }},
      {Outcome::kNoSuchTarget,
       [](Message& m)
       {
         m.estimate.target = 8;
         m.candidates.clear();
       }},
      {Outcome::kNoSuchTarget,
       [](Message& m)
       {
         m.estimate.target = 8;
         m.candidates[0].range += 3;
       }},
      {Outcome::kCandidateGateFailed,
       [](Message& m)
       {
         m.estimate = someEstimate(0);
         m.candidates[0].range += 3;
       }},
      {Outcome::kNothingUsable,
       [](Message& m)
       {
         m.estimate = someEstimate(0);
         m.candidates.clear();
       }},
      {Outcome::kNothingUsable, [](Message& m) { m.estimate = someEstimate(0, kNow - 0.5); }},
  };
  for (std::size_t i = 0; i < kinds.size(); ++i)
  {
    SCOPED_TRACE("kind " + std::to_string(i));
    Robot robot;
    Message m = goodMessage();
    kinds[i].spoil(m);
    m.estimate.cov.triangularView<Eigen::StrictlyUpper>() = m.estimate.cov.transpose();
    expectDropped(robot, encode(m), kinds[i].outcome);
  }
}

TEST(Receiver, DropsDamagedBytes)
{
  Robot robot;
  const Bytes good = encode(goodMessage());
  Bytes b = good;
  b.pop_back();
  expectDropped(robot, b, Outcome::kWrongLength);
  expectDropped(robot, {}, Outcome::kWrongLength);
  b = good;
  b[4] = 2;
  expectDropped(robot, b, Outcome::kWrongVersion);
  b = good;
  b[100] ^= 1;
  expectDropped(robot, b, Outcome::kWrongChecksum);
  EXPECT_EQ(robot.receiver.receive(good, kNow, robot.filter).outcome, Outcome::kFused);
}

TEST(Receiver, TakesEachMessageOnceAndInOrder)
{
  Robot robot;
  Message m = goodMessage();
  EXPECT_EQ(robot.hear(m).outcome, Outcome::kFused);
  expectDropped(robot, encode(m), Outcome::kNotNewer);  // repeated
  m.sequence = 4;
  expectDropped(robot, encode(m), Outcome::kNotNewer);  // overtaken
  m.sequence = 6;
  m.estimate.mean[3] += 3;
  expectDropped(robot, encode(m), Outcome::kTargetGateFailed);
  m.estimate.mean[3] -= 3;
  expectDropped(robot, encode(m), Outcome::kNotNewer);  // a message that failed its gate is over
  m.sequence = 1;
  m.sender = 3;  // counts for itself
  EXPECT_NE(robot.hear(m).outcome, Outcome::kNotNewer);
  m.sender = 2;
  m.session = 1;  // started anew
  EXPECT_NE(robot.hear(m).outcome, Outcome::kNotNewer);
  m.session = 0;
  m.sequence = 100;
  expectDropped(robot, encode(m), Outcome::kNotNewer);
}

// Whoever sends nonsense under a high number must not make a good message look old.
TEST(Receiver, BadMessagesDoNotAdvanceTheSequence)
{
  Robot robot;
  Message m = goodMessage();
  m.sequence = 1000;
  m.estimate.cov(3, 3) *= -1;
  expectDropped(robot, encode(m), Outcome::kNotPositiveDefinite);
  m = goodMessage();
  m.sequence = 1000;
  m.estimate.time = kNow + 1;
  expectDropped(robot, encode(m), Outcome::kFromTheFuture);
  EXPECT_EQ(robot.hear(goodMessage()).outcome, Outcome::kFused);
}

TEST(Receiver, PredictsALateTargetAndLeavesLateCandidates)
{
  Robot robot;
  Message m = goodMessage();
  m.estimate.time = kNow - 0.5;
  m.estimate.mean.segment(3, 2) -= 0.5 * m.estimate.mean.segment(5, 2);
  const Receipt r = robot.hear(m);
  EXPECT_EQ(r.outcome, Outcome::kFused);
  EXPECT_EQ(r.candidate, -1);
  EXPECT_TRUE(r.targetFused);
  EXPECT_EQ(robot.receiver.counts().of(Note::kLateCandidates), 1);
  EXPECT_EQ(robot.receiver.counts().of(Note::kCandidateFused), 0);
  ASSERT_EQ(robot.filter.evidence.size(), 1u);
  const core::Evidence& e = robot.filter.evidence[0];
  EXPECT_EQ(e.H.rows(), 6);
  EXPECT_NEAR(e.innovation[0], 0.005 * 4, 1e-12);
  EXPECT_NEAR(e.innovation[1], 0.005 * 6, 1e-12);
  EXPECT_GT(e.cov(0, 0), m.estimate.cov(3, 3));
}

TEST(Receiver, FusesTheTargetWhereNoSightingFits)
{
  Robot robot;
  Message m = goodMessage();
  m.candidates = {sightingOf(m.estimate.mean, 4, 4), sightingOf(m.estimate.mean, 9, 1)};
  EXPECT_EQ(robot.hear(m).outcome, Outcome::kFused);
  EXPECT_EQ(robot.filter.evidence[0].H.rows(), 6);
  EXPECT_EQ(robot.receiver.counts().of(Note::kCandidatesOutside), 1);
}

// Robot 3 told that it is where the sighting is, too.
TEST(Receiver, LeavesOutASightingThatCouldBeAnotherRobot)
{
  for (const bool near : {false, true})
  {
    Robot robot;
    Message mate = goodMessage();
    mate.sender = 3;
    mate.candidates.clear();
    mate.estimate.mean.head(2) << (near ? 1.03 : 40), 1.96;
    robot.hear(mate);
    const Receipt r = robot.hear(goodMessage());
    EXPECT_EQ(r.candidate, near ? -1 : 0);
    EXPECT_EQ(robot.receiver.counts().of(Note::kCouldBeAnother), near ? 1 : 0);
  }
  // A name leaves no doubt, and what was heard long ago tells nothing.
  Robot robot;
  Message mate = goodMessage(), named = goodMessage();
  mate.sender = 3;
  mate.candidates.clear();
  mate.estimate.mean.head(2) << 1.03, 1.96;
  robot.hear(mate);
  named.candidates[0].id = 11;
  EXPECT_EQ(robot.hear(named).candidate, 0);
  Message later = goodMessage();
  later.sequence = 9;
  later.estimate.time = kNow + 6;
  later.estimate.mean.segment(3, 6) = goodMessage().estimate.mean.segment(3, 6);
  EXPECT_EQ(robot.hear(later, kNow + 6).candidate, 0);
}

TEST(Receiver, FusesASightingWithoutACommonTarget)
{
  for (const int told : {0, 4})
  {
    Robot robot(options(), told == 0 ? 6 : 0);
    Message m = goodMessage(told);
    m.estimate.cov *= 0.01;
    m.candidates[0].rangeStd = 0.01;
    m.candidates[0].bearingStd = 0.001;
    const Receipt r = robot.hear(m);
    EXPECT_TRUE(r.outcome == Outcome::kFused || r.outcome == Outcome::kDidNotPay);
    EXPECT_FALSE(r.targetFused);
    EXPECT_EQ(r.candidate, 0);
    ASSERT_EQ(robot.filter.evidence.size(), 1u);
    EXPECT_EQ(robot.filter.evidence[0].target, core::kNoId);
    EXPECT_EQ(robot.filter.evidence[0].H.rows(), 2);
    EXPECT_EQ(robot.filter.evidence[0].H.cols(), 3);
  }
}

TEST(Receiver, TargetsOfTwoKindsShareFourCoordinates)
{
  for (const int own : {4, 6})
  {
    Robot robot(options(), own);
    EXPECT_EQ(robot.hear(goodMessage(10 - own)).outcome, Outcome::kFused);
    EXPECT_EQ(robot.filter.evidence[0].H.rows(), 6);
    EXPECT_EQ(robot.filter.evidence[0].H.cols(), 3 + own);
  }
}

TEST(Receiver, TakesTheLikeliestOfSeveralSightings)
{
  Robot robot;
  Message m = goodMessage();
  m.candidates = {sightingOf(m.estimate.mean, 1.2, 2.2), sightingOf(m.estimate.mean, 1.01, 2.01),
                  sightingOf(m.estimate.mean, 0.8, 2), sightingOf(m.estimate.mean, 5, 5)};
  const Receipt r = robot.hear(m);
  EXPECT_EQ(r.outcome, Outcome::kFused);
  EXPECT_EQ(r.candidatesPassed, 3);
  EXPECT_EQ(r.candidate, 1);
  EXPECT_EQ(robot.receiver.counts().of(Note::kAmbiguous), 1);
}

TEST(Receiver, BelievesIdentities)
{
  Message m = goodMessage();
  m.candidates[0].id = 12;  // that is another robot
  Robot other;
  EXPECT_EQ(other.hear(m).candidate, -1);

  m = goodMessage();
  m.candidates.push_back(sightingOf(m.estimate.mean, 1.1, 2.1));
  m.candidates[1].id = 11;  // this one, though the unnamed one fits better
  Robot robot;
  const Receipt r = robot.hear(m);
  EXPECT_EQ(r.candidate, 1);
  EXPECT_EQ(r.candidatesPassed, 1);
}

// A heading error of the sender moves both the sighting and the target the same way.
TEST(Receiver, SightingMustFitTogetherWithTheTarget)
{
  const auto message = [](double seenOff, double targetOff)
  {
    Message m = goodMessage(4);
    core::RobotAndTarget& e = m.estimate;
    e.mean << -20, 2, 0, 4, 6, 0.3, -0.2;
    Eigen::VectorXd common(7);
    common << 0, 0, 0.1, -0.4, 2.4, 0, 0;
    e.cov = common * common.transpose();
    e.cov.diagonal() += Eigen::VectorXd::Constant(7, 1e-3);
    e.mean[4] += targetOff;
    m.candidates = {sightingOf(e.mean, 1, 2 + seenOff)};
    return m;
  };
  Robot same(options(), 4), against(options(), 4);
  EXPECT_EQ(same.hear(message(2.5, 2.5)).candidatesPassed, 1);
  EXPECT_EQ(against.hear(message(-2.5, 2.5)).candidatesPassed, 0);
  ASSERT_EQ(against.filter.evidence.size(), 1u);  // the target alone
  EXPECT_EQ(against.filter.evidence[0].H.rows(), 4);
}

TEST(Receiver, CountsWhatTheFilterMakesOfIt)
{
  Robot vague;
  Message m = goodMessage();
  m.estimate.cov *= 1e4;
  m.candidates.clear();
  const auto before = vague.filter.bytes();
  EXPECT_EQ(vague.hear(m).outcome, Outcome::kDidNotPay);
  EXPECT_EQ(vague.filter.bytes(), before);
  EXPECT_EQ(vague.receiver.counts().of(Outcome::kDidNotPay), 1);

  Robot refusing;
  refusing.filter.refuses = true;
  EXPECT_EQ(refusing.hear(goodMessage()).outcome, Outcome::kRefusedByFilter);
  EXPECT_EQ(refusing.filter.bytes(), before);

  Receiver::Options off = options();
  off.fusion.rule = core::FusionRule::kNone;
  Robot deaf(off);
  expectDropped(deaf, encode(goodMessage()), Outcome::kFusionOff);
}

TEST(Receiver, CountsHaveNamesForReports)
{
  const auto rows = MessageCounts().rows();
  ASSERT_EQ(rows.size(), std::size_t(Outcome::kCount) + std::size_t(Note::kCount));
  std::set<std::string> names;
  for (const auto& [key, count] : rows)
  {
    EXPECT_EQ(count, 0);
    EXPECT_FALSE(key.empty());
    names.insert(key);
  }
  EXPECT_EQ(names.size(), rows.size());
  EXPECT_STREQ(name(Outcome::kRefusedByFilter), "refused_by_filter");
  EXPECT_STREQ(name(Note::kTargetFused), "target_fused");
}

TEST(Receiver, RefusesOptionsThatMakeNoSense)
{
  Receiver::Options o = options();
  o.candidateGate = 1;
  EXPECT_THROW(Receiver(1, o), core::Error);
  o = options();
  o.maxAge = kNaN;
  EXPECT_THROW(Receiver(1, o), core::Error);
  o = options();
  o.frame.clear();
  EXPECT_THROW(Receiver(1, o), core::Error);
}

// Written from the layout's table by another program: doc/team.md.  What the fuzzer found, too.
TEST(Receiver, HearsMessagesOfOtherPrograms)
{
  const auto outcome = [](const std::string& file)
  {
    std::ifstream in(std::string(SLAMOT_FUZZ_CORPUS) + "/" + file, std::ios::binary);
    const Bytes bytes{std::istreambuf_iterator<char>(in), {}};
    Robot robot;
    return robot.receiver.receive(bytes, kNow, robot.filter);
  };
  const Receipt acceleration = outcome("acceleration"), velocity = outcome("velocity");
  EXPECT_STREQ(name(acceleration.outcome), "fused");
  EXPECT_EQ(acceleration.candidate, -1);  // one that is named is another place
  EXPECT_STREQ(name(velocity.outcome), "fused");
  EXPECT_EQ(velocity.candidate, 0);
  EXPECT_STREQ(name(outcome("robot").outcome), "did_not_pay");
}

// A million messages: noise, and good ones damaged, some of them with a new checksum.
TEST(Receiver, SurvivesAMillionRandomMessages)
{
  math::RandomStream random{1};
  const Bytes good = encode(goodMessage());
  Robot robot;
  auto state = robot.filter.bytes();
  int fused = 0;
  for (int i = 0; i < 1000000; ++i)
  {
    Bytes b = good;
    const int kind = i % 20;
    if (kind < 8) b.resize(static_cast<std::size_t>(random() % 700));
    const auto touched = kind < 8 ? b.size() / 8 : 1 + random() % 3;
    for (std::size_t k = 0; k < touched && !b.empty(); ++k)
      b[kind < 2 ? 8 * k : random() % b.size()] = static_cast<std::uint8_t>(random());
    if (kind == 19)  // what a wrong sender could send
    {
      for (int k = 0; k < 16; ++k)  // session, sequence
        b[16 + k] =
            k < 8 ? 0 : static_cast<std::uint8_t>(static_cast<std::uint64_t>(i) >> 8 * (k - 8));
      if (i % 200 == 19)  // no number
        std::fill_n(b.begin() + 76 + 8 * static_cast<int>(random() % 54), 8, std::uint8_t{0xFF});
      const std::uint32_t sum = checksum(b);
      for (int k = 0; k < 4; ++k) b[b.size() - 4 + k] = static_cast<std::uint8_t>(sum >> (8 * k));
    }
    const Receipt r = robot.receiver.receive(b, kNow, robot.filter);
    if (r.outcome != Outcome::kFused)
    {
      ASSERT_EQ(robot.filter.bytes(), state) << "message " << i << " " << name(r.outcome);
    }
    else
    {
      ASSERT_EQ(kind, 19) << "message " << i;
      ++fused;
      const auto e = robot.filter.robotAndTarget(7);
      ASSERT_TRUE(e.mean.allFinite() && e.cov.allFinite()) << "message " << i;
      ASSERT_GT(math::smallestEigenvalue(e.cov), -1e-12) << "message " << i;
      robot.filter = FakeTeamFilter(someEstimate(6));
      state = robot.filter.bytes();
    }
  }
  EXPECT_EQ(robot.receiver.counts().messages(), 1000000);
  EXPECT_GT(fused, 100);  // low bits of a value: a good message
  EXPECT_GT(robot.receiver.counts().of(Outcome::kNotFinite), 0);
  EXPECT_GT(robot.receiver.counts().of(Outcome::kNotPositiveDefinite), 100);
}
}  // namespace slamot::fusion
