#pragma once

#include <gtest/gtest.h>

#include <clocale>
#include <cstdlib>
#include <fstream>
#include <string>

namespace slamot::test
{
/// While it lives, numbers have decimal commas, if the machine has or can make such a locale.
class CommaLocale
{
 public:
  CommaLocale()
  {
    if (is("de_DE.UTF-8") || is("fr_FR.UTF-8") || is("es_ES.UTF-8")) return;
    const std::string folder = ::testing::TempDir() + "slamot-locales";
    const std::string source = folder + "/comma";
    (void)std::system(("mkdir -p " + folder).c_str());
    std::ofstream(source) << "LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \".\"\n"
                             "grouping 3\nEND LC_NUMERIC\n"
                             "LC_CTYPE\ncopy \"POSIX\"\nEND LC_CTYPE\n";
    // -c: other categories are not there, which is a warning.
    (void)std::system(("localedef --no-archive -c -f ANSI_X3.4-1968 -i " + source + " " + folder +
                       "/comma_XX >/dev/null 2>&1")
                          .c_str());
    setenv("LOCPATH", folder.c_str(), 1);
    (void)is("comma_XX");
  }
  ~CommaLocale()
  {
    std::setlocale(LC_NUMERIC, "C");
    unsetenv("LOCPATH");
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

  [[nodiscard]] static bool active() { return *std::localeconv()->decimal_point == ','; }

 private:
  static bool is(const char* name) { return std::setlocale(LC_NUMERIC, name) && active(); }
};
}  // namespace slamot::test
