#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace slamot::test
{
/// Waits for something that must come, however slow the machine is; false if it does not.
inline bool comes(const std::function<bool()>& condition, double seconds = 100)
{
  using std::chrono::steady_clock;
  const auto until = steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition())
  {
    if (steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

/// A program of the test's that runs beside it, both its outputs in a file; killed at the end.
class Process
{
 public:
  Process(const std::vector<std::string>& command, std::string log) : log_(std::move(log))
  {
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ != 0) return;
    const int file = ::open(log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::dup2(file, 1);
    ::dup2(file, 2);
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
  }
  ~Process()
  {
    if (hasEnded()) return;
    signal(SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const { ::kill(pid_, number); }

  [[nodiscard]] bool hasEnded()
  {
    if (status_ < 0 && ::waitpid(pid_, &raw_, WNOHANG) == pid_)
      status_ = WIFEXITED(raw_) ? WEXITSTATUS(raw_) : 128 + WTERMSIG(raw_);
    return status_ >= 0;
  }
  /// Its exit status, once it has ended; -1 if it does not.
  [[nodiscard]] int status()
  {
    return comes([this] { return hasEnded(); }) ? status_ : -1;
  }

  /// What it has said so far.
  [[nodiscard]] std::string text() const
  {
    std::ostringstream out;
    out << std::ifstream(log_, std::ios::binary).rdbuf();
    return out.str();
  }
  /// Waits until it says this, after all of `after` (which then ends with it).
  [[nodiscard]] bool says(const std::string& what, std::size_t& after)
  {
    std::size_t at = std::string::npos;
    const auto look = [&]
    {
      const bool ended = hasEnded();
      at = text().find(what, after);
      return at != std::string::npos || ended;
    };
    if (!comes(look) || at == std::string::npos) return false;
    after = at + what.size();
    return true;
  }
  [[nodiscard]] bool says(const std::string& what)
  {
    std::size_t start = 0;
    return says(what, start);
  }

 private:
  std::string log_;
  pid_t pid_ = -1;
  int raw_ = 0, status_ = -1;
};
}  // namespace slamot::test
