#pragma once

#include "objectHeader.h"

namespace slamot::mrpt
{
/// Whether steps use this class, so that its layout is known and MRPT's parser may see it.
[[nodiscard]] bool hasLayout(const ObjectHeader& header);

/// Walks over an object of such a class, from behind its header to behind its end flag, and checks
/// what MRPT's parser takes on trust: counts that it allocates for, classes of nested objects,
/// fields that choose a branch. \throws Damage, NeedMore.
void walkObject(ByteCursor& cursor, const ObjectHeader& header);

/// Where in an image's bytes, header included, its picture is: [begin, end), of an object that can
/// be walked over.
struct PicturePlace
{
  std::size_t begin, end;
};
[[nodiscard]] PicturePlace pictureIn(ByteCursor cursor);

/// \throws Damage (kUnreadable) unless `version` is at most `newest` and at least `oldest`.
void requireVersion(const ByteCursor& cursor, const ObjectHeader& header, int oldest, int newest);

/// \throws Damage (kUnreadable).
void requireEndFlag(ByteCursor& cursor, const std::string& className);
}  // namespace slamot::mrpt
