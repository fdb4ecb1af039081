#include <slamot/core/Error.h>
#include <slamot/fusion/Message.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <cstring>

namespace slamot::fusion
{
namespace
{
using core::RobotAndTarget;

constexpr std::uint8_t kMagic[4] = {'S', 'L', 'T', 'M'};
constexpr std::uint16_t kVersion = 1;
constexpr std::size_t kHeader = 76, kCandidate = 36, kChecksum = 4;

/// Appends numbers, little endian.
class Writer
{
 public:
  explicit Writer(Bytes& out) : out_(out) {}

  template <class T>
  void put(T value)  // unsigned
  {
    for (std::size_t i = 0; i < sizeof value; ++i)
      out_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
  void putInt(int value) { put(static_cast<std::uint32_t>(value)); }
  void putDouble(double value)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    put(bits);
  }

 private:
  Bytes& out_;
};

/// Takes numbers from the front; that there are enough is known before.
class Reader
{
 public:
  Reader(const Bytes& in, std::size_t at) : in_(in), at_(at) {}

  template <class T>
  T get()
  {
    T value = 0;
    for (std::size_t i = 0; i < sizeof value; ++i)
      value = static_cast<T>(value | static_cast<T>(static_cast<T>(in_[at_++]) << (8 * i)));
    return value;
  }
  int getInt() { return static_cast<int>(get<std::uint32_t>()); }
  double getDouble()
  {
    const auto bits = get<std::uint64_t>();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  std::string getText(std::size_t length)
  {
    const auto begin = in_.begin() + static_cast<std::ptrdiff_t>(at_);
    const auto end = begin + static_cast<std::ptrdiff_t>(length);
    at_ += length;
    return {begin, std::find(begin, end, 0)};
  }

 private:
  const Bytes& in_;
  std::size_t at_;
};

bool possible(int coordinates, int candidates)
{
  return (coordinates == 3 || coordinates == 7 || coordinates == 9) && candidates >= 0 &&
         candidates <= kMaxCandidates;
}

bool contradictory(const RobotAndTarget& e)
{
  return (e.target == core::kNoId) != (e.targetSize() == 0);
}

void check(const Message& m)
{
  const auto fail = [](const char* what)
  { throw core::Error(core::ExitStatus::kConfig, "team message", what); };
  const RobotAndTarget& e = m.estimate;
  if (!possible(static_cast<int>(e.mean.size()), static_cast<int>(m.candidates.size())))
    fail("not 3, 7 or 9 coordinates, or too many candidates");
  if (e.cov.rows() != e.mean.size() || e.cov.cols() != e.mean.size())
    fail("mean and covariance differ in size");
  if (contradictory(e)) fail("a target without coordinates, or coordinates without a target");
  if (m.frame.size() > kMaxFrameLength || m.frame.find('\0') != std::string::npos)
    fail("the frame's name has more than 32 characters, or a zero");
}

void putEstimate(Writer& w, const RobotAndTarget& e)
{
  for (const double x : e.mean) w.putDouble(x);
  for (Eigen::Index r = 0; r < e.cov.rows(); ++r)
    for (Eigen::Index c = 0; c <= r; ++c) w.putDouble(e.cov(r, c));
}

void getEstimate(Reader& r, int coordinates, RobotAndTarget& e)
{
  e.mean.resize(coordinates);
  e.cov.resize(coordinates, coordinates);
  for (double& x : e.mean) x = r.getDouble();
  for (int i = 0; i < coordinates; ++i)
    for (int k = 0; k <= i; ++k) e.cov(i, k) = e.cov(k, i) = r.getDouble();
}
}  // namespace

std::size_t encodedSize(int coordinates, int candidates)
{
  const auto n = static_cast<std::size_t>(coordinates), c = static_cast<std::size_t>(candidates);
  return kHeader + 8 * (n + n * (n + 1) / 2) + kCandidate * c + kChecksum;
}

std::uint32_t checksum(const Bytes& bytes)
{
  boost::crc_32_type crc;
  if (bytes.size() > kChecksum) crc.process_bytes(bytes.data(), bytes.size() - kChecksum);
  return crc.checksum();
}

Bytes encode(const Message& m)
{
  check(m);
  Bytes out(std::begin(kMagic), std::end(kMagic));
  Writer w(out);
  w.put(kVersion);
  w.put(static_cast<std::uint8_t>(m.estimate.mean.size()));
  w.put(static_cast<std::uint8_t>(m.candidates.size()));
  w.putInt(m.sender);
  w.putInt(m.receiver);
  w.put(m.session);
  w.put(m.sequence);
  w.putDouble(m.estimate.time);
  out.insert(out.end(), m.frame.begin(), m.frame.end());
  out.resize(out.size() + kMaxFrameLength - m.frame.size());
  w.putInt(m.estimate.target);
  putEstimate(w, m.estimate);
  for (const Candidate& c : m.candidates)
  {
    for (const double x : {c.range, c.bearing, c.rangeStd, c.bearingStd}) w.putDouble(x);
    w.putInt(c.id);
  }
  out.resize(out.size() + kChecksum);
  const std::uint32_t sum = checksum(out);
  out.resize(out.size() - kChecksum);
  w.put(sum);
  return out;
}

std::variant<Message, Outcome> decode(const Bytes& bytes)
{
  if (bytes.size() < kHeader + kChecksum) return Outcome::kWrongLength;
  if (!std::equal(std::begin(kMagic), std::end(kMagic), bytes.begin()))
    return Outcome::kWrongVersion;
  Reader r(bytes, sizeof kMagic);
  if (r.get<std::uint16_t>() != kVersion) return Outcome::kWrongVersion;
  const int coordinates = r.get<std::uint8_t>(), candidates = r.get<std::uint8_t>();
  if (!possible(coordinates, candidates) || bytes.size() != encodedSize(coordinates, candidates))
    return Outcome::kWrongLength;
  if (Reader(bytes, bytes.size() - kChecksum).get<std::uint32_t>() != checksum(bytes))
    return Outcome::kWrongChecksum;

  Message m;
  m.sender = r.getInt();
  m.receiver = r.getInt();
  m.session = r.get<std::uint64_t>();
  m.sequence = r.get<std::uint64_t>();
  m.estimate.time = r.getDouble();
  m.frame = r.getText(kMaxFrameLength);
  m.estimate.target = r.getInt();
  getEstimate(r, coordinates, m.estimate);
  if (contradictory(m.estimate)) return Outcome::kContradictory;
  m.candidates.resize(static_cast<std::size_t>(candidates));
  for (Candidate& c : m.candidates)
  {
    for (double* x : {&c.range, &c.bearing, &c.rangeStd, &c.bearingStd}) *x = r.getDouble();
    c.id = r.getInt();
  }
  return m;
}
}  // namespace slamot::fusion
