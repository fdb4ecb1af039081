#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "tinyPaper.h"

namespace slamot::reproduce::test
{
namespace
{
namespace fs = std::filesystem;

/// Starts `slamot reproduce` on the tiny paper, its output into files.
pid_t start(const TinyPaper& paper, const std::vector<std::string>& options)
{
  std::vector<std::string> words = {SLAMOT_PROGRAM, "reproduce", "tiny", "--configs",
                                    paper.file(".")};
  words.insert(words.end(), options.begin(), options.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string out = paper.file("stdout"), err = paper.file("stderr");
  const pid_t pid = ::fork();
  if (pid != 0) return pid;
  if (std::freopen(out.c_str(), "w", stdout) && std::freopen(err.c_str(), "w", stderr))
    ::execv(arguments[0], arguments.data());
  ::_exit(99);
}

int statusOf(pid_t pid)
{
  int status = 0;
  ::waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

int slamot(const TinyPaper& paper, const std::vector<std::string>& options)
{
  return statusOf(start(paper, options));
}

std::size_t recordsIn(const std::string& folder)
{
  std::size_t count = 0;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      count += entry.path().extension() == ".json" ? 1 : 0;
  return count;
}

std::string pageIn(const TinyPaper& paper, const std::string& out)
{
  const std::string page = paper.read(out + "/reproduction.html");
  return page.substr(0, page.find("<h2 id=\"cost\">"));
}

/// Long enough to be stopped in the middle.
std::vector<std::string> slowInto(const TinyPaper& paper, const std::string& out)
{
  return {"-q",
          "-o",
          paper.file(out),
          "--set",
          "section.main.set.method.joint.rbpf-slamot.particles=3000",
          "--set",
          "section.less.set.method.joint.rbpf-slamot.particles=3000"};
}

/// Starts a slow one and sends it a signal once it has made a record.
int signalled(const TinyPaper& paper, const std::string& out, int signal)
{
  const pid_t pid = start(paper, slowInto(paper, out));
  for (int i = 0; i < 3000 && recordsIn(paper.file(out)) == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ::kill(pid, signal);
  return statusOf(pid);
}
}  // namespace

TEST(ReproduceCommand, KilledOneGoesOnToTheSamePage)
{
  const TinyPaper paper;
  EXPECT_EQ(signalled(paper, "killed", SIGKILL), -SIGKILL);
  EXPECT_FALSE(fs::exists(paper.file("killed/reproduction.html")));
  const std::size_t before = recordsIn(paper.file("killed"));
  EXPECT_GT(before, 0u);
  EXPECT_LT(before, 16u);
  EXPECT_EQ(slamot(paper, slowInto(paper, "killed")), 0);
  EXPECT_EQ(slamot(paper, slowInto(paper, "whole")), 0);
  EXPECT_FALSE(pageIn(paper, "whole").empty());
  EXPECT_EQ(pageIn(paper, "killed"), pageIn(paper, "whole"));
}

TEST(ReproduceCommand, InterruptedOneLeavesRecordsAndNoPage)
{
  const TinyPaper paper;
  EXPECT_EQ(signalled(paper, "out", SIGINT), 130);
  EXPECT_FALSE(fs::exists(paper.file("out/reproduction.html")));
  EXPECT_GT(recordsIn(paper.file("out")), 0u);
  auto merge = slowInto(paper, "part");
  merge.insert(merge.end(), {"--merge", paper.file("out")});
  EXPECT_EQ(slamot(paper, merge), 0);
  EXPECT_NE(pageIn(paper, "part").find("INCOMPLETE"), std::string::npos);
}

TEST(ReproduceCommand, MergedShardsEqualOneRun)
{
  const TinyPaper paper;
  EXPECT_EQ(slamot(paper, {"-q", "-o", paper.file("one"), "--threads", "2"}), 0);
  EXPECT_EQ(slamot(paper, {"-q", "-o", paper.file("a"), "--shard", "1/2"}), 0);
  EXPECT_EQ(slamot(paper, {"-q", "-o", paper.file("b"), "--shard", "2/2"}), 0);
  EXPECT_EQ(recordsIn(paper.file("a")), 8u);
  EXPECT_FALSE(fs::exists(paper.file("a/reproduction.html")));
  EXPECT_EQ(slamot(paper, {"-q", "-o", paper.file("merged"), "--merge", paper.file("a"), "--merge",
                           paper.file("b")}),
            0);
  EXPECT_EQ(pageIn(paper, "merged"), pageIn(paper, "one"));
}

TEST(ReproduceCommand, ErrorsAreOneLineAndHaveTheirStatus)
{
  const TinyPaper paper;
  EXPECT_EQ(slamot(paper, {"-o", paper.file("x"), "--shard", "3/2"}), 1);
  EXPECT_EQ(paper.read("stderr"),
            "slamot: error: --shard 3/2: is not I/N with I from 1 to N; write --shard 1/8 to "
            "--shard 8/8\n");
  EXPECT_EQ(slamot(paper, {"--set", "claim.better.when.1=robot_mean_m(nobody) < 1"}), 1);
  EXPECT_EQ(
      paper.read("stderr").rfind("slamot: error: reproduce.tiny.ini [claim.better] when.1: ", 0),
      0u)
      << paper.read("stderr");
  EXPECT_EQ(slamot(paper, {"--merge", paper.file("nowhere")}), 4);
  EXPECT_FALSE(fs::exists(paper.file("x")));
}

TEST(ReproduceCommand, MakesThePageWithoutGnuplotAndSaysSo)
{
  const TinyPaper paper;
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const int status = slamot(paper, {"-q", "-o", paper.file("out")});
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(paper.read("stderr").rfind("slamot: reproduction.html: made without plots: gnuplot", 0),
            0u);
  const std::string page = pageIn(paper, "out");
  EXPECT_NE(page.find("This plot is missing: gnuplot"), std::string::npos);
  EXPECT_NE(page.find("This picture is missing: gnuplot"), std::string::npos);
  // With it, the pictures are made: nothing was kept in their place.
  EXPECT_EQ(slamot(paper, {"-q", "-o", paper.file("out")}), 0);
  EXPECT_EQ(pageIn(paper, "out").find(" is missing"), std::string::npos);
}
}  // namespace slamot::reproduce::test
