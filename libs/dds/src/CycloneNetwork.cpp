#include <slamot/core/Error.h>
#include <slamot/dds/CycloneNetwork.h>

#include <array>
#include <cmath>
#include <mutex>

#include "Packet.h"

namespace slamot::dds
{
namespace
{
using core::Error;
using core::ExitStatus;
using live::Bytes;
using live::Delivery;

/// What a robot that joins while others run still gets of reliable topics.  In lockstep nobody runs
/// ahead of one that isn't there, so that a few would do.
constexpr int kKept = 1000;

/// Cyclone tells its reasons by a log only: the last one is kept.
class Reasons
{
 public:
  static Reasons& instance()
  {
    static Reasons& reasons = *new Reasons;  // for good: DDS may log until the very end
    return reasons;
  }
  [[nodiscard]] std::string last()
  {
    const std::lock_guard lock(mutex_);
    return last_.empty() ? "" : " (" + last_ + ")";
  }

 private:
  Reasons() { dds_set_log_sink(&Reasons::take, this); }
  static void take(void* self, const dds_log_data_t* data)
  {
    auto& reasons = *static_cast<Reasons*>(self);
    std::string text = data->message;
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    const std::lock_guard lock(reasons.mutex_);
    reasons.last_ = text;
  }
  std::mutex mutex_;
  std::string last_;
};

/// The entity, or an error with Cyclone's reason.
dds_entity_t require(dds_entity_t entity, const std::string& what)
{
  if (entity >= 0) return entity;
  throw Error(ExitStatus::kConfig, "[dds]",
              what + ": " + dds_strretcode(-entity) + Reasons::instance().last(),
              "see interface, peers, security and domain");
}

dds_duration_t durationOf(double seconds)
{
  return static_cast<dds_duration_t>(std::llround(seconds * 1e9));
}

class Qos
{
 public:
  explicit Qos(Delivery delivery)
  {
    if (delivery == Delivery::kNewest)
    {
      dds_qset_reliability(qos_, DDS_RELIABILITY_BEST_EFFORT, 0);
      dds_qset_history(qos_, DDS_HISTORY_KEEP_LAST, 1);
    }
    else
    {
      dds_qset_reliability(qos_, DDS_RELIABILITY_RELIABLE, DDS_SECS(10));
      dds_qset_history(qos_, DDS_HISTORY_KEEP_ALL, 0);
      dds_qset_durability(qos_, DDS_DURABILITY_TRANSIENT_LOCAL);
      dds_qset_durability_service(qos_, 0, DDS_HISTORY_KEEP_LAST, kKept, DDS_LENGTH_UNLIMITED,
                                  DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
    }
    dds_qset_ignorelocal(qos_, DDS_IGNORELOCAL_PARTICIPANT);
  }
  ~Qos() { dds_delete_qos(qos_); }
  Qos(const Qos&) = delete;
  Qos& operator=(const Qos&) = delete;
  [[nodiscard]] const dds_qos_t* get() const { return qos_; }

 private:
  dds_qos_t* qos_ = dds_create_qos();
};

class CycloneTopic : public live::Topic
{
 public:
  CycloneTopic(dds_entity_t participant, dds_entity_t waitset, int robot, const std::string& name,
               Delivery delivery)
      : robot_(robot), name_(name)
  {
    const Qos qos(delivery);
    topic_ = require(dds_create_topic(participant, &packetDescriptor(), ("slamot_" + name).c_str(),
                                      nullptr, nullptr),
                     "no topic " + name);
    writer_ = require(dds_create_writer(participant, topic_, qos.get(), nullptr),
                      "no writing on topic " + name);
    reader_ = require(dds_create_reader(participant, topic_, qos.get(), nullptr),
                      "no reading of topic " + name);
    require(dds_set_status_mask(reader_, DDS_DATA_AVAILABLE_STATUS), "no waiting for topic");
    require(dds_waitset_attach(waitset, reader_, 0), "no waiting for topic");
  }
  ~CycloneTopic() override
  {
    for (const dds_entity_t e : {reader_, writer_, topic_}) dds_delete(e);
  }
  CycloneTopic(const CycloneTopic&) = delete;
  CycloneTopic& operator=(const CycloneTopic&) = delete;

  void publish(const Bytes& packet) override
  {
    Packet sample{};
    sample.sender = robot_;
    sample.bytes._maximum = sample.bytes._length = static_cast<std::uint32_t>(packet.size());
    sample.bytes._buffer = const_cast<std::uint8_t*>(packet.data());  // DDS only reads it
    const dds_return_t result = dds_write(writer_, &sample);
    if (result < 0)
      throw Error(ExitStatus::kLimit, "[dds]",
                  "topic " + name_ + " can't be sent: " + dds_strretcode(-result),
                  "see whether the network works and the others keep up");
  }

  [[nodiscard]] std::vector<Bytes> take() override
  {
    std::vector<Bytes> out;
    std::array<void*, 32> samples{};
    std::array<dds_sample_info_t, 32> infos{};
    for (;;)
    {
      samples[0] = nullptr;  // so that DDS lends its own
      const dds_return_t n =
          dds_take(reader_, samples.data(), infos.data(), samples.size(), samples.size());
      if (n <= 0) return out;
      for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
      {
        if (!infos[i].valid_data) continue;
        const auto& bytes = static_cast<const Packet*>(samples[i])->bytes;
        out.emplace_back(bytes._buffer, bytes._buffer + bytes._length);
      }
      dds_return_loan(reader_, samples.data(), n);
    }
  }

  bool flush(double seconds) override
  {
    return dds_wait_for_acks(writer_, durationOf(seconds)) == DDS_RETCODE_OK;
  }

 private:
  int robot_;
  std::string name_;
  dds_entity_t topic_ = 0, writer_ = 0, reader_ = 0;
};
}  // namespace

struct CycloneNetwork::Impl
{
  Impl(int number, const DdsOptions& options) : robot(number)
  {
    Reasons::instance();
    const auto id = static_cast<dds_domainid_t>(options.domain);
    domain = require(dds_create_domain(id, cycloneConfig(options).c_str()), "no DDS domain");
    participant = dds_create_participant(id, nullptr, nullptr);
    if (participant < 0) dds_delete(domain);
    require(participant, "this robot can't take part");
    waitset = require(dds_create_waitset(participant), "no waiting");
  }
  ~Impl()
  {
    dds_delete(participant);
    dds_delete(domain);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  int robot;
  dds_entity_t domain = 0, participant = 0, waitset = 0;
};

CycloneNetwork::CycloneNetwork(int robot, const DdsOptions& options)
    : impl_(std::make_unique<Impl>(robot, options))
{
}

CycloneNetwork::~CycloneNetwork() = default;

std::unique_ptr<live::Topic> CycloneNetwork::open(const std::string& name, Delivery delivery)
{
  return std::make_unique<CycloneTopic>(impl_->participant, impl_->waitset, impl_->robot, name,
                                        delivery);
}

void CycloneNetwork::wait(double seconds)
{
  dds_waitset_wait(impl_->waitset, nullptr, 0, durationOf(seconds));
}
}  // namespace slamot::dds
