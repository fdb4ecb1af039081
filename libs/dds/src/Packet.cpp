#include "Packet.h"

#include <cstddef>
#include <iterator>

namespace slamot::dds
{
namespace
{
// An octet sequence has this layout whatever the header of the day calls it.
static_assert(offsetof(Packet, bytes) == 8 && sizeof(dds_sequence_t) == 24);

constexpr std::uint32_t kOps[] = {
    DDS_OP_ADR | DDS_OP_FLAG_KEY | DDS_OP_FLAG_MU | DDS_OP_TYPE_4BY | DDS_OP_FLAG_SGN,
    offsetof(Packet, sender),
    DDS_OP_ADR | DDS_OP_TYPE_SEQ | DDS_OP_SUBTYPE_1BY,
    offsetof(Packet, bytes),
    DDS_OP_RTS,
    DDS_OP_KOF | 1,
    0};
constexpr std::uint32_t kOpsBeforeKeys = 3, kKeyOp = 5;
const dds_key_descriptor_t kKeys[] = {{"sender", kKeyOp, 0}};

const dds_topic_descriptor_t kDescriptor = {sizeof(Packet),
                                            alignof(Packet),
                                            DDS_TOPIC_FIXED_KEY | DDS_TOPIC_FIXED_KEY_XCDR2,
                                            std::size(kKeys),
                                            "slamot::dds::Packet",
                                            kKeys,
                                            kOpsBeforeKeys,
                                            kOps,
                                            "",
                                            {},
                                            {},
                                            {}};
}  // namespace

const dds_topic_descriptor_t& packetDescriptor()
{
  return kDescriptor;
}
}  // namespace slamot::dds
