#include <gtest/gtest.h>
#include <slamot/core/Error.h>
#include <slamot/dds/DdsOptions.h>

namespace slamot::dds
{
namespace
{
DdsOptions read(const std::string& keys)
{
  auto config = core::Config::parse("[dds]\nteam = 0, 4\n" + keys, "test.ini");
  DdsOptions out = DdsOptions::from(config);
  config.requireAllRead();
  return out;
}
bool has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}
}  // namespace

TEST(DdsOptions, ByDefaultFindOthersByMulticast)
{
  const DdsOptions o = read("");
  EXPECT_EQ(o.team, (std::vector<int>{0, 4}));
  const std::string xml = cycloneConfig(o);
  EXPECT_TRUE(has(xml, "autodetermine=\"true\"")) << xml;
  for (const char* part : {"Peer", "AllowMulticast", "Security", "Tag", "Lossiness"})
    EXPECT_FALSE(has(xml, part)) << part;
}

TEST(DdsOptions, WithPeersUseNoMulticast)
{
  const std::string xml = cycloneConfig(
      read("peers = 10.0.0.5, robot7.local\ninterface = wlan0\nname = blue\npacket_loss = 0.2\n"));
  for (const char* part :
       {"<AllowMulticast>false<", "<Peer address=\"10.0.0.5\"/><Peer address=\"robot7.local\"/>",
        "<NetworkInterface name=\"wlan0\"/>", "<Tag>blue<", "<XmitLossiness>200<"})
    EXPECT_TRUE(has(xml, part)) << part << " in " << xml;
  EXPECT_TRUE(has(cycloneConfig(read("interface = 10.0.0.4\n")), "address=\"10.0.0.4\""));
}

TEST(DdsOptions, RefuseWhatCyclonesConfigurationCouldTakeForItsOwn)
{
  for (const char* keys : {"name = a<b\n", "interface = \"lo\"\n", "peers = a, ${HOME}\n",
                           "domain = 231\n", "packet_loss = 2\n", "security = /nowhere\n"})
    EXPECT_THROW(read(keys), core::Error) << keys;
}
}  // namespace slamot::dds
