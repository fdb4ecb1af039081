#pragma once

#include "../apps/Process.h"
#include "../results/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace slamot::test
{
struct Rgb
{
  int r, g, b;
};

/// What a screen shows.
struct Picture
{
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;

  /// Pixels, right of and below a corner, that differ from a colour by at most 24 over all three
  /// channels.
  [[nodiscard]] long count(const Rgb& c, int left = 0, int top = 0) const
  {
    long n = 0;
    for (int y = top; y < height; ++y)
      for (int x = left; x < width; ++x)
      {
        const unsigned char* p = &rgb[static_cast<std::size_t>(3 * (y * width + x))];
        n += std::abs(p[0] - c.r) + std::abs(p[1] - c.g) + std::abs(p[2] - c.b) <= 24;
      }
    return n;
  }
};

/// A screen of its own, which nobody sees, with a window manager; ends with the test.
class Screen
{
 public:
  /// What is missing for it on this machine; empty: nothing.
  static std::string missing()
  {
    for (const char* program : {"Xvfb", "openbox", "xdotool", "import"})
      if (std::system((std::string("command -v ") + program + " >/dev/null").c_str()) != 0)
        return std::string(program) + " is not installed";
    return {};
  }

  Screen()
      : server_(
            {"sh", "-c", "exec Xvfb -displayfd 1 -screen 0 1280x900x24 +extension GLX 2>/dev/null"},
            folder_.file("server"))
  {
    const auto answered = [this] { return server_.text().find('\n') != std::string::npos; };
    if (!comes(answered)) throw std::runtime_error("Xvfb does not start");
    const std::string number = server_.text();
    display_ = ":" + number.substr(0, number.find('\n'));
    manager_ = start("exec openbox", "manager");
  }

  /// A program on the screen, run by sh.
  [[nodiscard]] std::unique_ptr<Process> start(const std::string& command, const std::string& log)
  {
    const std::string all = "unset WAYLAND_DISPLAY; export DISPLAY=" + display_ +
                            " HOME=" + folder_.file("") + " LIBGL_ALWAYS_SOFTWARE=1; " + command;
    return std::make_unique<Process>(std::vector<std::string>{"sh", "-c", all}, folder_.file(log));
  }

  /// Lets xdotool do something.  \return whether it could.
  bool act(const std::string& what)
  {
    return start("exec timeout 20 xdotool " + what, "xdotool")->status() == 0;
  }

  [[nodiscard]] Picture picture()
  {
    const std::string file = folder_.file("screen.ppm");
    if (start("exec import -window root -depth 8 ppm:" + file, "import")->status() != 0) return {};
    std::ifstream in(file, std::ios::binary);
    std::string magic;
    int most = 0;
    Picture p;
    in >> magic >> p.width >> p.height >> most;
    in.get();
    p.rgb.resize(static_cast<std::size_t>(3 * p.width * p.height));
    in.read(reinterpret_cast<char*>(p.rgb.data()), static_cast<std::streamsize>(p.rgb.size()));
    return p;
  }

  /// Waits for a colour on at least so many pixels.
  [[nodiscard]] bool shows(const Rgb& colour, long pixels, double seconds = 30)
  {
    return comes([&] { return picture().count(colour) >= pixels; }, seconds);
  }

  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }

 private:
  TemporaryFolder folder_;
  Process server_;
  std::string display_;
  std::unique_ptr<Process> manager_;
};
}  // namespace slamot::test
