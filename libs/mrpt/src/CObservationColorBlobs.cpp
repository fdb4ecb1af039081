#include <mrpt/core/initializer.h>
#include <mrpt/math/TPose3D.h>
#include <mrpt/rtti/CObject.h>
#include <mrpt/serialization/CArchive.h>
#include <slamot/mrpt/CObservationColorBlobs.h>

#include <locale>
#include <sstream>
#include <stdexcept>

IMPLEMENTS_SERIALIZABLE(CObservationColorBlobs, CObservation, slamot::obs)

// Runs when a program links this library or loads it as a plugin.
MRPT_INITIALIZER(registerSlamotObservations)
{
  ::mrpt::rtti::registerClass(CLASS_ID(slamot::obs::CObservationColorBlobs));
}

namespace slamot::obs
{
namespace
{
using Archive = ::mrpt::serialization::CArchive;
using Blob = CObservationColorBlobs::Blob;

// Counts are checked before anything is allocated for them: the file may be damaged.
std::uint32_t readCount(Archive& in, std::uint32_t most, const char* what)
{
  const auto n = in.ReadAs<std::uint32_t>();
  if (n > most)
    throw std::runtime_error("CObservationColorBlobs: " + std::to_string(n) + " " + what +
                             ", more than " + std::to_string(most));
  return n;
}

std::string readLabel(Archive& in)
{
  std::string label(readCount(in, CObservationColorBlobs::kLongestLabel, "bytes of label"), '\0');
  if (!label.empty()) in.ReadBuffer(label.data(), label.size());
  return label;
}

void write(Archive& out, const Blob& b)
{
  out << b.label.substr(0, CObservationColorBlobs::kLongestLabel) << b.id;
  for (const double v : {b.centerX, b.centerY, b.boxLeft, b.boxTop, b.boxWidth, b.boxHeight, b.area,
                         b.bearing, b.bearingStd, b.elevation, b.elevationStd})
    out << v;
  out << b.range.has_value();
  if (b.range) out << *b.range << b.rangeStd;
  out << b.cut;
}

Blob readBlob(Archive& in, std::uint8_t version)
{
  Blob b;
  b.label = readLabel(in);
  in >> b.id;
  for (double* v : {&b.centerX, &b.centerY, &b.boxLeft, &b.boxTop, &b.boxWidth, &b.boxHeight,
                    &b.area, &b.bearing, &b.bearingStd, &b.elevation, &b.elevationStd})
    in >> *v;
  if (in.ReadAs<std::uint8_t>() != 0)
  {
    b.range = in.ReadAs<double>();
    in >> b.rangeStd;
  }
  if (version >= 1) b.cut = in.ReadAs<std::uint8_t>() != 0;
  return b;
}

// The same text in every locale.
std::ostringstream classicStream()
{
  std::ostringstream o;
  o.imbue(std::locale::classic());
  return o;
}
}  // namespace

std::uint8_t CObservationColorBlobs::serializeGetVersion() const
{
  return 1;
}

void CObservationColorBlobs::serializeTo(Archive& out) const
{
  if (blobs.size() > kMostBlobs)
    throw std::runtime_error("CObservationColorBlobs: too many blobs to write");
  out << timestamp << sensorLabel << sensorPoseOnRobot;
  out << rangeMin << rangeMax << bearingMin << bearingMax << elevationMin << elevationMax;
  out.WriteAs<std::uint32_t>(blobs.size());
  for (const Blob& b : blobs) write(out, b);
}

void CObservationColorBlobs::serializeFrom(Archive& in, std::uint8_t version)
{
  if (version > 1) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
  in >> timestamp;
  sensorLabel = readLabel(in);
  in >> sensorPoseOnRobot;
  in >> rangeMin >> rangeMax >> bearingMin >> bearingMax >> elevationMin >> elevationMax;
  blobs.clear();
  const std::uint32_t n = readCount(in, kMostBlobs, "blobs");
  for (std::uint32_t i = 0; i < n; ++i) blobs.push_back(readBlob(in, version));
}

void CObservationColorBlobs::getDescriptionAsText(std::ostream& o) const
{
  CObservation::getDescriptionAsText(o);
  std::ostringstream text = classicStream();
  text << "Sensor pose on the robot: " << sensorPoseOnRobot.asString() << "\n"
       << "Sees range " << rangeMin << " to " << rangeMax << " m, bearing " << bearingMin << " to "
       << bearingMax << " rad, elevation " << elevationMin << " to " << elevationMax << " rad\n"
       << "Blobs: " << blobs.size() << "\n";
  for (const Blob& b : blobs)
  {
    text << "  " << b.label;
    if (b.id >= 0) text << " #" << b.id;
    text << ": bearing " << b.bearing << " +- " << b.bearingStd << " rad, elevation " << b.elevation
         << " +- " << b.elevationStd << " rad, range ";
    if (b.range)
      text << *b.range << " +- " << b.rangeStd << " m";
    else
      text << "unknown";
    if (b.boxWidth > 0)
      text << "; centre (" << b.centerX << ", " << b.centerY << ") px, box " << b.boxWidth << " x "
           << b.boxHeight << " px at (" << b.boxLeft << ", " << b.boxTop << "), area " << b.area
           << " px^2" << (b.cut ? ", cut by the image's edge" : "");
    text << "\n";
  }
  o << text.str();
}

std::string CObservationColorBlobs::exportTxtHeader() const
{
  return "BLOBS LABEL ID BEARING_RAD BEARING_STD_RAD ELEVATION_RAD ELEVATION_STD_RAD RANGE_M "
         "RANGE_STD_M CENTER_X_PX CENTER_Y_PX BOX_LEFT_PX BOX_TOP_PX BOX_WIDTH_PX BOX_HEIGHT_PX "
         "AREA_PX2 CUT (from LABEL on again for each blob; RANGE_M nan: not ranged)";
}

std::string CObservationColorBlobs::exportTxtDataRow() const
{
  std::ostringstream row = classicStream();
  row.precision(9);
  row << blobs.size();
  for (const Blob& b : blobs)
  {
    row << " " << (b.label.empty() ? "-" : b.label) << " " << b.id << " " << b.bearing << " "
        << b.bearingStd << " " << b.elevation << " " << b.elevationStd;
    if (b.range)
      row << " " << *b.range << " " << b.rangeStd;
    else
      row << " nan nan";
    for (const double v :
         {b.centerX, b.centerY, b.boxLeft, b.boxTop, b.boxWidth, b.boxHeight, b.area})
      row << " " << v;
    row << " " << b.cut;
  }
  return row.str();
}
}  // namespace slamot::obs
