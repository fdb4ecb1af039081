#pragma once

#include <mrpt/serialization/CSerializable.h>
#include <slamot/core/Error.h>

#include <cstdint>
#include <string>

namespace slamot::mrpt
{
/// One object of a rawlog's outermost level.
struct Entry
{
  std::string path;
  std::size_t number = 0;    ///< from 0, as RawLogViewer and rawlog-edit count, comments included
  std::uint64_t offset = 0;  ///< of its first byte in the file, unpacked
  std::string className;
  ::mrpt::serialization::CSerializable::Ptr object;  ///< null: a class that slamot does not use

  template <class T>
  [[nodiscard]] std::shared_ptr<const T> as() const
  {
    return std::dynamic_pointer_cast<const T>(object);
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
