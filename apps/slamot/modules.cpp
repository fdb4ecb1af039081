#include "modules.h"

#include <dlfcn.h>
#include <slamot/core/Error.h>

namespace slamot::apps
{
void* moduleFunction(const std::string& module, const std::string& function)
{
  // Found by the program's RUNPATH, wherever it is installed.
  void* const library = dlopen((module + ".so").c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const found = library != nullptr ? dlsym(library, function.c_str()) : nullptr;
  if (found != nullptr) return found;
  const char* why = dlerror();
  throw core::Error(core::ExitStatus::kInternal, module,
                    std::string("can't be loaded: ") + (why != nullptr ? why : "unknown cause"),
                    "install slamot anew");
}
}  // namespace slamot::apps
