#include <slamot/core/FilterRegistry.h>

#include <new>
#include <stdexcept>

namespace
{
using namespace slamot;

/// A plugin's filter that fails at its third step as a filter must not.
class FaultyFilter : public core::Filter
{
 public:
  FaultyFilter(core::Params& params, const core::FilterContext& /*context*/)
      : outOfMemory_(params.choice("fault", {"bug", "memory"}) == "memory")
  {
  }

  core::Update process(const core::Step& step) override
  {
    if (++steps_ == 3 && outOfMemory_) throw std::bad_alloc();
    if (steps_ == 3) throw std::logic_error("index 7 of 7");
    core::Update update;
    update.estimate.time = step.time;
    return update;
  }
  [[nodiscard]] core::Estimate estimate() const override { return {}; }

 private:
  bool outOfMemory_;
  int steps_ = 0;
};
}  // namespace

SLAMOT_REGISTER_FILTER("faulty", FaultyFilter)
