// What of a landmark map goes in and out: options, streams, tables, pictures.
#include "Mesh.h"
#include "saveWhole.h"

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/serialization/CArchive.h>
#include <slamot/mrpt/CLandmarkGaussianMap.h>

#include <array>
#include <charconv>
#include <fstream>
#include <limits>
#include <locale>
#include <stdexcept>

#include SLAMOT_VIZ(CText3D.h)

namespace slamot::maps
{
namespace
{
using Archive = ::mrpt::serialization::CArchive;
using Landmark = CLandmarkGaussianMap::Landmark;
using Options = CLandmarkGaussianMap::TInsertionOptions;

constexpr const char *kGate = "gate_probability", *kRange = "range_std_m",
                     *kBearing = "bearing_std_deg";
constexpr double kRim = 0.02;         // [m], of an ellipse
constexpr float kLabelHeight = 0.2f;  // [m]

// MRPT's own reader takes `abc` as 0 and `0.5x` as 0.5.
double readNumber(const ::mrpt::config::CConfigFileBase& source, const std::string& section,
                  const char* key, double otherwise, double below)
{
  if (!source.keyExists(section, key)) return otherwise;
  const std::string text = source.read_string(section, key, "", true);
  double value = 0;
  const auto end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || !(value > 0 && value < below))
    throw core::Error(core::ExitStatus::kConfig, "[" + section + "] " + key,
                      "'" + text + "' is not a number above 0 and below " +
                          std::to_string(static_cast<long>(below)),
                      "mend it");
  return value;
}

// All digits, and a point in every locale: MRPT's own text has neither.
std::string shortest(double value)
{
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

void write(Archive& out, const Landmark& m)
{
  const Matrix2& P = m.position.cov;
  out << m.id << m.sightings;
  for (const double v :
       {m.position.mean.x, m.position.mean.y, P(0, 0), P(0, 1), P(1, 1), m.existence})
    out << v;
}

// MRPT's own reader of these flags puts any byte into a bool.
bool readFlag(Archive& in)
{
  std::uint8_t byte = 0;
  in >> byte;
  if (byte > 1) throw std::runtime_error("CLandmarkGaussianMap: a flag that is neither 0 nor 1");
  return byte == 1;
}

Landmark readLandmark(Archive& in)
{
  Landmark m;
  Matrix2& P = m.position.cov;
  in >> m.id >> m.sightings;
  for (double* v :
       {&m.position.mean.x, &m.position.mean.y, &P(0, 0), &P(0, 1), &P(1, 1), &m.existence})
    in >> *v;
  P(1, 0) = P(0, 1);
  return m;
}
}  // namespace

void Options::loadFromConfigFile(const ::mrpt::config::CConfigFileBase& source,
                                 const std::string& section)
{
  std::vector<std::string> keys;
  if (source.sectionExists(section)) source.getAllKeys(section, keys);
  for (const std::string& key : keys)
    if (key != kGate && key != kRange && key != kBearing)
      throw core::Error(core::ExitStatus::kConfig, "[" + section + "] " + key, "unknown key",
                        std::string("known are ") + kGate + ", " + kRange + " and " + kBearing);
  const double gate = readNumber(source, section, kGate, gateProbability, 1);
  const double range = readNumber(source, section, kRange, rangeStd, 1000);
  const double bearing = readNumber(source, section, kBearing, math::radToDeg(bearingStd), 180);
  gateProbability = gate, rangeStd = range, bearingStd = math::degToRad(bearing);
}

void Options::saveToConfigFile(::mrpt::config::CConfigFileBase& target,
                               const std::string& section) const
{
  const auto save = [&](const char* key, double value, const char* comment)
  { target.write(section, key, shortest(value), -1, -1, comment); };
  save(kGate, gateProbability, "chance that a true pair is kept");
  save(kRange, rangeStd, "[m], of observations without any");
  save(kBearing, math::radToDeg(bearingStd), "[deg], likewise");
}

std::uint8_t CLandmarkGaussianMap::serializeGetVersion() const
{
  return 0;
}

void CLandmarkGaussianMap::serializeTo(Archive& out) const
{
  if (landmarks_.size() > kMostLandmarks)
    throw std::runtime_error("CLandmarkGaussianMap: too many landmarks to write");
  const auto& g = genericMapParams;
  for (const bool flag :
       {g.enableSaveAs3DObject, g.enableObservationLikelihood, g.enableObservationInsertion})
    out.WriteAs<std::uint8_t>(flag);
  out << insertionOptions.gateProbability << insertionOptions.rangeStd
      << insertionOptions.bearingStd;
  out.WriteAs<std::uint32_t>(landmarks_.size());
  for (const Landmark& m : landmarks_) write(out, m);
}

void CLandmarkGaussianMap::serializeFrom(Archive& in, std::uint8_t version)
{
  if (version != 0) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
  CLandmarkGaussianMap map;
  auto& g = map.genericMapParams;
  for (bool* flag :
       {&g.enableSaveAs3DObject, &g.enableObservationLikelihood, &g.enableObservationInsertion})
    *flag = readFlag(in);
  Options& options = map.insertionOptions;
  in >> options.gateProbability >> options.rangeStd >> options.bearingStd;
  if (!(options.gateProbability > 0 && options.gateProbability < 1 && options.rangeStd > 0 &&
        options.bearingStd > 0))
    throw std::runtime_error("CLandmarkGaussianMap: options out of range");
  std::uint32_t n = 0;
  in >> n;
  if (n > kMostLandmarks)
    throw std::runtime_error("CLandmarkGaussianMap: " + std::to_string(n) + " landmarks");
  // Nothing is reserved for the count: the bytes may be damaged.
  for (std::uint32_t i = 0; i < n; ++i)
  {
    const Landmark m = readLandmark(in);
    if (!map.isEmpty() && m.id <= map.landmarks_.back().id)
      throw std::runtime_error("CLandmarkGaussianMap: ids out of order");
    map.set(m);
  }
  genericMapParams = g;
  insertionOptions = options;
  landmarks_ = std::move(map.landmarks_);
}

void CLandmarkGaussianMap::saveMetricMapRepresentationToFile(const std::string& prefix) const
{
  const auto save = [this](const std::string& path)
  {
    std::ofstream out(path);
    out.imbue(std::locale::classic());
    out.precision(std::numeric_limits<double>::max_digits10);
    out << "id,x,y,cxx,cxy,cyy,sightings,existence\n";
    for (const Landmark& m : landmarks_)
      out << m.id << ',' << m.position.mean.x << ',' << m.position.mean.y << ','
          << m.position.cov(0, 0) << ',' << m.position.cov(0, 1) << ',' << m.position.cov(1, 1)
          << ',' << m.sightings << ',' << m.existence << '\n';
    out.close();
    return out.good();
  };
  slamot::mrpt::saveWhole(prefix + "_landmarks.csv", save);
}

void CLandmarkGaussianMap::getVisualizationInto(slamot_viz::CSetOfObjects& o) const
{
  if (!genericMapParams.enableSaveAs3DObject || isEmpty()) return;
  slamot::mrpt::Mesh ellipses({0x1f, 0x6f, 0xc4});
  for (const Landmark& m : landmarks_)
  {
    ellipses.ellipse(m.position, kRim, 0);
    auto label = slamot_viz::CText3D::Create(std::to_string(m.id), "sans", kLabelHeight);
    label->setColor_u8(0x24, 0x29, 0x2f);
    label->setLocation(m.position.mean.x, m.position.mean.y, 0.1);
    o.insert(label);
  }
  o.insert(ellipses.object("landmark ellipses, 95%"));
}
}  // namespace slamot::maps
