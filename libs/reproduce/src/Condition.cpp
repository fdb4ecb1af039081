#include <slamot/reproduce/Condition.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace slamot::reproduce
{
namespace
{
[[noreturn]] void fail(const std::string& what)
{
  throw std::invalid_argument(what);
}

std::string trimmed(const std::string& text)
{
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Reads a condition from left to right.
class Reader
{
 public:
  explicit Reader(const std::string& text) : text_(text) {}

  /// Takes this word or sign if it is next.
  bool take(const std::string& word)
  {
    skipBlanks();
    if (text_.compare(at_, word.size(), word) != 0) return false;
    at_ += word.size();
    return true;
  }
  void expect(const std::string& word)
  {
    if (!take(word)) fail("'" + word + "' is missing before '" + rest() + "'");
  }
  [[nodiscard]] bool atEnd()
  {
    skipBlanks();
    return at_ >= text_.size();
  }
  [[nodiscard]] std::string rest()
  {
    skipBlanks();
    return text_.substr(at_);
  }
  std::string name()
  {
    skipBlanks();
    const auto isOfName = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
    const std::size_t from = at_;
    while (at_ < text_.size() && isOfName(static_cast<unsigned char>(text_[at_]))) ++at_;
    if (at_ == from) fail("a metric's name is missing before '" + rest() + "'");
    return text_.substr(from, at_ - from);
  }
  /// What is there up to one of these signs.
  std::string upTo(const char* signs)
  {
    const auto end = text_.find_first_of(signs, at_);
    if (end == std::string::npos) fail("')' is missing after '" + text_.substr(at_) + "'");
    const std::string out = trimmed(text_.substr(at_, end - at_));
    at_ = end;
    return out;
  }
  double number()
  {
    skipBlanks();
    double v = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), v);
    if (error != std::errc{} || !std::isfinite(v)) fail("'" + rest() + "' is no number");
    at_ = static_cast<std::size_t>(end - text_.data());
    return v;
  }

 private:
  void skipBlanks()
  {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

void readCell(Reader& in, Term& term)
{
  const std::string part = in.upTo(",)");
  const auto equals = part.find('=');
  const std::string axis = trimmed(part.substr(0, equals));
  if (equals == std::string::npos || axis.empty() || equals + 1 >= part.size())
    fail("'" + part + "' is no axis=value");
  if (!term.cell.emplace(axis, trimmed(part.substr(equals + 1))).second)
    fail("axis " + axis + " comes twice");
}

Term readTerm(Reader& in)
{
  Term out;
  out.metric = in.name();
  in.expect("(");
  out.method = in.upTo(",)");
  if (out.method.empty()) fail(out.metric + "() has no method");
  while (in.take(",")) readCell(in, out);
  in.expect(")");
  return out;
}

std::vector<Term> readSum(Reader& in)
{
  std::vector<Term> out = {readTerm(in)};
  for (;;)
  {
    const bool isTakenAway = in.take("-");
    if (!isTakenAway && !in.take("+")) return out;
    out.push_back(readTerm(in));
    out.back().isTakenAway = isTakenAway;
  }
}

/// A sum, in brackets if something is divided.
std::vector<Term> readSide(Reader& in, bool& hasBrackets)
{
  hasBrackets = in.take("(");
  auto out = readSum(in);
  if (hasBrackets) in.expect(")");
  return out;
}

void needBrackets(const std::vector<Term>& sum, bool hasBrackets)
{
  if (sum.size() > 1 && !hasBrackets) fail("a sum that is divided needs brackets");
}

void readPublished(Reader& in, Bound::Kind kind, Bound& bound)
{
  bound.kind = kind;
  bound.published = in.number();
  if (in.take("+-"))
  {
    bound.deviation = in.number();
    if (*bound.deviation <= 0) fail("the deviation is not positive");
    return;
  }
  if (!in.take("of")) fail("neither '+- deviation' nor 'of N runs' follows the published value");
  const double runs = in.number();
  if (runs < 1 || runs != std::floor(runs) || runs > 1e6) fail("'of N runs' needs a whole number");
  bound.runs = static_cast<int>(runs);
  in.expect("runs");
}

Bound readBound(Reader& in)
{
  Bound out;
  if (in.take("<="))
    readPublished(in, Bound::Kind::kAtMostPublished, out);
  else if (in.take(">="))
    readPublished(in, Bound::Kind::kAtLeastPublished, out);
  else if (in.take("="))
    readPublished(in, Bound::Kind::kAsPublished, out);
  else if (in.take("<"))
    out.kind = Bound::Kind::kBelow, out.high = in.number();
  else if (in.take(">"))
    out.kind = Bound::Kind::kAbove, out.low = in.number();
  else if (in.take("in"))
  {
    out.kind = Bound::Kind::kBetween;
    out.low = in.number();
    in.expect("..");
    out.high = in.number();
    if (out.low >= out.high) fail("the bounds are not in rising order");
  }
  else
    fail("'" + in.rest() + "' is no bound");
  return out;
}
}  // namespace

Condition parseCondition(const std::string& text)
{
  Condition out;
  out.text = text;
  Reader in(out.text);
  bool hasBrackets = false;
  out.sum = readSide(in, hasBrackets);
  if (in.take("/"))
  {
    needBrackets(out.sum, hasBrackets);
    out.divisor = readSide(in, hasBrackets);
    needBrackets(out.divisor, hasBrackets);
  }
  out.bound = readBound(in);
  if (!in.atEnd()) fail("'" + in.rest() + "' follows what is a whole condition");
  return out;
}
}  // namespace slamot::reproduce
