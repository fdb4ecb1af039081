#pragma once

#include <dds/dds.h>

#include <cstdint>

namespace slamot::dds
{
/// What goes over DDS, in IDL:
///   module slamot { module dds { @final struct Packet { @key long sender; sequence<octet> bytes;
///   }; }; };
struct Packet
{
  std::int32_t sender;
  dds_sequence_t bytes;  // of octets
};

/// Its description, as idlc makes it.  It is written out here so that the build needs neither
/// idlc nor a C compiler.
[[nodiscard]] const dds_topic_descriptor_t& packetDescriptor();
}  // namespace slamot::dds
