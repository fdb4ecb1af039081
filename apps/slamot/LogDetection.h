#pragma once

#include <slamot/mrpt/RawlogEditor.h>
#include <slamot/perception/Pipeline.h>

#include <deque>
#include <string>
#include <vector>

namespace slamot::apps
{
/// A rawlog on its way through a detection pipeline: entries wait until what was sensed within
/// `max_time_apart_s` of them is known, and leave with what was found in them.
class LogDetection
{
 public:
  LogDetection(perception::Pipeline& pipeline, mrpt::RawlogEditor& editor, const std::string& log);

  /// Takes in one entry, and lets go what has waited long enough; false at the end, when all is
  /// written.  \throws core::Error.
  bool advance();

  [[nodiscard]] const perception::Pipeline::Counts& counts() const { return pipeline_.counts(); }
  [[nodiscard]] std::vector<std::string> warnings() const;
  [[nodiscard]] std::size_t entries() const { return entries_; }

 private:
  struct Sensed  // one observation of an entry
  {
    double time;
    std::size_t index;                     // in the entry
    std::optional<perception::Look> look;  // of an image
  };
  struct Item
  {
    double first, last;  // times of what was sensed
    mrpt::EditedEntry entry;
    std::vector<Sensed> sensed;
    bool ranged = false;
  };
  void take(mrpt::EditedEntry entry);
  void takeObservation(Item& item, std::size_t index);
  void setTimes(Item& item);
  void takeImage(Sensed& sensed, const Item& item, const mrpt::SensedEntry& seen);
  void takeOdometry(double time, const std::string& sensor, const Pose2D& pose);
  [[nodiscard]] bool isLong() const;
  void range(Item& item);
  void release(Item& item);

  perception::Pipeline& pipeline_;
  mrpt::RawlogEditor& editor_;
  std::string images_;  // folder of those that the log keeps in files
  std::deque<Item> waiting_;
  std::string log_;
  std::size_t waitingBytes_ = 0;
  double now_ = 0;  // the latest time of anything sensed [s]
  bool timed_ = false;
  std::optional<Pose2D> moved_;  // by actions since the last frame
  bool hasActions_ = false;
  std::string odometerLabel_;
  std::size_t entries_ = 0, unreadable_ = 0, blind_ = 0;
  std::string unreadableWhat_;
  std::optional<Pose2D> odometer_;
};
}  // namespace slamot::apps
