#include <slamot/importers/TextTable.h>
#include <zlib.h>

#include "../results/TemporaryFolder.h"
#include "expectError.h"

namespace slamot::importers
{
namespace
{
using core::ExitStatus;
using test::expectError;
using test::TemporaryFolder;

std::vector<std::string> linesOf(const std::string& path)
{
  LineReader reader(path);
  std::vector<std::string> out;
  while (const auto line = reader.next()) out.emplace_back(*line);
  return out;
}

std::string writeGz(const TemporaryFolder& folder, const std::string& name, const std::string& text)
{
  gzFile file = gzopen(folder.file(name).c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  return folder.file(name);
}

TEST(LineReader, TakesEitherLineEndAndNoneAtTheEnd)
{
  const TemporaryFolder folder;
  using Lines = std::vector<std::string>;
  EXPECT_EQ(linesOf(folder.write("a", "x\ny\n")), (Lines{"x", "y"}));
  EXPECT_EQ(linesOf(folder.write("b", "x\r\ny")), (Lines{"x", "y"}));
  EXPECT_EQ(linesOf(folder.write("c", "\xEF\xBB\xBFx\n\n")), (Lines{"x", ""}));
  EXPECT_EQ(linesOf(folder.write("d", "")), Lines{});
}

TEST(LineReader, ReadsLongTextAsItIs)
{
  const TemporaryFolder folder;
  std::string text;
  std::vector<std::string> lines;
  for (int i = 0; i < 5000; ++i)
  {
    lines.push_back(std::string(static_cast<std::size_t>(i * 37 % 301), 'a') + std::to_string(i));
    text += lines.back() + "\n";
  }
  EXPECT_EQ(linesOf(folder.write("plain", text)), lines);
  EXPECT_EQ(linesOf(writeGz(folder, "packed.gz", text)), lines);
}

TEST(LineReader, SaysWhenACompressedFileIsCutShort)
{
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 20000; ++i) text += std::to_string(i * 7919 % 10007) + "\n";
  writeGz(folder, "whole.gz", text);
  const std::string whole = folder.read("whole.gz");
  const std::string cut = folder.write("cut.gz", whole.substr(0, whole.size() / 2));
  expectError(ExitStatus::kTruncated, {"cut.gz", "ends early"}, [&] { linesOf(cut); });
}

TEST(LineReader, RefusesEndlessLinesAndFolders)
{
  const TemporaryFolder folder;
  const std::string path = folder.write("long", "x\n" + std::string(3 << 20, 'a'));
  expectError(ExitStatus::kLimit, {"long line 2", "1 MiB"}, [&] { linesOf(path); });
  expectError(ExitStatus::kUnreadable, {"is a folder"}, [&] { linesOf(folder.file("")); });
  expectError(ExitStatus::kUnreadable, {"nosuch", "can't be read"},
              [&] { linesOf(folder.file("nosuch")); });
}

TEST(TextTable, ReadsNumbersAsWritten)
{
  const TemporaryFolder folder;
  auto table = TextTable::csv(folder.write("a.csv", "a, b ,c\n 1.5,+2e-3 ,\t-7.0\n"));
  EXPECT_EQ(table.header(), (TextTable::Names{"a", "b", "c"}));
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.number(0), 1.5);
  EXPECT_EQ(table.number(1), 2e-3);
  EXPECT_EQ(table.integer(2, -10), -7);
  EXPECT_FALSE(table.next());
}

TEST(TextTable, ReadsBlankSeparatedColumnsAmongComments)
{
  const TemporaryFolder folder;
  auto table =
      TextTable::blanks(folder.write("a.dat", "# t x\n1 \t2\n# end\n 3   4 \n\n"), {"t", "x"});
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.number(1), 2);
  ASSERT_TRUE(table.next());
  EXPECT_EQ(table.number(0), 3);
  EXPECT_FALSE(table.next());
}
}  // namespace
}  // namespace slamot::importers
