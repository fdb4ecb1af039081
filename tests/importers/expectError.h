#pragma once

#include <gtest/gtest.h>
#include <slamot/core/Error.h>

#include <string>

namespace slamot::test
{
/// That the action fails with this status and a message of one line that holds all of `parts`.
template <class Action>
void expectError(core::ExitStatus status, const std::vector<std::string>& parts, Action action)
{
  try
  {
    action();
    ADD_FAILURE() << "no error; expected one with '" << (parts.empty() ? "" : parts[0]) << "'";
  }
  catch (const core::Error& e)
  {
    const std::string what = e.what();
    EXPECT_EQ(static_cast<int>(e.status()), static_cast<int>(status)) << what;
    for (const std::string& part : parts)
      EXPECT_NE(what.find(part), std::string::npos) << "'" << part << "' is not in: " << what;
    for (const char c : what) EXPECT_TRUE(c >= ' ' && c <= '~') << what;
  }
}
}  // namespace slamot::test
