#include <slamot/dds/DdsOptions.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace slamot::dds
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* kNone = "none";
constexpr const char* kKeyFiles[] = {"identity_ca.pem", "permissions_ca.pem", "certificate.pem",
                                     "key.pem",         "governance.p7s",     "permissions.p7s"};

std::vector<int> teamOf(core::Params& p)
{
  std::vector<int> out;
  for (const double number : p.numbers("team"))
  {
    if (number < 0 || number > 999'999 || number != static_cast<int>(number))
      p.fail("team", "a robot's number is a whole number from 0 to 999999");
    out.push_back(static_cast<int>(number));
  }
  if (std::set<int>(out.begin(), out.end()).size() != out.size())
    p.fail("team", "names a robot twice", "give each robot a number of its own");
  return out;
}

/// Text that goes into Cyclone's XML: what could end an attribute has no place in names and paths.
std::string plain(const core::Params& p, const std::string& key, const std::string& text)
{
  const auto isOdd = [](char c)
  {
    return static_cast<unsigned char>(c) < ' ' ||
           std::string("<>&\"'${}").find(c) != std::string::npos;
  };
  if (std::any_of(text.begin(), text.end(), isOdd))
    p.fail(key, "holds one of < > & \" ' $ { }, which Cyclone DDS can't take");
  return text == kNone ? "" : text;
}

std::string keysOf(core::Params& p)
{
  std::string folder = plain(p, "security", p.text("security", kNone));
  if (folder.empty()) return folder;
  for (const char* file : kKeyFiles)
    if (!fs::exists(fs::path(folder) / file))
      p.fail("security", "there is no " + (fs::path(folder) / file).string(),
             "make keys with share/dds-security/make-keys");
  return fs::absolute(folder).string();
}

std::string element(const char* name, const std::string& content)
{
  return std::string("<") + name + ">" + content + "</" + name + ">";
}

std::string interfaceElement(const std::string& interface)
{
  const bool isAddress = interface.find_first_not_of("0123456789.") == std::string::npos;
  const std::string which = interface.empty() ? "autodetermine=\"true\""
                            : isAddress       ? "address=\"" + interface + "\""
                                              : "name=\"" + interface + "\"";
  return element("Interfaces", "<NetworkInterface " + which + "/>");
}

std::string securityElement(const std::string& folder)
{
  const auto file = [&](const char* name, const char* in)
  { return element(name, "file:" + folder + "/" + in); };
  const auto library = [](const char* kind, const char* path)
  {
    return std::string("<Library initFunction=\"init_") + kind + "\" finalizeFunction=\"finalize_" +
           kind + "\" path=\"" + path + "\"/>";
  };
  return element("Security",
                 element("Authentication", library("authentication", "dds_security_auth") +
                                               file("IdentityCertificate", "certificate.pem") +
                                               file("IdentityCA", "identity_ca.pem") +
                                               file("PrivateKey", "key.pem")) +
                     element("AccessControl", library("access_control", "dds_security_ac") +
                                                  file("Governance", "governance.p7s") +
                                                  file("PermissionsCA", "permissions_ca.pem") +
                                                  file("Permissions", "permissions.p7s")) +
                     element("Cryptographic", library("crypto", "dds_security_crypto")));
}
}  // namespace

DdsOptions DdsOptions::from(core::Config& config)
{
  core::Params p(config, "dds");
  DdsOptions out;
  out.team = teamOf(p);
  out.domain = p.integer("domain", 0, 230, 0);
  out.name = plain(p, "name", p.text("name", kNone));
  out.interface = plain(p, "interface", p.text("interface", "auto"));
  if (out.interface == "auto") out.interface.clear();
  for (const std::string& peer : p.list("peers", kNone))
    if (const std::string host = plain(p, "peers", peer); !host.empty()) out.peers.push_back(host);
  out.security = keysOf(p);
  out.packetLoss = p.inRange("packet_loss", 0, 1, 0.0);
  out.silenceS = p.positive("lockstep_silence_s", out.silenceS);
  return out;
}

std::string cycloneConfig(const DdsOptions& o)
{
  std::string general = interfaceElement(o.interface);
  // So that a robot that was not heard at once is heard a second later.
  std::string discovery = element("SPDPInterval", "1s");
  if (!o.name.empty()) discovery += element("Tag", o.name);
  if (!o.peers.empty())
  {
    general += element("AllowMulticast", "false");
    std::string peers;
    for (const std::string& peer : o.peers) peers += "<Peer address=\"" + peer + "\"/>";
    // A peer is looked for at the ports of the first robots on its host.
    discovery += element("ParticipantIndex", "auto") + element("MaxAutoParticipantIndex", "31") +
                 element("Peers", peers);
  }
  std::string out = element("General", general) + element("Discovery", discovery);
  if (o.packetLoss > 0)
    out += element("Internal",
                   element("Test", element("XmitLossiness",
                                           std::to_string(static_cast<int>(1000 * o.packetLoss)))));
  if (!o.security.empty()) out += securityElement(o.security);
  return element("CycloneDDS", element("Domain", out));
}
}  // namespace slamot::dds
