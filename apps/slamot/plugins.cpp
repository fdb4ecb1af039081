#include <dlfcn.h>
#include <slamot/core/Error.h>

#include <filesystem>

#include "Command.h"

namespace slamot::apps
{
void CommonOptions::loadPlugins() const
{
  for (const std::string& plugin : plugins)
  {
    // dlopen looks for a bare name in the system's folders only.
    const std::string path = std::filesystem::absolute(plugin).string();
    if (dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL) != nullptr) continue;
    const char* why = dlerror();
    throw core::Error(core::ExitStatus::kConfig, "--plugin " + plugin,
                      std::string("can't be loaded: ") + (why != nullptr ? why : "unknown cause"),
                      "give the path of a shared library built for this slamot");
  }
}
}  // namespace slamot::apps
