#include <slamot/fusion/TeamOptions.h>

namespace slamot::fusion
{
namespace
{
core::FusionRule ruleNamed(const std::string& name)
{
  if (name == "ci") return core::FusionRule::kCi;
  if (name == "split-ci") return core::FusionRule::kSplitCi;
  if (name == "ici") return core::FusionRule::kIci;
  if (name == "paper") return core::FusionRule::kPaper;
  return core::FusionRule::kNone;  // none, and centralized, where there is nothing to fuse
}
}  // namespace

TeamOptions TeamOptions::from(core::Config& config, std::uint64_t seed)
{
  core::Params p(config, "team");
  TeamOptions out;
  out.ruleName = p.choice("rule", {"ci", "split-ci", "ici", "paper", "none", "centralized"}, "ci");
  out.fusion.rule = ruleNamed(out.ruleName);
  out.centralized = out.ruleName == "centralized";
  if (p.has("omega")) out.fusion.omega = p.inRange("omega", 0.01, 1);
  out.fusion.headingLever = p.nonNegative("heading_lever_m", out.fusion.headingLever);
  out.exchangeEvery = p.integer("exchange_every", 1, 1'000'000, 1);
  out.target = p.integer("target", -1, 1'000'000'000, 0);
  out.mateLabel = p.text("mate_label", "robot");
  out.mateIdentities = p.flag("mate_identities", false);
  out.mateSpeed = p.nonNegative("mate_speed_mps", out.mateSpeed);
  out.frame = p.text("frame", "map");
  out.candidateGate = p.probability("candidate_gate_probability", out.candidateGate);
  out.targetGate = p.probability("target_gate_probability", out.targetGate);
  out.maxAge = p.positive("message_max_age_s", out.maxAge);
  out.candidateMaxAge = p.nonNegative("candidate_max_age_s", out.candidateMaxAge);
  out.radio = Radio::Options::from(p, seed);
  return out;
}
}  // namespace slamot::fusion
