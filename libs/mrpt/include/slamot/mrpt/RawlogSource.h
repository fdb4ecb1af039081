#pragma once

#include <slamot/core/Odometry.h>
#include <slamot/core/run.h>

#include <memory>
#include <string>

namespace slamot::mrpt
{
/// Streams the steps of a rawlog in either MRPT format, gz or plain, of bounded memory and time.
class RawlogSource : public core::Source
{
 public:
  struct Options
  {
    core::OdometryModel odometry;
    bool salvage = false;  ///< deliver the intact first part of a truncated log, then say so
  };

  /// Scans the whole file first.
  /// \throws core::Error: kUnreadable, kTruncated (unless salvage), kNonsense, kLimit; names the
  /// file, the entry and the byte offset.
  RawlogSource(const std::string& path, const Options& options);
  ~RawlogSource() override;

  std::optional<core::Step> next() override;
  [[nodiscard]] double progress() const override;

  /// The [start] section of the log's comment text; without a time there, that of the first entry
  /// if it holds no motion.
  [[nodiscard]] const core::Starts& starts() const;
  /// Empty, or why the log ended early (salvage only): to be reported after the run.
  [[nodiscard]] const std::string& truncation() const;
  /// Sightings and blobs dropped so far: range at or below zero, or out of the field of view.
  [[nodiscard]] std::size_t dropped() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
}  // namespace slamot::mrpt
