#include <slamot/core/Error.h>
#include <slamot/perception/CornerDetector.h>
#include <slamot/perception/LandmarkDetector.h>
#include <slamot/perception/RoundDetector.h>

namespace slamot::perception
{
LandmarkDetectorRegistry::LandmarkDetectorRegistry()
{
  const auto round = [this](const char* name, const RoundOptions& defaults)
  {
    add(name, [defaults](core::Params& p, const LaserOptions& laser)
        { return std::make_unique<RoundDetector>(RoundOptions::from(p, defaults), laser); });
  };
  round("posts", RoundOptions::posts());
  round("trees", RoundOptions::trees());
  add("corners", [](core::Params& p, const LaserOptions& laser)
      { return std::make_unique<CornerDetector>(LineOptions::from(p), laser); });
}

LandmarkDetectorRegistry& LandmarkDetectorRegistry::instance()
{
  static LandmarkDetectorRegistry registry;
  return registry;
}

void LandmarkDetectorRegistry::add(const std::string& name, Factory factory)
{
  if (!factories_.emplace(name, std::move(factory)).second) twice_.insert(name);
}

std::vector<std::string> LandmarkDetectorRegistry::names() const
{
  std::vector<std::string> out;
  for (const auto& [name, _] : factories_) out.push_back(name);
  return out;
}

std::unique_ptr<LandmarkDetector> LandmarkDetectorRegistry::make(const std::string& name,
                                                                 core::Config& config,
                                                                 const LaserOptions& laser) const
{
  const auto it = factories_.find(name);
  if (it == factories_.end())
  {
    std::string known;
    for (const std::string& n : names()) known += (known.empty() ? "" : ", ") + n;
    throw core::Error(core::ExitStatus::kConfig, config.name(),
                      "landmark detector '" + name + "' is unknown",
                      "known: " + known + "; load others with --plugin");
  }
  if (twice_.count(name))
    throw core::Error(core::ExitStatus::kConfig, "landmark detector " + name, "is registered twice",
                      "give the plugin's detector another name");
  core::Params params(config, name);
  return it->second(params, laser);
}
}  // namespace slamot::perception
