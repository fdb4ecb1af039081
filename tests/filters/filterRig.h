#pragma once

#include <gtest/gtest.h>
#include <slamot/core/FilterRegistry.h>
#include <slamot/filters/registerAll.h>

#include <map>

namespace slamot::test
{
/// A registered filter with these lines in its section; none of them may be left over.
inline std::unique_ptr<core::Filter> makeFilter(const std::string& name, const std::string& keys,
                                                const core::FilterContext& context = {})
{
  filters::registerAll();
  core::Config config = core::Config::parse("[" + name + "]\n" + keys, "test");
  auto filter = core::FilterRegistry::instance().make(name, config, context);
  config.requireAllRead();
  return filter;
}

/// The confirmed landmarks by their ids.
inline std::map<int, core::LandmarkEstimate> landmarks(const core::Estimate& e)
{
  std::map<int, core::LandmarkEstimate> out;
  if (e.landmarks)
    e.landmarks->visit([&](const core::LandmarkEstimate& l)
                       { EXPECT_TRUE(out.emplace(l.id, l).second) << "id " << l.id << " twice"; });
  EXPECT_EQ(out.size(), e.landmarks ? e.landmarks->size() : 0);
  return out;
}
}  // namespace slamot::test
