#pragma once

#include <slamot/core/Step.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cv
{
class Mat;
}
namespace mrpt::obs
{
class CObservation;
}

namespace slamot::mrpt
{
/// An observation on its way from one log to another.
struct SensedEntry
{
  std::shared_ptr<const ::mrpt::obs::CObservation> observation;  ///< never null
  std::shared_ptr<const core::LaserScan> laser;  ///< the same, of a laser; else null
  std::size_t pictureAt = 0;                     ///< for EditedEntry::picture()
};

/// One entry of a rawlog on its way to another.
class EditedEntry
{
 public:
  bool mayTakeObservations = false;  ///< a frame or an observation: something was sensed
  std::optional<Pose2D> increment;   ///< of actions: how the robot moved
  std::vector<SensedEntry> sensed;   ///< of classes that slamot reads; images too, without pixels
  /// Whether it is a sensory frame, which holds several observations.
  [[nodiscard]] bool isFrame() const { return isFrame_; }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }  ///< [byte]
  /// The pixels of an image that the log itself holds; empty if they can't be decoded.
  [[nodiscard]] cv::Mat picture(const SensedEntry& image) const;

 private:
  friend class RawlogEditor;
  bool isFrame_ = false;
  std::size_t countAt_ = 0;
  std::vector<unsigned char> bytes_;
};

/// Copies a rawlog entry by entry, byte for byte, whatever its classes, and adds observations: to
/// the frame that an entry is, else behind the entry.
class RawlogEditor
{
 public:
  /// The new log appears at `to` with close() only.
  /// \throws core::Error (kUnreadable), also if both are one file.
  RawlogEditor(const std::string& from, const std::string& to);
  ~RawlogEditor();

  /// \throws core::Error as RawlogSource does.
  std::optional<EditedEntry> next();
  /// Copies an entry, with what is added to it; in the order of next().
  void write(const EditedEntry& entry,
             const std::vector<std::shared_ptr<::mrpt::obs::CObservation>>& added);
  /// Completes the new log and puts it in its place. \throws core::Error (kUnreadable) if it can't
  /// be written.
  void close();
  /// Share of the old log already read, 0 to 1.
  [[nodiscard]] double progress() const;

  /// Where MRPT looks for the images that a log keeps in files: `<log>_Images` beside it.
  [[nodiscard]] static std::string imagesFolder(const std::string& log);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
}  // namespace slamot::mrpt
