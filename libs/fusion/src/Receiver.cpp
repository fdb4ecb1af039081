#include <slamot/core/Error.h>
#include <slamot/fusion/Receiver.h>
#include <slamot/fusion/candidates.h>
#include <slamot/math/statistics.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace slamot::fusion
{
namespace
{
using core::RobotAndTarget;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A difference and its covariance, against a gate.
struct Gate
{
  bool passed = false;
  double cost = 0;  ///< minus twice the log likelihood, but for a constant

  Gate(const VectorXd& difference, const MatrixXd& cov, double probability)
  {
    const Eigen::LLT<MatrixXd> llt(cov);
    if (llt.info() != Eigen::Success) return;
    const double d2 = llt.matrixL().solve(difference).squaredNorm();
    const auto dof = static_cast<double>(difference.size());
    passed = d2 <= math::chiSquareQuantile(probability, dof);
    cost = d2 + 2 * MatrixXd(llt.matrixL()).diagonal().array().log().sum();
  }
};

/// Rows of one's own coordinates: the place, if `withPlace`, and `shared` ones of the target.
MatrixXd rowsOf(const RobotAndTarget& own, bool withPlace, int shared)
{
  const int first = withPlace ? 2 : 0;
  MatrixXd H = MatrixXd::Zero(first + shared, own.mean.size());
  for (int i = 0; i < first; ++i) H(i, i) = 1;
  for (int i = 0; i < shared; ++i) H(first + i, RobotAndTarget::kRobot + i) = 1;
  return H;
}

core::Evidence evidenceOf(const SeenPlace& told, const RobotAndTarget& own, bool withPlace,
                          int shared)
{
  core::Evidence out;
  out.target = shared > 0 ? own.target : core::kNoId;
  out.H = rowsOf(own, withPlace, shared);
  out.innovation = told.mean - out.H * own.mean;
  out.cov = told.cov;
  out.independent = told.independent;
  return out;
}

/// Whether it could be of the same, by the sum of both covariances.
Gate gateOf(const core::Evidence& e, const RobotAndTarget& own, double probability)
{
  return {e.innovation, e.H * own.cov * e.H.transpose() + e.cov, probability};
}

SeenPlace targetOf(const RobotAndTarget& sender, int shared)
{
  return {sender.mean.segment(RobotAndTarget::kRobot, shared),
          sender.cov.block(RobotAndTarget::kRobot, RobotAndTarget::kRobot, shared, shared),
          MatrixXd::Zero(shared, shared)};
}
}  // namespace

Receiver::Receiver(int self, Options options) : self_(self), options_(std::move(options))
{
  const auto require = [](bool ok, const char* what)
  {
    if (!ok) throw core::Error(core::ExitStatus::kConfig, "team", what);
  };
  const auto isProbability = [](double p) { return p > 0 && p < 1; };
  const Options& o = options_;
  require(isProbability(o.candidateGate) && isProbability(o.targetGate),
          "a gate is a probability in (0, 1)");
  require(o.maxAge >= 0 && o.candidateMaxAge >= 0 && o.futureTolerance >= 0,
          "an age is negative or no number");
  require(!o.frame.empty() && o.frame.size() <= kMaxFrameLength,
          "the frame's name has 1 to 32 characters");
}

Receipt Receiver::receive(const Bytes& bytes, double now, core::TeamFilter& filter)
{
  Receipt receipt;
  const auto decoded = decode(bytes);
  if (const auto* why = std::get_if<Outcome>(&decoded))
    receipt.outcome = *why;
  else
  {
    const Message& m = std::get<Message>(decoded);
    receipt.sender = m.sender;
    std::optional<Outcome> wrong = checkEnvelope(m, now);
    if (!wrong) wrong = checkValues(m, options_.limits);
    if (wrong)
      receipt.outcome = *wrong;
    else
    {
      last_[m.sender] = {m.session, m.sequence};
      fuse(m, now, filter, receipt);
      const RobotAndTarget& e = m.estimate;
      if (receipt.outcome != Outcome::kTargetGateFailed)
        mates_[m.sender] = {e.time, {{e.mean[0], e.mean[1]}, e.cov.topLeftCorner<2, 2>()}};
    }
  }
  counts_.add(receipt.outcome);
  return receipt;
}

std::optional<Outcome> Receiver::checkEnvelope(const Message& m, double now) const
{
  if (m.sender == self_) return Outcome::kFromItself;
  if (options_.senders.count(m.sender) == 0) return Outcome::kUnknownSender;
  if (m.receiver != kAll && m.receiver != self_) return Outcome::kToAnother;
  if (m.frame != options_.frame) return Outcome::kOtherFrame;
  const auto last = last_.find(m.sender);
  if (last != last_.end() && std::pair(m.session, m.sequence) <= last->second)
    return Outcome::kNotNewer;
  const double age = now - m.estimate.time;
  if (!std::isfinite(age)) return Outcome::kNotFinite;
  if (age > options_.maxAge) return Outcome::kTooOld;
  if (age < -options_.futureTolerance) return Outcome::kFromTheFuture;
  return {};
}

void Receiver::fuse(const Message& m, double now, core::TeamFilter& filter, Receipt& receipt)
{
  const RobotAndTarget own = filter.robotAndTarget(m.estimate.target);
  const int shared = std::min(own.targetSize(), m.estimate.targetSize());
  const double age = std::max(0.0, now - m.estimate.time);
  RobotAndTarget told = m.estimate;
  if (age > 0 && shared > 0) filter.predictTarget(told, age);

  std::optional<core::Evidence> evidence;
  if (shared > 0)
  {
    evidence = evidenceOf(targetOf(told, shared), own, false, shared);
    if (!gateOf(*evidence, own, options_.targetGate).passed)
    {
      receipt.outcome = Outcome::kTargetGateFailed;
      return;
    }
  }
  const bool seen = !m.candidates.empty(), late = seen && age > options_.candidateMaxAge;
  if (late)
    counts_.add(Note::kLateCandidates);
  else if (seen)
    chooseCandidate(m, now, told, own, shared, evidence, receipt);

  if (evidence)
    deliver(*evidence, shared, filter, receipt);
  else if (m.estimate.targetSize() > 0)
    receipt.outcome = Outcome::kNoSuchTarget;
  else
    receipt.outcome = seen && !late ? Outcome::kCandidateGateFailed : Outcome::kNothingUsable;
}

bool Receiver::couldBeAnother(const core::Evidence& place, const RobotAndTarget& own, int sender,
                              double now) const
{
  constexpr double kFresh = 5;  // [s]: older ones tell nothing
  const Vector2 at = place.innovation + own.mean.head<2>();
  return std::any_of(mates_.begin(), mates_.end(),
                     [&](const auto& entry)
                     {
                       const auto& [number, mate] = entry;
                       const double age = std::abs(now - mate.time);
                       if (number == sender || age > kFresh) return false;
                       const Vector2 off = at - Vector2(mate.place.mean.x, mate.place.mean.y);
                       const MatrixXd cov =
                           mate.place.cov + place.cov +
                           std::pow(options_.mateSpeed * age, 2) * Matrix2::Identity();
                       return Gate(off, cov, options_.candidateGate).passed;
                     });
}

void Receiver::chooseCandidate(const Message& m, double now, const RobotAndTarget& told,
                               const RobotAndTarget& own, int shared,
                               std::optional<core::Evidence>& evidence, Receipt& receipt)
{
  std::vector<Candidate> candidates = m.candidates;
  if (!options_.believeIdentities)
    for (Candidate& c : candidates) c.id = core::kNoId;
  // A sensor that knows this robot says so: then it is none of the unknown ones.
  const bool known = options_.identity != core::kNoId &&
                     std::any_of(candidates.begin(), candidates.end(),
                                 [this](const Candidate& c) { return c.id == options_.identity; });
  double lowest = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i)
  {
    const Candidate& c = candidates[i];
    if (c.id != (known ? options_.identity : core::kNoId)) continue;
    const auto place = evidenceOf(placeOf(c, told, 0), own, true, 0);
    if (!gateOf(place, own, options_.candidateGate).passed) continue;
    if (!known && couldBeAnother(place, own, m.sender, now))
    {
      counts_.add(Note::kCouldBeAnother);
      continue;
    }
    const auto both = evidenceOf(placeOf(c, told, shared), own, true, shared);
    const Gate gate = gateOf(both, own, shared > 0 ? options_.targetGate : options_.candidateGate);
    if (!gate.passed) continue;
    if (++receipt.candidatesPassed > 1 && gate.cost >= lowest) continue;
    lowest = gate.cost;
    evidence = both;
    receipt.candidate = static_cast<int>(i);
  }
  if (receipt.candidatesPassed == 0) counts_.add(Note::kCandidatesOutside);
  if (receipt.candidatesPassed > 1) counts_.add(Note::kAmbiguous);
}

void Receiver::deliver(const core::Evidence& evidence, int shared, core::TeamFilter& filter,
                       Receipt& receipt)
{
  if (options_.fusion.rule == core::FusionRule::kNone)
    receipt.outcome = Outcome::kFusionOff;
  else if (!positiveDefinite(evidence.cov))
    receipt.outcome = Outcome::kNotPositiveDefinite;
  else
  {
    try
    {
      const core::Fusion fusion = filter.fuse(evidence, options_.fusion);
      receipt.outcome = fusion.fused ? Outcome::kFused : Outcome::kDidNotPay;
      receipt.omega = fusion.omega;
    }
    catch (const core::Error&)
    {
      receipt.outcome = Outcome::kRefusedByFilter;
    }
  }
  if (receipt.outcome != Outcome::kFused) return;
  receipt.targetFused = shared > 0;
  if (receipt.targetFused) counts_.add(Note::kTargetFused);
  if (receipt.candidate >= 0) counts_.add(Note::kCandidateFused);
}
}  // namespace slamot::fusion
