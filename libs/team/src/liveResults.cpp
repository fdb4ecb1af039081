#include <slamot/team/liveResults.h>

#include <nlohmann/json.hpp>

namespace slamot::team
{
using Json = nlohmann::ordered_json;

std::string messagesJson(const fusion::Member& member, const std::map<int, int>& sessions)
{
  Json outcomes = Json::object(), heard = Json::object();
  for (const auto& [name, count] : member.counts().rows()) outcomes[name] = count;
  for (const auto& [number, count] : sessions) heard[std::to_string(number)] = count;
  const Json out = {{"robot", member.number()},         {"sent", member.sent()},
                    {"bytes_sent", member.bytesSent()}, {"received", member.counts().messages()},
                    {"by_outcome", outcomes},           {"starts_heard", heard}};
  return out.dump(2) + "\n";
}
}  // namespace slamot::team
