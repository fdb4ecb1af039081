#include "../results/TemporaryFolder.h"
#include "program.h"

#include <filesystem>
#include <regex>

namespace slamot
{
namespace
{
/// All pages, as they are written for a system's slamot.
class Manual : public test::TemporaryFolder
{
 public:
  Manual() { EXPECT_EQ(test::slamot("__man '" + file("") + "' /usr/share/slamot").text, ""); }
  [[nodiscard]] std::vector<std::string> pages() const
  {
    std::vector<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(file("")))
      out.push_back(entry.path().filename().string());
    return out;
  }
  /// The page as it is read, without a line break; what man complains of comes first.
  [[nodiscard]] std::string shown(const std::string& page) const
  {
    FILE* pipe = ::popen(("LC_ALL=C.UTF-8 MANWIDTH=1000 MANROFFSEQ= man --warnings -P cat -l '" +
                          file(page) + "' 2>&1")
                             .c_str(),
                         "r");
    std::string text;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
    ::pclose(pipe);
    return text;
  }
};

bool manIsThere()
{
  return std::system("command -v man >/dev/null") == 0;
}
}  // namespace

TEST(ManPages, OneForTheProgramAndOneForEachCommand)
{
  const Manual manual;
  const std::string help = test::slamot("--help").text;
  const std::regex command("\n  ([a-z][a-z-]+) {2,}[A-Z]");
  std::size_t commands = 0;
  for (std::sregex_iterator i(help.begin(), help.end(), command), end; i != end; ++i, ++commands)
    EXPECT_NE(manual.read("slamot-" + i->str(1) + ".1"), "") << i->str(1);
  EXPECT_GE(commands, 11u);
  EXPECT_EQ(manual.pages().size(), commands + 1);
}

TEST(ManPages, HaveEveryOptionOfTheHelp)
{
  const Manual manual;
  for (const std::string& page : manual.pages())
  {
    std::string text = manual.read(page);
    text = std::regex_replace(text, std::regex(R"(\\-)"), "-");
    const bool ofProgram = page == "slamot.1";  // whose help has examples of others' options
    const std::string name = ofProgram ? "" : page.substr(7, page.size() - 9);
    const std::string help = ofProgram ? "--help --version" : test::slamot(name + " --help").text;
    const std::regex option("(?:^|[ ,])(--[a-z][a-z-]+)");
    for (std::sregex_iterator i(help.begin(), help.end(), option), end; i != end; ++i)
      EXPECT_NE(text.find(i->str(1)), std::string::npos) << page << " " << i->str(1);
  }
}

TEST(ManPages, TellEachOptionOnce)
{
  const Manual manual;
  const std::string page = manual.read("slamot-import.1");
  const auto first = page.find("\\-\\-help");
  EXPECT_NE(first, std::string::npos);
  EXPECT_EQ(page.find("\\-\\-help", first + 1), std::string::npos);
}

TEST(ManPages, AreReadWithoutAWarning)
{
  if (!manIsThere()) GTEST_SKIP() << "no man";
  const Manual manual;
  for (const std::string& page : manual.pages())
  {
    const std::string text = manual.shown(page);
    EXPECT_EQ(text.find(": warning"), std::string::npos) << text;
    for (const char* section : {"NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXIT STATUS",
                                "FILES", "EXAMPLES", "SEE ALSO"})
      EXPECT_NE(text.find(std::string("\n") + section + "\n"), std::string::npos)
          << page << " has no " << section;
  }
}

TEST(ManPages, ExamplesNameFilesWhereTheyAreInstalled)
{
  const Manual manual;
  const std::string run = manual.read("slamot-run.1");
  EXPECT_NE(run.find("slamot run /usr/share/slamot/config\\-ini/rbpf\\-slamot.experiment1.ini "
                     "/usr/share/slamot/datasets/experiment1.rawlog"),
            std::string::npos)
      << run;
}

TEST(ManPages, FolderThatIsNotThereIsAnError)
{
  const test::Outcome o = test::slamot("__man /nowhere/at/all /usr/share/slamot");
  EXPECT_EQ(o.status, 1);
  EXPECT_EQ(o.text,
            "slamot: error: /nowhere/at/all: can't be written; give a folder that is there\n");
}
}  // namespace slamot
