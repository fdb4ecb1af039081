#include <slamot/team/savedTeam.h>

#include <slamot/core/Error.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace slamot::team
{
using Json = nlohmann::ordered_json;

namespace
{
std::string pathIn(const std::string& folder)
{
  return (std::filesystem::path(folder) / "team.json").string();
}

/// What `read` makes of a team.json.
template <class Read>
auto readTeam(std::istream& file, const std::string& path, Read&& read)
{
  try
  {
    return read(Json::parse(file));
  }
  catch (const Json::exception&)
  {
    throw core::Error(core::ExitStatus::kNonsense, path, "is not what slamot team wrote",
                      "give a result folder");
  }
}
}  // namespace

std::vector<std::string> robotsIn(const std::string& folder)
{
  std::ifstream file(pathIn(folder));
  if (!file) return {};
  return readTeam(file, pathIn(folder),
                  [](const Json& team)
                  {
                    std::vector<std::string> out;
                    for (const Json& robot : team.at("robots"))
                      out.push_back(robot.at("name").get<std::string>());
                    return out;
                  });
}

std::string titleIn(const std::string& folder)
{
  std::ifstream file(pathIn(folder));
  return readTeam(file, pathIn(folder),
                  [](const Json& team)
                  {
                    return "team of " + std::to_string(team.at("robots").size()) + ", rule " +
                           team.at("rule").get<std::string>();
                  });
}

std::string evaluationsJson(const std::vector<std::string>& names,
                            const std::vector<std::string>& evaluations)
{
  Json out = Json::object();
  for (std::size_t r = 0; r < names.size(); ++r) out[names[r]] = Json::parse(evaluations[r]);
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}
}  // namespace slamot::team
