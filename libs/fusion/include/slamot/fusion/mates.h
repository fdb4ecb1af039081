#pragma once

#include <slamot/core/run.h>

#include <string>

namespace slamot::fusion
{
/// Takes the blobs of this label out of a step: they may be team mates, and are for the others.
/// An empty label takes out none.
void takeOutMates(core::Step& step, const std::string& label);

/// A log as the filter of a team's robot gets to see it: without the blobs of team mates.
class WithoutMates : public core::Source
{
 public:
  /// `source` must outlive this.
  WithoutMates(core::Source& source, std::string label) : source_(&source), label_(std::move(label))
  {
  }

  std::optional<core::Step> next() override
  {
    auto step = source_->next();
    if (step) takeOutMates(*step, label_);
    return step;
  }
  [[nodiscard]] double progress() const override { return source_->progress(); }

 private:
  core::Source* source_;
  std::string label_;
};
}  // namespace slamot::fusion
