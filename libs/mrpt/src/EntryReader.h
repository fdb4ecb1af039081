#pragma once

#include "BoundedInput.h"
#include "Entry.h"
#include "objectLayout.h"

#include <optional>

namespace slamot::mrpt
{
/// Streams a rawlog's entries.  Of each, MRPT's parser sees only objects whose bytes have been
/// walked over before; the bytes of classes that slamot does not use are skipped.
class EntryReader
{
 public:
  static constexpr std::size_t kLargestEntry = 64u << 20;  ///< [byte]
  static constexpr std::uint32_t kMostParts = 10000;       ///< in one frame or list of actions

  enum class For
  {
    kSteps,   ///< images are skipped like all that steps do not hold
    kEditing  ///< images are read, and each entry's bytes kept
  };

  /// \throws core::Error (kUnreadable).
  explicit EntryReader(const std::string& path, For purpose = For::kSteps)
      : path_(path), input_(path), purpose_(purpose)
  {
  }

  /// None at the end.  \throws core::Error with the entry and its byte: kUnreadable (no rawlog, an
  /// unknown class, damaged), kTruncated (it ends inside an entry), kNonsense (counts and choices
  /// that can't be), kLimit.
  std::optional<Entry> next();
  /// Share of the file read, 0 to 1.
  [[nodiscard]] double progress() const { return input_.progress(); }
  /// Whether the file is gz; known after the first next().
  [[nodiscard]] bool packed() const { return input_.packed(); }

 private:
  /// The bytes of a part, its header included.
  struct Extent
  {
    ObjectHeader header;
    std::size_t begin, end;
  };

  [[nodiscard]] bool reads(const ObjectHeader& header) const;
  bool grow();
  struct Walked
  {
    Entry::Kind kind;
    std::vector<Extent> parts;
    std::size_t countAt = 0;
  };
  Walked walk(ByteCursor& cursor) const;
  Extent walkPart(ByteCursor& cursor, Level level, bool last) const;
  Entry parse(const Walked& walked, std::size_t size);
  Entry::Part parsePart(const Extent& extent);

  [[nodiscard]] std::string where(std::size_t at) const;
  [[noreturn]] void failAtEnd();
  [[noreturn]] void fail(const Damage& damage);

  std::string path_;
  BoundedInput input_;
  For purpose_;
  std::vector<unsigned char> window_;  // bytes at hand; [begin_, end_) are still to be read
  std::size_t begin_ = 0, end_ = 0;
  std::uint64_t offset_ = 0;  // of begin_ in the unpacked file
  bool atEnd_ = false;        // the input holds no more than the window
  std::size_t count_ = 0;
};
}  // namespace slamot::mrpt
