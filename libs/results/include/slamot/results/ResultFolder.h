#pragma once

#include <slamot/results/Summary.h>

#include <functional>
#include <string>

namespace slamot::results
{
/// `./slamot-out/<method>-<dataset>`, where results go unless told otherwise.
[[nodiscard]] std::string defaultFolder(const std::string& method, const std::string& dataset);

/// What a run should ask before it starts: that results can be put at `path`, where nothing or an
/// older result is.  \throws core::Error (kConfig).
void requirePlaceFor(const std::string& path);

/// A folder in the making: all is written to a temporary beside its place and put there whole, in
/// place of an older result.  Whatever happens before, nothing at the place looks whole.
class ResultFolder
{
 public:
  /// \throws core::Error as requirePlaceFor(), or kUnreadable if the temporary can't be made.
  explicit ResultFolder(const std::string& path);
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  /// Where to write.
  [[nodiscard]] const std::string& temporary() const { return temporary_; }
  /// Puts it in its place.  \throws core::Error (kUnreadable).
  void publish();

 private:
  std::string path_, temporary_;
};

/// Writes a whole result folder.  `addFiles` may write more into the folder it is given; if it
/// throws, the result is put in place without those files and the exception goes on.
void writeResult(const std::string& path, const RunInfo& info, const eval::Record& record,
                 const eval::Evaluation& evaluation, const Timing& timing,
                 const std::function<void(const std::string& folder)>& addFiles);
}  // namespace slamot::results
