#include <slamot/results/TextFile.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

#include "TemporaryFolder.h"

namespace slamot::results
{
// As two processes that do the same work by mistake.
TEST(WriteWhole, WritersOfOneFileDoNotDisturbEachOther)
{
  const slamot::test::TemporaryFolder folder;
  const std::string path = folder.file("record.json");
  const auto write = [&](char letter)
  {
    for (int i = 0; i < 300; ++i) writeWhole(path, std::string(20000, letter));
  };
  std::thread other(write, 'b');
  write('a');
  other.join();
  const std::string text = folder.read("record.json");
  EXPECT_EQ(text.size(), 20000u);
  EXPECT_EQ(text.find_first_not_of(text[0]), std::string::npos);
  const auto files = std::filesystem::directory_iterator(folder.file("."));
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}
}  // namespace slamot::results
