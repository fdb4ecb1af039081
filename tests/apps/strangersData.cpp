#include "strangersData.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <map>
#include <random>
#include <stdexcept>

namespace slamot::test
{
namespace
{
constexpr double kPi = 3.14159265358979323846;
constexpr double kStep = 0.1;  // [s]
constexpr int kStepsPerScan = 5;
constexpr double kSpeed = 1, kRadius = 5;  // of the robot's rounds [m/s, m]
constexpr double kStdSpeed = 0.2, kStdTurn = 0.15;
constexpr double kStdRange = 0.1, kStdBearing = 0.01, kRange = 8, kDetection = 0.9;

struct Place
{
  double x, y;
};

double wrapped(double a)
{
  return std::atan2(std::sin(a), std::cos(a));
}

/// The files of a folder, by name, opened at their first line.
class Files
{
 public:
  explicit Files(std::string folder) : folder_(std::move(folder)) {}
  ~Files()
  {
    for (auto& [name, file] : files_) std::fclose(file);
  }
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;

  __attribute__((format(printf, 3, 4))) void line(const std::string& name, const char* format, ...)
  {
    std::FILE*& file = files_[name];
    if (file == nullptr) file = std::fopen((folder_ + "/" + name).c_str(), "w");
    if (file == nullptr) throw std::runtime_error("can't write " + name);
    va_list values;
    va_start(values, format);
    std::vfprintf(file, format, values);
    va_end(values);
    std::fputc('\n', file);
  }

