#include <slamot/core/Error.h>

#include <cstdio>

#include "Command.h"
#include "completion.h"

namespace slamot::apps
{
namespace
{
/// One a line: a word, a tab and what it is; or :files or :folders, a tab and a pattern.
void print(const Completion& completion)
{
  for (const auto& [word, what] : completion.words)
    std::printf("%s\t%s\n", word.c_str(), what.substr(0, what.find('\n')).c_str());
  for (const std::string& pattern : completion.files) std::printf(":files\t%s\n", pattern.c_str());
  if (completion.folders) std::printf(":folders\t*\n");
}
}  // namespace

void addComplete(CLI::App& app, int& status)
{
  CLI::App* command =
      app.add_subcommand("__complete", "Tell a shell what may stand at the cursor")->group("");
  // Words come after a dash, so that none is taken for an option of this command.
  command->prefix_command();
  command->callback(
      [command, &app, &status]
      {
        std::vector<std::string> words = command->remaining();
        if (!words.empty()) words.erase(words.begin());
        print(complete(app, words));
        status = static_cast<int>(core::ExitStatus::kDone);
      });
}
}  // namespace slamot::apps
