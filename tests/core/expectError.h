#pragma once

#include <gtest/gtest.h>
#include <slamot/core/Error.h>

#include <string>
#include <vector>

namespace slamot::test
{
/// f() throws a core::Error of that status, and every one of the parts is in its text.
template <class F>
void expectError(F f, core::ExitStatus status, const std::vector<std::string>& parts)
{
  try
  {
    f();
    ADD_FAILURE() << "no error; expected one about '" << parts.front() << "'";
  }
  catch (const core::Error& e)
  {
    const std::string text = e.what();
    EXPECT_EQ(e.status(), status) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    for (const std::string& part : parts)
      EXPECT_NE(text.find(part), std::string::npos) << text << "\nlacks: " << part;
  }
}
template <class F>
void expectConfigError(F f, const std::vector<std::string>& parts)
{
  expectError(f, core::ExitStatus::kConfig, parts);
}
}  // namespace slamot::test
