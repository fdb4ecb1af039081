#include <slamot/core/Params.h>
#include <slamot/core/Start.h>

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace slamot::core
{
namespace
{
constexpr std::array<const char*, ObjectStart::kCount> kFields = {
    "x_m", "y_m", "theta_rad", "vx_mps", "vy_mps", "ax_mps2", "ay_mps2"};

std::optional<ObjectStart> readObject(Params& p, const std::string& object)
{
  ObjectStart out;
  bool any = false;
  for (std::size_t i = 0; i < kFields.size(); ++i)
  {
    out.value[i] = p.optionalNumber(object + "_" + kFields[i]);
    out.std[i] = p.optionalNumber(object + "_std_" + kFields[i], 0.0);
    any = any || out.value[i] || out.std[i];
  }
  if (!any) return std::nullopt;
  return out;
}

/// A line of the section; the number is the shortest that reads back, in every locale.
std::string line(const std::string& key, double value)
{
  char number[40];
  const auto end = std::to_chars(number, number + sizeof number, value).ptr;
  return key + " = " + std::string(number, end) + "\n";
}

void writeObject(std::string& text, const std::string& object, const ObjectStart& start)
{
  const auto write = [&](const std::string& key, const std::optional<double>& v)
  {
    if (v) text += line(object + "_" + key, *v);
  };
  for (std::size_t i = 0; i < kFields.size(); ++i)
  {
    write(kFields[i], start.value[i]);
    write(std::string("std_") + kFields[i], start.std[i]);
  }
}
}  // namespace

Gaussian<Pose2D> ObjectStart::pose() const
{
  Gaussian<Pose2D> out;
  out.mean = {get(kX), get(kY), math::wrapToPi(get(kTheta))};
  out.cov = Vector3(getStd(kX), getStd(kY), getStd(kTheta)).cwiseAbs2().asDiagonal();
  return out;
}

Starts Starts::from(Config& config)
{
  Starts out;
  if (!config.has("start")) return out;
  Params p(config, "start");
  out.time = p.optionalNumber("time_s");
  out.robot = readObject(p, "robot");
  // The ids are in the keys: target_<id>_<field>.
  for (const std::string& key : p.keys())
  {
    int id = 0, used = 0;
    if (std::sscanf(key.c_str(), "target_%d_%n", &id, &used) != 1 || used == 0) continue;
    if (id < 0 || out.targets.count(id)) continue;
    if (auto start = readObject(p, "target_" + std::to_string(id))) out.targets[id] = *start;
  }
  return out;
}

std::string Starts::toIni() const
{
  if (!time && !robot && targets.empty()) return {};
  std::string text = "[start]\n";
  if (time) text += line("time_s", *time);
  if (robot) writeObject(text, "robot", *robot);
  for (const auto& [id, start] : targets) writeObject(text, "target_" + std::to_string(id), start);
  return text;
}
}  // namespace slamot::core
