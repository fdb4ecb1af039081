#include <slamot/team/savedTeam.h>

#include <slamot/core/Error.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace slamot::team
{
using Json = nlohmann::ordered_json;

std::vector<std::string> robotsIn(const std::string& folder)
{
  const std::string path = (std::filesystem::path(folder) / "team.json").string();
  std::vector<std::string> out;
  std::ifstream file(path);
  if (!file) return out;
  try
  {
    const Json team = Json::parse(file);
    for (const Json& robot : team.at("robots")) out.push_back(robot.at("name").get<std::string>());
  }
  catch (const Json::exception&)
  {
    throw core::Error(core::ExitStatus::kNonsense, path, "is not what slamot team wrote",
                      "give a result folder");
  }
  return out;
}

std::string evaluationsJson(const std::vector<std::string>& names,
                            const std::vector<std::string>& evaluations)
{
  Json out = Json::object();
  for (std::size_t r = 0; r < names.size(); ++r) out[names[r]] = Json::parse(evaluations[r]);
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}
}  // namespace slamot::team
