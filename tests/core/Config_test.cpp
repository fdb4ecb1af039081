#include "expectError.h"

#include <slamot/core/Params.h>

#include <cstdio>
#include <fstream>

namespace slamot::core
{
namespace
{
using test::expectConfigError;

Config parse(const std::string& text)
{
  return Config::parse(text, "x.ini");
}

void expectRefused(const std::string& text, const std::vector<std::string>& parts)
{
  SCOPED_TRACE(text);
  expectConfigError([&] { (void)parse(text); }, parts);
}
}  // namespace

TEST(Config, ReadsMrptsDialect)
{
  Config c = parse(
      "// a comment\n; another\n# and another\r\n\n[a]\nkey = some text // why\r\n\t x=1\ny =\n"
      "[ b c ]\nz = p = q ; r # s\n");
  EXPECT_EQ(c.sections(), (std::vector<std::string>{"a", "b c"}));
  EXPECT_EQ(Params(c, "a").text("key"), "some text");
  EXPECT_EQ(Params(c, "a").text("x"), "1");
  EXPECT_EQ(Params(c, "a").text("y"), "");
  EXPECT_EQ(Params(c, "b c").text("z"), "p = q ; r # s");
  EXPECT_TRUE(c.has("a", "y"));
  EXPECT_FALSE(c.has("a", "z"));
  EXPECT_FALSE(c.has("c"));
  c.requireAllRead();
}

TEST(Config, RefusesLinesThatAreNeither)
{
  expectRefused("[a]\nx = 1\nnonsense\n", {"x.ini line 3", "'nonsense'", "key = value"});
  expectRefused("x = 1\n", {"x.ini line 1", "outside any section"});
  expectRefused("[a\nx = 1\n", {"line 1", "unclosed section"});
  expectRefused("[]\n", {"line 1", "section"});
  expectRefused("[ ]\nx = 1\n", {"line 1", "section"});
  expectRefused("[a]\n = 1\n", {"line 2", "without a key"});
  expectRefused(std::string("[a]\nx = 1\0\n", 11), {"not a text file"});
}

TEST(Config, RefusesWhatComesTwice)
{
  expectRefused("[a]\nx = 1\nx = 1\n", {"line 3", "key x comes twice"});
  expectRefused("[a]\nx = 1\n[b]\n[a]\ny = 2\n", {"line 4", "[a] comes twice"});
}

// MRPT takes these for one; a person would not see which value holds.
TEST(Config, RefusesWhatDiffersByCaseAlone)
{
  expectRefused("[a]\nx = 1\n[A]\ny = 2\n", {"line 3", "[A] comes twice"});
  expectRefused("[a]\nkey = 1\nKey = 2\n", {"line 3", "key Key comes twice"});
}

TEST(Config, FindsKeysThatNobodyReadAndTheNearestThatIsKnown)
{
  Config c = parse("[f]\nrange_std_m = 1\nbearing_sdt_deg = 2\n");
  Params p(c, "f");
  (void)p.number("range_std_m");
  (void)p.number("bearing_std_deg", 1.0);
  expectConfigError([&] { c.requireAllRead(); },
                    {"x.ini [f] bearing_sdt_deg: unknown key; did you mean bearing_std_deg?"});
}

TEST(Config, NamesAllKnownKeysWhereNoneIsNear)
{
  Config c = parse("[f]\nquux = 2\n");
  Params p(c, "f");
  (void)p.number("range_std_m", 1.0);
  (void)p.number("bearing_std_deg", 1.0);
  expectConfigError([&] { c.requireAllRead(); },
                    {"[f] quux: unknown key; known: range_std_m, bearing_std_deg"});
}

TEST(Config, FindsSectionsThatNobodyRead)
{
  Config c = parse("[rbpf-slamt]\nparticles = 1\n[other]\nx = 1\n");
  (void)Params(c, "rbpf-slamot").integer("particles", 1, 10, 1);
  expectConfigError([&] { c.requireAllRead({"other"}); },
                    {"x.ini [rbpf-slamt]: unknown section; did you mean rbpf-slamot?"});
  expectConfigError([&] { c.requireAllRead({"rbpf-slamt"}); }, {"[other]", "unknown section"});
  c.requireAllRead({"rbpf-slamt", "other"});
}

TEST(Config, SetOverridesAndAdds)
{
  Config c = parse("[f]\nx = 1\n");
  c.set("f.x=2");
  c.set("f.y = a = b ");
  c.set("g.h.z=");
  Params p(c, "f");
  EXPECT_EQ(p.number("x"), 2);
  EXPECT_EQ(p.text("y"), "a = b");
  EXPECT_EQ(Params(c, "g.h").text("z"), "");
}

TEST(Config, SetRefusesOtherForms)
{
  for (const char* form : {"", "x", "f.x", "x=1", ".x=1", "f.=1", "=1", ".=", "x=1.5"})
  {
    SCOPED_TRACE(form);
    Config c = parse("[f]\nx = 1\n");
    expectConfigError([&] { c.set(form); }, {"--set", "Section.key=value"});
  }
}

// Else the effective text would not read back.
TEST(Config, SetRefusesValuesThatAFileCannotHold)
{
  for (const char* value : {"a\nb = 1", "a\rb", "http://x"})
  {
    Config c;
    expectConfigError([&] { c.set(std::string("f.x=") + value); }, {"[f] x", "line break"});
  }
}

TEST(Config, EffectiveTextHoldsDefaultsInOrderOfReading)
{
  Config c = parse("[b]\ny = 2 // why\n[a]\nx = 1\n[unread]\nz = 1\n");
  (void)Params(c, "a").number("x");
  Params b(c, "b");
  (void)b.number("half", 0.5);
  (void)b.number("y");
  (void)b.optionalNumber("absent");
  (void)Params(c, "empty");
  EXPECT_EQ(c.effectiveText(), "[a]\nx = 1\n\n[b]\nhalf = 0.5\ny = 2\n");
}

TEST(Config, EffectiveTextIsReadBackAsTheSame)
{
  const auto read = [](Config& c)
  {
    Params p(c, "f");
    std::vector<double> values = {p.number("x", 1.0 / 3), p.positive("tiny", 4.9e-324),
                                  p.number("turn_deg", 1.0), p.number("big", -1e300)};
    for (const double v : p.numbers("list_deg", "1, 2.5,3")) values.push_back(v);
    values.push_back(p.flag("flag", true));
    values.push_back(p.integer("n", -5, 5, -3));
    EXPECT_EQ(p.text("text", ""), "");
    EXPECT_EQ(p.choice("choice", {"one", "two"}, "two"), "two");
    return values;
  };
  Config first = parse(""), second;
  const auto values = read(first);
  second = parse(first.effectiveText());
  EXPECT_EQ(read(second), values);
  second.requireAllRead();
  EXPECT_EQ(second.effectiveText(), first.effectiveText());
}

TEST(Config, AddsOnlySectionsThatAreMissing)
{
  Config c = parse("[a]\nx = 1\n");
  c.addMissingSections(parse("[a]\nx = 2\ny = 3\n[b]\nz = 4\n"));
  EXPECT_EQ(Params(c, "a").number("x"), 1);
  EXPECT_FALSE(c.has("a", "y"));
  EXPECT_EQ(Params(c, "b").number("z"), 4);
}

TEST(Config, ErasesASectionThatWasRead)
{
  Config c = parse("[a]\nx = 1\n[b]\ny = 2\n");
  (void)Params(c, "a").number("x");
  (void)Params(c, "b").number("y");
  c.erase("a");
  EXPECT_EQ(c.effectiveText(), "[b]\ny = 2\n");
  c.requireAllRead();
}

TEST(Config, LoadsAFileAndIsNamedAfterIt)
{
  const std::string path = ::testing::TempDir() + "slamot-config-test.ini";
  std::ofstream(path) << "[a]\nx = 1\n";
  Config c = Config::load(path);
  EXPECT_EQ(c.name(), "slamot-config-test.ini");
  EXPECT_EQ(Params(c, "a").number("x"), 1);
  std::remove(path.c_str());
  expectConfigError([&] { (void)Config::load(path); }, {path, "can't be read"});
  expectConfigError([&] { (void)Config::load(::testing::TempDir()); }, {"can't be read"});
}

TEST(Config, RefusesAFileOverFourMegabytes)
{
  const std::string path = ::testing::TempDir() + "slamot-config-large.ini";
  std::ofstream(path) << std::string((4u << 20) + 1, '\n');
  expectConfigError([&] { (void)Config::load(path); }, {"over 4 MB"});
  std::remove(path.c_str());
}
}  // namespace slamot::core
