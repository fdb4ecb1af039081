#pragma once

#include <slamot/live/Network.h>

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>

namespace slamot::live
{
/// What robots of one process share: every packet of every topic, in the order of publishing.
struct MemoryHub
{
  struct Sent
  {
    int sender;
    Bytes packet;
  };
  std::mutex mutex;
  std::condition_variable news;
  std::map<std::string, std::vector<Sent>> topics;

  void publish(const std::string& topic, int sender, const Bytes& packet)
  {
    const std::lock_guard lock(mutex);
    topics[topic].push_back({sender, packet});
    news.notify_all();
  }
};

/// A network within one process, for tests: reliable, and to late ones too.
class MemoryNetwork : public Network
{
 public:
  MemoryNetwork(MemoryHub& hub, int robot) : hub_(hub), robot_(robot) {}

  [[nodiscard]] std::unique_ptr<Topic> open(const std::string& name, Delivery delivery) override
  {
    return std::make_unique<MemoryTopic>(hub_, robot_, name, delivery);
  }
  void wait(double seconds) override
  {
    std::unique_lock lock(hub_.mutex);
    hub_.news.wait_for(lock, std::chrono::duration<double>(std::min(seconds, 0.001)));
  }

 private:
  class MemoryTopic : public Topic
  {
   public:
    MemoryTopic(MemoryHub& hub, int robot, std::string name, Delivery delivery)
        : hub_(hub), robot_(robot), name_(std::move(name)), delivery_(delivery)
    {
    }
    void publish(const Bytes& packet) override { hub_.publish(name_, robot_, packet); }
    [[nodiscard]] std::vector<Bytes> take() override
    {
      const std::lock_guard lock(hub_.mutex);
      const auto& all = hub_.topics[name_];
      std::vector<Bytes> out;
      std::map<int, Bytes> newest;
      for (; taken_ < all.size(); ++taken_)
      {
        const auto& [sender, packet] = all[taken_];
        if (sender == robot_) continue;
        newest[sender] = packet;
        if (delivery_ == Delivery::kAll) out.push_back(packet);
      }
      if (delivery_ == Delivery::kNewest)
        for (auto& [sender, packet] : newest) out.push_back(std::move(packet));
      return out;
    }
    bool flush(double) override { return true; }

   private:
    MemoryHub& hub_;
    int robot_;
    std::string name_;
    Delivery delivery_;
    std::size_t taken_ = 0;
  };

  MemoryHub& hub_;
  int robot_;
};
}  // namespace slamot::live
