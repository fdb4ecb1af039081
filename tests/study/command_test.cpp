#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "tinyStudy.h"

namespace slamot::study::test
{
namespace
{
namespace fs = std::filesystem;

/// Starts `slamot study` on the tiny study, its output into files.
pid_t start(const TinyStudy& study, const std::vector<std::string>& options)
{
  std::vector<std::string> words = {SLAMOT_PROGRAM, "study", study.out("study.ini")};
  words.insert(words.end(), options.begin(), options.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string out = study.out("stdout"), err = study.out("stderr");
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

int slamot(const TinyStudy& study, const std::vector<std::string>& options)
{
  return statusOf(start(study, options));
}

std::size_t recordsIn(const std::string& folder)
{
  std::size_t count = 0;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      count += entry.path().extension() == ".json" ? 1 : 0;
  return count;
}

std::string pages(const TinyStudy& study, const std::string& out)
{
  std::string text;
  for (const char* name : {"table.md", "table.csv", "runs.csv", "errors.svg"})
    text += study.folder().read(out + "/" + name);
  return text;
}

/// Long enough to be stopped in the middle.
const std::vector<std::string> kSlow = {"-q", "--set", "method.joint.rbpf-slamot.particles=3000"};

std::vector<std::string> slowInto(const TinyStudy& study, const std::string& out)
{
  auto options = kSlow;
  options.insert(options.end(), {"-o", study.out(out)});
  return options;
}

/// Starts a slow study and sends it a signal once it has made a record.
int signalled(const TinyStudy& study, const std::string& out, int signal)
{
  const pid_t pid = start(study, slowInto(study, out));
  for (int i = 0; i < 3000 && recordsIn(study.out(out)) == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ::kill(pid, signal);
  return statusOf(pid);
}
}  // namespace

TEST(StudyCommand, KilledStudyGoesOnToTheSameTables)
{
  const TinyStudy study;
  EXPECT_EQ(signalled(study, "killed", SIGKILL), -SIGKILL);
  EXPECT_FALSE(fs::exists(study.out("killed/table.md")));
  const std::size_t before = recordsIn(study.out("killed"));
  EXPECT_LT(before, 16u);
  EXPECT_EQ(slamot(study, slowInto(study, "killed")), 0);
  EXPECT_EQ(slamot(study, slowInto(study, "whole")), 0);
  EXPECT_EQ(recordsIn(study.out("killed")), 16u);
  EXPECT_EQ(pages(study, "killed"), pages(study, "whole"));
}

TEST(StudyCommand, InterruptLeavesTablesMarkedIncomplete)
{
  const TinyStudy study;
  EXPECT_EQ(signalled(study, "out", SIGINT), 130);
  EXPECT_NE(study.folder().read("out/table.md").find("**Incomplete"), std::string::npos);
  EXPECT_EQ(slamot(study, slowInto(study, "out")), 0);
  EXPECT_EQ(study.folder().read("out/table.md").find("ncomplete"), std::string::npos);
}

TEST(StudyCommand, MergedShardsEqualOneRun)
{
  const TinyStudy study;
  EXPECT_EQ(slamot(study, {"-q", "-o", study.out("one"), "--threads", "2"}), 0);
  EXPECT_EQ(slamot(study, {"-q", "-o", study.out("a"), "--shard", "1/2"}), 0);
  EXPECT_EQ(recordsIn(study.out("a")), 8u);
  EXPECT_EQ(slamot(study, {"-q", "-o", study.out("b"), "--shard", "2/2"}), 0);
  EXPECT_EQ(slamot(study, {"-q", "-o", study.out("merged"), "--merge", study.out("a"), "--merge",
                           study.out("b")}),
            0);
  EXPECT_EQ(pages(study, "merged"), pages(study, "one"));
  EXPECT_EQ(recordsIn(study.out("merged")), 0u);
}

TEST(StudyCommand, ErrorsAreOneLineAndHaveTheirStatus)
{
  const TinyStudy study;
  EXPECT_EQ(slamot(study, {"-o", study.out("x"), "--shard", "0/2"}), 1);
  EXPECT_EQ(slamot(study, {"-o", study.out("x"), "--shard", "3/2"}), 1);
  EXPECT_EQ(study.folder().read("stderr"),
            "slamot: error: --shard 3/2: is not I/N with I from 1 to N; write --shard 1/8 to "
            "--shard 8/8\n");
  EXPECT_EQ(slamot(study, {"--merge", study.out("nowhere")}), 2);
  EXPECT_EQ(slamot(study, {"--set", "study.seeds=none"}), 1);
  EXPECT_FALSE(fs::exists(study.out("x")));
}
}  // namespace slamot::study::test
