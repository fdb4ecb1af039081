#pragma once

#include <stdexcept>
#include <string>

namespace slamot::core
{
/// The program's exit statuses; part of its interface.
enum class ExitStatus
{
  kDone = 0,          ///< all went well
  kConfig = 1,        ///< a usage or configuration error
  kUnreadable = 2,    ///< input that can't be read
  kTruncated = 3,     ///< input that ends too early
  kNonsense = 4,      ///< values in the input that make no sense
  kLimit = 5,         ///< a limit on size or time exceeded
  kInternal = 6,      ///< a defect of the program
  kInterrupted = 130  ///< ended by the user (Ctrl-C), as shells have it: 128 + SIGINT
};

/// One line for the user: WHERE: WHAT; HOW TO MEND.
/// `where` names the file, the entry or the key; an empty `mend` leaves the last part out.
class Error : public std::runtime_error
{
 public:
  /// what() becomes `where: what; mend`.
  Error(ExitStatus status, const std::string& where, const std::string& what,
        const std::string& mend = {})
      : std::runtime_error(where + ": " + what + (mend.empty() ? "" : "; " + mend)), status_(status)
  {
  }
  /// What the program ends with when nobody catches this.
  [[nodiscard]] ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};
}  // namespace slamot::core
