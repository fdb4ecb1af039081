#pragma once

#include <slamot/results/Figures.h>

namespace slamot::results
{
/// A made-up run for trying pictures: a robot on a circle, a target ahead of it, some landmarks.
struct SampleRun
{
  eval::Record record;
  eval::Truth truth;
  eval::Evaluation evaluation;

  [[nodiscard]] RunView view() const { return {record, truth, evaluation}; }
};

[[nodiscard]] SampleRun sampleRun(std::size_t steps = 320);
}  // namespace slamot::results
