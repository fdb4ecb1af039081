#pragma once

#include <slamot/reproduce/Reproduction.h>

#include "../study/tinyStudy.h"

namespace slamot::reproduce::test
{
/// A paper of three sections on the tiny study of 16 runs: claims of every verdict, a table, a plot
/// and a picture.
class TinyPaper
{
 public:
  explicit TinyPaper(const std::string& paper = kPaper)
  {
    study_.folder().write("reproduce.tiny.ini", paper);
    study_.folder().write("reproduce.all.ini",
                          "[papers]\ntitle = Tiny papers\nfiles = reproduce.tiny.ini\n");
  }

  [[nodiscard]] PaperSpec spec(const std::vector<std::string>& set = {}, bool isQuick = false) const
  {
    return PaperSpec::load(file("reproduce.tiny.ini"), {isQuick, set, std::nullopt});
  }
  [[nodiscard]] Reproduction reproduction(bool isQuick = false,
                                          const std::vector<std::string>& set = {}) const
  {
    return {"tiny", file("."), {isQuick, set, std::nullopt}};
  }
  [[nodiscard]] const study::test::TinyStudy& study() const { return study_; }
  [[nodiscard]] std::string file(const std::string& name) const { return study_.out(name); }
  [[nodiscard]] std::string read(const std::string& name) const
  {
    return study_.folder().read(name);
  }

  static constexpr const char* kPaper = R"([paper]
title    = Tiny paper
citation = Nobody. "Nothing" <2013>.
sections = main, less, real

[section.main]
title    = Main part
study    = study.ini
tables   = errors
folded   = ratios
plots    = errors
pictures = map
claims   = better, printed
quick.study.seeds            = 2
quick.vary.landmarks.values  = 8

[section.less]
title    = Left out when quick
study    = study.ini
in_quick = false
claims   = larger

[section.real]
claims   = real

[picture.map]
kind      = map
method    = joint
landmarks = 8
caption   = From above

[claim.better]
says    = The joint filter is better than odometry.
where   = Table 1
when.1  = robot_mean_m(joint) / robot_mean_m(odometry) < 10
when.2  = robot_mean_m(joint, landmarks=3) < 0.000001
what.2  = robot error among 3 landmarks

[claim.printed]
says    = Its error is 0.01 m.
when.1  = robot_mean_m(joint) = 0.01 +- 0.000001

[claim.larger]
says    = Errors are not negative.
when.1  = robot_mean_m(joint) > -1

[claim.real]
says       = It works on a real robot.
untestable = Nobody has its data.
)";

 private:
  study::test::TinyStudy study_;
};
}  // namespace slamot::reproduce::test