 private:
  std::string folder_;
  std::map<std::string, std::FILE*> files_;
};

/// The robot drives round and round among posts, targets wander inside its rounds.
class Drive
{
 public:
  Drive(const std::string& folder, const StrangersDrive& options)
      : o_(options), files_(folder), random_(options.seed)
  {
    for (int i = 0; i < 24; ++i)
    {
      const double angle = 2 * kPi * i / 12 + uniform(-0.15, 0.15);
      const double radius = (i < 12 ? 7.5 : 2.5) + uniform(-0.7, 0.7);
      posts_.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    facts_.posts = static_cast<int>(posts_.size());
    if (!o_.robotStart) origin_ = {x_, y_};
  }

  StrangersFacts run()
  {
    writeHeads();
    writeTruth();
    scan();
    for (int i = 1; i <= static_cast<int>(std::lround(o_.duration / kStep)); ++i)
    {
      const bool pause = std::abs(i * kStep - o_.pauseAt) < 0.5 * kStep;
      move(i, pause);
      writeTruth();
      if (i % kStepsPerScan == 0) scan();
    }
    return facts_;
  }

 private:
  double gauss(double std) { return std::normal_distribution<double>(0, std)(random_); }
  double uniform(double a, double b)
  {
    return std::uniform_real_distribution<double>(a, b)(random_);
  }
  [[nodiscard]] double clock() const { return o_.startTime + time_; }

  // Smooth, within 4 m of the centre, at up to 1 m/s.
  [[nodiscard]] Place target(std::size_t k, double t) const
  {
    const double phase = 2.1 * static_cast<double>(k);
    return {3.5 * std::cos(0.23 * t + phase), 2.5 * std::sin(0.31 * t + 1.3 * phase)};
  }

  void writeHeads()
  {
    files_.line("odometry.csv", "%s",
                o_.increments ? "t,dx,dy,dphi,std_x,std_y,std_phi" : "t,v,omega,std_v,std_omega");
    files_.line("landmark_sightings.csv", "t,range,bearing,std_range,std_bearing,id");
    files_.line("blobs.csv", "t,label,range,bearing,std_range,std_bearing,id");
    files_.line("fov.csv", "range_min,range_max,bearing_min,bearing_max");
    files_.line("fov.csv", "0,%g,%g,%g", o_.declaredRange, -o_.halfFov, o_.halfFov);
    files_.line("truth_robot.csv", "t,x,y,theta");
    files_.line("truth_landmarks.csv", "id,x,y");
    for (std::size_t i = 0; i < posts_.size(); ++i)
      files_.line("truth_landmarks.csv", "%zu,%.6f,%.6f", 100 + i, posts_[i].x - origin_.x,
                  posts_[i].y - origin_.y);
    for (const auto& t : o_.targets) files_.line(truthOf(t), "t,x,y,theta");
    if (o_.robotStart || o_.targetStarts) writeStarts();
  }

  void writeStarts()
  {
    const char* file = "start.csv";
    files_.line(file,
                "object,x,y,theta,vx,vy,ax,ay,std_x,std_y,std_theta,std_vx,std_vy,std_ax,std_ay");
    files_.line(file, "robot,%.6f,%.6f,%.6f,,,,,0,0,0,,,,", x_ - origin_.x, y_ - origin_.y, theta_);
    for (std::size_t k = 0; o_.targetStarts && k < o_.targets.size(); ++k)
    {
      const Place p = target(k, 0);
      files_.line(file, "target_%d,%.6f,%.6f,,,,,,0.1,0.1,,,,,", o_.targets[k].id,
                  p.x - origin_.x + gauss(0.1), p.y - origin_.y + gauss(0.1));
    }
  }

  static std::string truthOf(const StrangersTarget& t)
  {
    return "truth_target_" + std::to_string(t.id) + ".csv";
  }

  void writeTruth()
  {
    files_.line("truth_robot.csv", "%.3f,%.6f,%.6f,%.6f", clock(), x_ - origin_.x, y_ - origin_.y,
                theta_);
    for (std::size_t k = 0; k < o_.targets.size(); ++k)
    {
      const Place p = target(k, time_), q = target(k, time_ + 1e-3);
      files_.line(truthOf(o_.targets[k]), "%.3f,%.6f,%.6f,%.6f", clock(), p.x - origin_.x,
                  p.y - origin_.y, std::atan2(q.y - p.y, q.x - p.x));
    }
  }

  // The command is known, what comes of it is not.
  void move(int i, bool pause)
  {
    const double dt = pause ? 60 : kStep;
    const double v = pause ? 0 : kSpeed,
                 w = pause ? 0 : kSpeed / kRadius + 0.08 * std::sin(0.05 * i);
    const double stdV = pause ? 1e-4 : kStdSpeed, stdW = pause ? 1e-4 : kStdTurn;
    const double trueV = v + gauss(stdV), trueW = w + gauss(stdW);
    time_ += dt;
    theta_ = wrapped(theta_ + trueW * dt);
    x_ += trueV * dt * std::cos(theta_);
    y_ += trueV * dt * std::sin(theta_);
    ++facts_.steps;
    if (o_.increments)
      files_.line("odometry.csv", "%.3f,%.9f,%.9f,%.9f,%.6g,%.6g,%.6g", clock(),
                  v * dt * std::cos(w * dt), v * dt * std::sin(w * dt), w * dt, stdV * dt + 1e-6,
                  v * stdW * dt * dt + 1e-6, stdW * dt + 1e-6);
    else
      files_.line("odometry.csv", "%.3f,%.9f,%.9f,%g,%g", clock(), v, w, stdV, stdW);
  }

  void scan()
  {
    ++facts_.scans;
    seePosts();
    seeTargets();
  }

  /// Range and bearing of what is seen of a place.
  std::optional<std::pair<double, double>> see(const Place& p)
  {
    const double range = std::hypot(p.x - x_, p.y - y_);
    const double bearing = wrapped(std::atan2(p.y - y_, p.x - x_) - theta_);
    const bool blind = time_ > o_.blindFrom && time_ < o_.blindTo;
    const bool seen = uniform(0, 1) < kDetection;
    if (blind || !seen || range > kRange || std::abs(bearing) > o_.halfFov) return std::nullopt;
    return std::make_pair(range + gauss(kStdRange), wrapped(bearing + gauss(kStdBearing)));
  }

  void count(double range, double bearing)
  {
    const bool out = range <= 0 || range > o_.declaredRange || std::abs(bearing) > o_.halfFov;
    facts_.outOfDeclaredView += out ? 1 : 0;
  }

  void seePosts()
  {
    const int before = facts_.sightings;
    for (std::size_t i = 0; i < posts_.size(); ++i)
      if (const auto z = see(posts_[i]))
      {
        files_.line("landmark_sightings.csv", "%.3f,%.6f,%.6f,%g,%g,%d", clock(), z->first,
                    z->second, kStdRange, kStdBearing,
                    o_.landmarkIds ? 100 + static_cast<int>(i) : -1);
        ++facts_.sightings;
        count(z->first, z->second);
      }
    if (facts_.sightings == before) files_.line("landmark_sightings.csv", "%.3f,,,,,", clock());
  }

  void seeTargets()
  {
    const int before = facts_.blobs;
    for (std::size_t k = 0; k < o_.targets.size(); ++k)
    {
      const auto z = see(target(k, time_));
      if (!z) continue;
      const int id = o_.targetIds ? o_.targets[k].id : -1;
      const char* label = o_.targets[k].label.c_str();
      const bool ranged = uniform(0, 1) >= o_.bearingsOnly;
      if (ranged)
        files_.line("blobs.csv", "%.3f,%s,%.6f,%.6f,%g,%g,%d", clock(), label, z->first, z->second,
                    kStdRange, kStdBearing, id);
      else
        files_.line("blobs.csv", "%.3f,%s,,%.6f,,%g,%d", clock(), label, z->second, kStdBearing,
                    id);
      ++facts_.blobs;
      count(ranged ? z->first : 1, z->second);
    }
    if (facts_.blobs == before) files_.line("blobs.csv", "%.3f,,,,,,", clock());
  }

  const StrangersDrive& o_;
  Files files_;
  std::mt19937 random_;
  std::vector<Place> posts_;
  Place origin_{0, 0};
  double x_ = 0, y_ = -kRadius, theta_ = 0, time_ = 0;
  StrangersFacts facts_;
};
}  // namespace

StrangersFacts writeStrangersData(const std::string& folder, const StrangersDrive& drive)
{
  return Drive(folder, drive).run();
}
}  // namespace slamot::test
