#include <mrpt/gui/CDisplayWindow3D.h>
#include <slamot/core/Error.h>
#include <slamot/mrpt/LiveScene.h>
#include <slamot/mrpt/buildScene.h>
#include <slamot/window/LiveView.h>

#include <X11/Xlib.h>
#include <stdlib.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>

#include SLAMOT_SCENE_HEADER

namespace slamot::window
{
namespace
{
constexpr int kWidth = 1024, kHeight = 768;  // [px]
constexpr double kBetweenPictures = 0.1;     // [s]: drawing must not slow the filter down

/// MRPT would wait 5 s for a display that does not answer.
void requireDisplay()
{
  const auto set = [](const char* name)
  {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  if (set("WAYLAND_DISPLAY")) return;
  Display* const display = set("DISPLAY") ? XOpenDisplay(nullptr) : nullptr;
  if (display == nullptr)
    throw core::Error(core::ExitStatus::kConfig, "command line --view",
                      set("DISPLAY") ? "the display of DISPLAY does not answer"
                                     : "there is no display: DISPLAY is not set",
                      "leave it out; slamot render draws without one");
  XCloseDisplay(display);
}

::mrpt::gui::CDisplayWindow3D* openWindow(const std::string& title)
{
  requireDisplay();
  setenv("MRPT_WXSUBSYS_TIMEOUT_MS", "60000", 0);  // a loaded machine needs more than MRPT's 5 s
  return new ::mrpt::gui::CDisplayWindow3D(title, kWidth, kHeight);
}

/// Leaves the window to MRPT's thread, and has the program end without the other handlers of its
/// exit.  That thread still works on a window after isOpen() is false; and at the exit MRPT writes
/// to its queue of requests after it has freed it, if that thread has not ended by then (2.5.8:
/// valgrind shows it; a run has ended as "corrupted double-linked list").
struct LeaveToMrpt
{
  void operator()(const ::mrpt::gui::CDisplayWindow3D*) const
  {
    const auto end = [](int status, void*)
    {
      std::fflush(nullptr);
      std::_Exit(status);
    };
    on_exit(end, nullptr);  // last registered, first called
  }
};

class Window3D : public LiveView
{
 public:
  Window3D(const std::string& title, const core::Filter& filter)
      : filter_(filter), scene_(title), window_(openWindow("slamot: " + title))
  {
    if (!window_->isOpen())
      throw core::Error(core::ExitStatus::kConfig, "command line --view",
                        "the display opens no window",
                        "leave it out; slamot render draws without a display");
    window_->setFOV(30);
  }

  void begin(const core::Estimate& start) override
  {
    scene_.begin(start);
    draw(start);
  }
  void accept(const core::Step& step, const core::Update& update) override
  {
    scene_.add(step, update);
    const std::chrono::duration<double> since = Clock::now() - drawn_;
    if (since.count() >= kBetweenPictures) draw(update.estimate);
  }
  void finish(bool) override { draw(filter_.estimate()); }
  [[nodiscard]] bool isOpen() override { return window_->isOpen(); }

 private:
  using Clock = std::chrono::steady_clock;

  void draw(const core::Estimate& now)
  {
    drawn_ = Clock::now();
    if (!window_->isOpen()) return;
    mrpt::RenderOptions look;
    look.width = kWidth, look.height = kHeight;
    const auto& scene = window_->get3DSceneAndLock();
    const auto camera = mrpt::buildScene(*scene, scene_.at(now, filter_.particles()), look);
    window_->unlockAccess3DScene();
    aim(camera);
    window_->repaint();
  }

  /// Where the window's camera is and looks: place [m], azimuth, elevation [deg], distance [m].
  using Aim = std::array<float, 6>;

  [[nodiscard]] Aim aimNow() const
  {
    Aim a{};
    window_->getCameraPointingToPoint(a[0], a[1], a[2]);
    a[3] = window_->getCameraAzimuthDeg(), a[4] = window_->getCameraElevationDeg();
    a[5] = window_->getCameraZoom();
    return a;
  }

  /// Where all is in view, until the user has looked elsewhere: from then on where the user looks.
  void aim(const slamot_viz::CCamera& camera)
  {
    if (aimed_ && aimNow() != *aimed_) isUsers_ = true;
    if (isUsers_) return;
    window_->setCameraPointingToPoint(camera.getPointingAtX(), camera.getPointingAtY(), 0);
    window_->setCameraAzimuthDeg(camera.getAzimuthDegrees());
    window_->setCameraElevationDeg(camera.getElevationDegrees());
    window_->setCameraZoom(camera.getZoomDistance());
    aimed_ = aimNow();
  }

  const core::Filter& filter_;
  mrpt::LiveScene scene_;
  std::unique_ptr<::mrpt::gui::CDisplayWindow3D, LeaveToMrpt> window_;
  Clock::time_point drawn_;
  std::optional<Aim> aimed_;  // as it was left
  bool isUsers_ = false;
};
}  // namespace
}  // namespace slamot::window

#ifdef __clang__
#pragma clang diagnostic ignored "-Wreturn-type-c-linkage"
#endif
extern "C" std::unique_ptr<slamot::window::LiveView> slamotOpenLiveView(
    const std::string& title, const slamot::core::Filter& filter)
{
  return std::make_unique<slamot::window::Window3D>(title, filter);
}
