#include "resampling.h"

namespace slamot::filters
{
::mrpt::bayes::CParticleFilter::TParticleFilterOptions resamplingFrom(core::Params& p,
                                                                      int particles)
{
  using PF = ::mrpt::bayes::CParticleFilter;
  PF::TParticleFilterOptions o;
  o.BETA = p.inRange("resample_below_ess", 0, 1, 0.5);
  const std::string scheme =
      p.choice("resampling", {"systematic", "stratified", "residual", "multinomial"}, "systematic");
  o.resamplingMethod = scheme == "systematic"   ? PF::prSystematic
                       : scheme == "stratified" ? PF::prStratified
                       : scheme == "residual"   ? PF::prResidual
                                                : PF::prMultinomial;
  o.PF_algorithm = PF::pfStandardProposal;
  o.adaptiveSampleSize = false;
  o.sampleSize = static_cast<unsigned>(particles);
  return o;
}
}  // namespace slamot::filters
