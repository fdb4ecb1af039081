#include "filterRig.h"

#include <slamot/laws/checkFilter.h>

namespace slamot::filters
{
namespace
{
laws::LawOptions options()
{
  laws::LawOptions out;
  // The laws' targets drive in circles, where trackers have them go straight.
  out.targetNees = {0.3, 3, "the model of motion is another"};
  return out;
}

std::string keys(const std::string& more)
{
  return "target_velocity_std_mps = 0.8\ntarget_acceleration_noise_mps2_per_sqrt_hz = 0.4\n" + more;
}

void check(const std::string& name, const std::string& more, const laws::LawOptions& o = options())
{
  registerAll();
  laws::checkFilter(name, core::Config::parse("[" + name + "]\n" + keys(more), "test"), o);
}

TEST(TrackerLaws, AreObeyedByTheKalmanTracker)
{
  check("kalman-tracker", "");
  check("kalman-tracker", "observation = position\nassociation = known\n");
}

TEST(TrackerLaws, AreObeyedByTheImmTracker)
{
  check("imm-tracker", "");
  check("imm-tracker", "observation = position\ntarget_glint_law = laplace\n");
}

TEST(TrackerLaws, AreObeyedByTheParticleTracker)
{
  check("particle-tracker", "");
  check("particle-tracker",
        "observation = position\ntarget_glint_probability = 0.1\nweight_exponent = 0.9\n");
}
}  // namespace
}  // namespace slamot::filters
