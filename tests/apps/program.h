#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace slamot::test
{
/// What a run of the program gave.
struct Outcome
{
  int status = -1;
  std::string text;  ///< of both its outputs
};

/// Runs `slamot <arguments>` in a folder.
inline Outcome slamot(const std::string& arguments, const std::string& folder = ".")
{
  const std::string command = "cd '" + folder + "' && '" SLAMOT_PROGRAM "' " + arguments + " 2>&1";
  Outcome out;
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return out;
  std::array<char, 4096> part{};
  while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe))
    out.text.append(part.data(), n);
  const int status = ::pclose(pipe);
  out.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return out;
}
}  // namespace slamot::test
