#pragma once

#include <slamot/core/Params.h>

#include <mrpt/bayes/CParticleFilter.h>

namespace slamot::filters
{
/// How to resample so many particles: resample_below_ess, resampling.
::mrpt::bayes::CParticleFilter::TParticleFilterOptions resamplingFrom(core::Params& p,
                                                                      int particles);
}  // namespace slamot::filters
