#pragma once

#include <slamot/dds/DdsOptions.h>
#include <slamot/live/Network.h>

namespace slamot::dds
{
/// Robots that find each other by DDS discovery, without a broker.  A topic `x` is the DDS topic
/// `slamot_x` of packets keyed by their sender, as doc/team.md says.
class CycloneNetwork : public live::Network
{
 public:
  /// \param robot number of this robot.
  /// \throws core::Error (kConfig) with Cyclone's reason, such as an interface that isn't there or
  /// keys that can't be used.
  CycloneNetwork(int robot, const DdsOptions& options);
  ~CycloneNetwork() override;
  CycloneNetwork(const CycloneNetwork&) = delete;
  CycloneNetwork& operator=(const CycloneNetwork&) = delete;

  [[nodiscard]] std::unique_ptr<live::Topic> open(const std::string& name,
                                                  live::Delivery delivery) override;
  void wait(double seconds) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
}  // namespace slamot::dds
