#pragma once

#include "ByteCursor.h"

#include <optional>

namespace mrpt::rtti
{
struct TRuntimeClassId;
}

namespace slamot::mrpt
{
inline constexpr std::uint8_t kEndFlag = 0x88;  ///< the last byte of every object

inline constexpr const char* kNoObject = "no object begins here";

/// How MRPT begins an object: its class name's length | 0x80, the name, a version.
struct ObjectHeader
{
  std::string name;  ///< as in the file; old logs have no namespace
  const ::mrpt::rtti::TRuntimeClassId* id = nullptr;  ///< null: not registered, or the null object
  std::uint8_t version = 0;

  [[nodiscard]] bool isNull() const { return name == "nullptr"; }
};

/// \throws Damage (kUnreadable) where no object begins; NeedMore.
[[nodiscard]] ObjectHeader readHeader(ByteCursor& cursor);

/// MRPT's CLASS_ID, which names `mrpt::` and so can't be used in this namespace.
template <class T>
[[nodiscard]] const ::mrpt::rtti::TRuntimeClassId* classId()
{
  return &T::GetRuntimeClassIdStatic();
}

/// A CSensoryFrame or CActionCollection.
[[nodiscard]] bool isFrameOrActions(const ObjectHeader& header);

/// What may stand where.
enum class Level
{
  kLog,     ///< outermost: actions, frames, observations
  kFrame,   ///< observations
  kActions  ///< movements
};
[[nodiscard]] bool belongs(const ObjectHeader& header, Level level);

/// Where an object ends whose layout is not known: the next end flag that is followed by what may
/// come next, which is `last` ? the end of its holder : a sibling.  A payload holds such bytes by
/// chance less than once in 2^100.
/// \param atEnd no more bytes will come.
/// \throws NeedMore where there is none in the bytes at hand.
void skipUnknown(ByteCursor& cursor, Level level, bool last, bool atEnd);

/// Whether, some way behind `cursor`, an entry of the log begins that is not just a part of the one
/// at `cursor`: behind a frame, only frames and actions tell.
[[nodiscard]] bool entryFollows(ByteCursor cursor, bool inFrameOrActions);
}  // namespace slamot::mrpt
