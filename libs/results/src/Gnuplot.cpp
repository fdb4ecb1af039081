#include <slamot/results/Gnuplot.h>

#include <slamot/core/Error.h>
#include <slamot/results/TextFile.h>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

namespace slamot::results
{
namespace
{
using core::Error;
using core::ExitStatus;

struct CloseFile
{
  void operator()(std::FILE* f) const { std::fclose(f); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

[[noreturn]] void fail(const std::string& what)
{
  throw Error(ExitStatus::kInternal, "gnuplot", what, "install gnuplot-nox");
}

File temporary()
{
  File f(std::tmpfile());
  if (!f) fail(std::string("no temporary file: ") + std::strerror(errno));
  ::fcntl(::fileno(f.get()), F_SETFD, FD_CLOEXEC);
  return f;
}

std::string contents(std::FILE* f)
{
  std::rewind(f);
  std::string out;
  char block[65536];
  for (std::size_t n; (n = std::fread(block, 1, sizeof block, f)) > 0;) out.append(block, n);
  return out;
}

/// Runs gnuplot with these files as its standard streams; its exit status.
/// In a process group of its own: Ctrl-C ends the run, which then still draws its report.
int runGnuplot(std::FILE* in, std::FILE* out, std::FILE* err)
{
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  int to = 0;
  for (std::FILE* f : {in, out, err}) ::posix_spawn_file_actions_adddup2(&files, ::fileno(f), to++);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  // By name: what it reads as its standard input it reads character by character, a call each.
  char name[] = "gnuplot", defaults[] = "-d", script[] = "/dev/stdin";
  char* const arguments[] = {name, defaults, script, nullptr};
  pid_t pid = 0;
  const int error = ::posix_spawnp(&pid, name, &files, &attributes, arguments, ::environ);
  ::posix_spawn_file_actions_destroy(&files);
  ::posix_spawnattr_destroy(&attributes);
  if (error != 0) fail(std::string("can't be started: ") + std::strerror(error));
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0)
    if (errno != EINTR) fail(std::string("lost: ") + std::strerror(errno));
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string lastLine(std::string text)
{
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  const auto start = text.rfind('\n');
  return start == std::string::npos ? text : text.substr(start + 1);
}
}  // namespace

std::string drawFigure(const Figure& figure, PictureFormat format)
{
  const File in = temporary(), out = temporary(), err = temporary();
  const std::string script = gnuplotScript(figure, format);
  if (std::fwrite(script.data(), 1, script.size(), in.get()) != script.size() ||
      std::fflush(in.get()) != 0)
    fail(std::string("no room for its commands: ") + std::strerror(errno));
  std::rewind(in.get());
  const int status = runGnuplot(in.get(), out.get(), err.get());
  std::string picture = contents(out.get());
  if (status == 127) fail("is not installed");
  if (status != 0 || picture.empty())
    fail("exit status " + std::to_string(status) + ": " + lastLine(contents(err.get())));
  return picture;
}

void saveFigure(const std::string& path, const Figure& figure)
{
  const bool png = std::filesystem::path(path).extension() == ".png";
  writeWhole(path, drawFigure(figure, png ? PictureFormat::kPng : PictureFormat::kSvg));
}
}  // namespace slamot::results
