// Loaded before a program, so that the order of events in its windows is known: its fourth picture
// waits while the file HELD_BY is there; without HELD_BY a closed window takes long to go, and the
// program says when it has MRPT end its thread of windows, which is not safe (see LiveView.cpp).
#include <dlfcn.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#pragma GCC diagnostic ignored "-Wmissing-declarations"
namespace
{
/// What MRPT has by this name.  The program's module loads it, for itself alone.
void* mrptOwn(const char* name)
{
  return dlsym(dlopen(SLAMOT_WINDOW_MODULE, RTLD_LAZY | RTLD_NOLOAD), name);
}

void wait(int milliseconds)
{
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}
}  // namespace

extern "C"
{
  // mrpt::gui::WxSubsystem::CWXMainFrame::notifyWindowDestruction()
  int _ZN4mrpt3gui11WxSubsystem12CWXMainFrame23notifyWindowDestructionEv()
  {
    static const auto real = reinterpret_cast<int (*)()>(mrptOwn(__func__));
    if (std::getenv("HELD_BY") == nullptr)
    {
      std::fputs("a window goes slowly\n", stderr);
      wait(5000);
    }
    return real();
  }

  // mrpt::gui::CDisplayWindow3D::forceRepaint()
  void _ZN4mrpt3gui16CDisplayWindow3D12forceRepaintEv(void* window)
  {
    static const auto real = reinterpret_cast<void (*)(void*)>(mrptOwn(__func__));
    real(window);
    static int pictures = 0;
    const char* file = std::getenv("HELD_BY");
    if (++pictures != 4 || file == nullptr) return;
    std::fputs("held\n", stderr);
    while (::access(file, F_OK) == 0) wait(10);
  }

  // mrpt::gui::WxSubsystem::waitWxShutdownsIfNoWindows()
  void _ZN4mrpt3gui11WxSubsystem26waitWxShutdownsIfNoWindowsEv()
  {
    std::fputs("MRPT ends its thread of windows\n", stderr);
  }
}
