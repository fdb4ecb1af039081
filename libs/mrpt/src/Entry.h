#pragma once

#include <mrpt/serialization/CSerializable.h>
#include <slamot/core/Error.h>

#include <cstdint>
#include <string>
#include <vector>

namespace slamot::mrpt
{
/// One object of a rawlog's outermost level.
struct Entry
{
  enum class Kind
  {
    kActions,      ///< a CActionCollection; parts are its actions
    kFrame,        ///< a CSensoryFrame; parts are its observations
    kObservation,  ///< the one part
    kComment       ///< the one part, a CObservationComment
  };
  struct Part
  {
    std::string className;
    ::mrpt::serialization::CSerializable::Ptr object;  ///< null: a class that slamot does not use
    std::size_t pictureAt = 0;  ///< of an image: where in Entry::bytes its picture begins
  };

  std::string path;
  std::size_t number = 0;    ///< from 0, comments included
  std::uint64_t offset = 0;  ///< of its first byte [byte], unpacked
  Kind kind = Kind::kObservation;
  std::vector<Part> parts;
  std::vector<unsigned char> bytes;  ///< all of it as it stands in the log; kept for editing only
  std::size_t countAt = 0;  ///< of actions and frames: where in `bytes` their number of parts is

  /// The object of a kObservation or kComment, if it is of this class.
  template <class T>
  [[nodiscard]] std::shared_ptr<const T> as() const
  {
    return std::dynamic_pointer_cast<const T>(parts.at(0).object);
  }

  /// "run7.rawlog entry 88"
  [[nodiscard]] std::string where() const { return path + " entry " + std::to_string(number); }

  /// \throws core::Error.
  [[noreturn]] void fail(const std::string& what, const std::string& mend,
                         core::ExitStatus status = core::ExitStatus::kNonsense) const
  {
    throw core::Error(status, where(), what, mend);
  }
};
}  // namespace slamot::mrpt
