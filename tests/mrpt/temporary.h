#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

namespace slamot::tests
{
/// A folder of the running test's own, removed at its end.
class TemporaryFolder
{
 public:
  TemporaryFolder()
  {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("slamot-") + test->test_suite_name() + "-" + test->name() + "-" +
                       std::to_string(::getpid());
    std::replace(name.begin(), name.end(), '/', '-');  // of parameterised tests
    // In memory where there is such a folder: some tests write thousands of small files.
    const std::filesystem::path inMemory = "/dev/shm";
    path_ = (::access(inMemory.c_str(), W_OK) == 0 ? inMemory
                                                   : std::filesystem::temp_directory_path()) /
            name;
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};
}  // namespace slamot::tests
