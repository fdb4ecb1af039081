#include "objectLayout.h"

#include "jpegSize.h"

#include <slamot/mrpt/CObservationColorBlobs.h>

#include <algorithm>
#include <initializer_list>
#include <map>

// The layouts are those that MRPT 1.x to 2.5 wrote; found from files, and checked in the tests
// against what MRPT writes; images as 2.5 writes them.
namespace slamot::mrpt
{
namespace
{
constexpr std::uint32_t kMostSightings = 100000;
constexpr std::uint32_t kMostBeams = 1000000;
constexpr std::uint32_t kMostParticles = 100000;
constexpr std::uint32_t kMostModes = 1000;
constexpr std::uint32_t kMostMatrixRows = 1000;
constexpr std::int64_t kMostPixels = 64 << 20;
constexpr std::uint32_t kMostLensModels = 2, kMostDepths = 6;  // MRPT's and OpenCV's enums
constexpr std::uint32_t kLongestText = 4u << 20;               // [byte]

constexpr std::size_t kFloat = 4, kDouble = 8, kTime = 8;

using Layout = void (*)(ByteCursor&, const ObjectHeader&);

std::string shortName(const std::string& name)
{
  const auto colon = name.rfind(':');
  return colon == std::string::npos ? name : name.substr(colon + 1);
}

void walkNested(ByteCursor& c, std::initializer_list<const char*> classes);

void walkPose2D(ByteCursor& c, const ObjectHeader& h)
{
  requireVersion(c, h, 0, 1);
  c.skip(3 * (h.version == 0 ? kFloat : kDouble));
}

void walkMatrix(ByteCursor& c, const ObjectHeader& h)
{
  requireVersion(c, h, 0, 0);
  const std::size_t rows = c.count(kMostMatrixRows, 0, "matrix rows");
  const std::size_t columns = c.count(kMostMatrixRows, 0, "matrix columns");
  c.skip(rows * columns * (shortName(h.name) == "CMatrixD" ? kDouble : kFloat));
}

void walkPose3D(ByteCursor& c, const ObjectHeader& h)
{
  requireVersion(c, h, 0, 3);
  if (h.version <= 1)
    walkNested(c, {"CMatrixD", "CMatrixF", "CMatrix"});
  else
    c.skip(kDouble * (h.version == 2 ? 7 : 12));
}

void walkGaussian(ByteCursor& c, const ObjectHeader& h)
{
  requireVersion(c, h, 0, 2);
  walkNested(c, {"CPose2D"});
  if (h.version == 0)
    walkNested(c, {"CMatrixF", "CMatrixD", "CMatrix"});
  else
    c.skip(6 * (h.version == 1 ? kFloat : kDouble));
}

void walkGaussianInf(ByteCursor& c, const ObjectHeader& h)
{
  requireVersion(c, h, 0, 0);
  c.skip(9 * kDouble);
}

void walkParticles(ByteCursor& c, const ObjectHeader& h)
{
  requireVersion(c, h, 1, 1);
  const auto n = c.count(kMostParticles, 4 * kDouble, "particles");
  if (n == 0) c.damage("a movement of no particles");
  c.skip(4 * kDouble * n);
}

void walkModes(ByteCursor& c, const ObjectHeader& h)
{
  requireVersion(c, h, 2, 2);
  const auto n = c.count(kMostModes, 7 * kDouble, "Gaussian modes");
  if (n == 0) c.damage("a movement of no Gaussian modes");
  for (std::uint32_t i = 0; i < n; ++i)
  {
    c.skip(kDouble);
    walkNested(c, {"CPose2D"});
    c.skip(6 * kDouble);
  }
}

void walkMotionModel(ByteCursor& c, int version)
{
  walkNested(c, {"CPose2D"});
  if (c.read<std::uint32_t>() > 1) c.damage("an unknown motion model");
  c.skip(6 * kFloat);
  (void)c.count(kMostParticles, 0, "particles of the motion model");
  c.skip(kFloat * (version >= 5 ? 6 : 4));
}

void walkMovement(ByteCursor& c, const ObjectHeader& h)
{
  requireVersion(c, h, 4, 7);
  const auto method = c.read<std::uint32_t>();
  if (method > 1) c.damage("an unknown way of estimating movement");
  if (method == 0)
    walkMotionModel(c, h.version);
  else
    walkNested(c, {"CPosePDFGaussian", "CPosePDFGaussianInf", "CPosePDFParticles", "CPosePDFSOG"});
  const bool hasVelocities = c.flag();
  if (h.version < 7)
    c.skip(2 * kFloat);
  else if (hasVelocities)
    c.skip(3 * kDouble);
  if (c.flag() || h.version < 7) c.skip(2 * sizeof(std::int32_t));
  if (h.version >= 6) c.skip(kTime);
}

void walkOdometry(ByteCursor& c, const ObjectHeader& h)
{
  requireVersion(c, h, 0, 2);
  walkNested(c, {"CPose2D"});
  c.text(kLongestText, "bytes of sensor label");
  c.skip(kTime);
  if (h.version == 0) return;
  if (c.flag() || h.version < 2) c.skip(2 * sizeof(std::int32_t));
  const bool hasVelocities = c.flag();
  if (h.version < 2)
    c.skip(2 * kFloat);
  else if (hasVelocities)
    c.skip(3 * kDouble);
}

void walkBearingRange(ByteCursor& c, const ObjectHeader& h)
{
  requireVersion(c, h, 0, 3);
  c.skip(kFloat * (h.version >= 3 ? 4 : 3));
  walkNested(c, {"CPose3D"});
  if (h.version >= 2) c.skip(kTime);
  bool covariances = false;
  if (h.version >= 3)
  {
    covariances = c.flag();
    if (!covariances) c.skip(3 * kFloat);
  }
  const auto n = c.count(kMostSightings, 4 * kFloat, "landmark sightings");
  for (std::uint32_t i = 0; i < n; ++i)
  {
    c.skip(4 * kFloat);
    if (covariances) walkNested(c, {"CMatrixD"});
  }
  if (h.version >= 1) c.text(kLongestText, "bytes of sensor label");
}

void walkScan(ByteCursor& c, const ObjectHeader& h)
{
  requireVersion(c, h, 0, 7);
  c.skip(kFloat);
  (void)c.flag();
  c.skip(kFloat);
  walkNested(c, {"CPose3D"});
  if (h.version < 6) walkNested(c, {"CMatrixF", "CMatrixD", "CMatrix"});
  const std::size_t beam = h.version == 0 ? kFloat : kFloat + 1;
  const auto n = c.count(kMostBeams, beam, "laser beams");
  c.skip(n * beam);
  if (h.version >= 2) c.skip(kFloat);
  if (h.version >= 3) c.skip(kTime);
  if (h.version >= 4) c.skip(kFloat);
  if (h.version >= 5)
  {
    c.text(kLongestText, "bytes of sensor label");
    c.skip(kDouble);
  }
  if (h.version >= 7 && c.flag()) c.skip(n * sizeof(std::int32_t));
}

void walkComment(ByteCursor& c, const ObjectHeader& h)
{
  requireVersion(c, h, 0, 0);
  c.text(kLongestText, "bytes of comment");
  c.skip(kTime);
}

void walkBlobs(ByteCursor& c, const ObjectHeader& h)
{
  using Blobs = obs::CObservationColorBlobs;
  requireVersion(c, h, 0, 1);
  c.skip(kTime);
  c.text(Blobs::kLongestLabel, "bytes of sensor label");
  walkNested(c, {"CPose3D"});
  c.skip(6 * kDouble);
  const auto n = c.count(Blobs::kMostBlobs, 11 * kDouble + 9, "blobs");
  for (std::uint32_t i = 0; i < n; ++i)
  {
    c.text(Blobs::kLongestLabel, "bytes of blob label");
    c.skip(sizeof(std::int32_t) + 11 * kDouble);
    if (c.flag()) c.skip(2 * kDouble);
    if (h.version >= 1) (void)c.flag();
  }
}

void walkCamera(ByteCursor& c, const ObjectHeader& h)
{
  requireVersion(c, h, 6, 6);
  c.skip(13 * kDouble + 2 * sizeof(std::uint32_t));
  c.text(kLongestText, "bytes of camera name");
  if (c.read<std::uint8_t>() > kMostLensModels) c.damage("an unknown lens");
}

// What MRPT allocates by a file's word: pixels of an image, also of a JPEG inside.
std::size_t pixels(ByteCursor& c, std::int64_t width, std::int64_t height)
{
  if (width < 0 || height < 0 || width > kMostPixels || height > kMostPixels ||
      width * height > kMostPixels)
    c.damage("an image of " + std::to_string(width) + " x " + std::to_string(height) +
             " pixels makes no sense");
  return static_cast<std::size_t>(width * height);
}

void walkColors(ByteCursor& c)
{
  const std::int64_t width = c.read<std::int32_t>(), height = c.read<std::int32_t>();
  if (width < 0 || height < 0)  // MRPT's sign of pixels as they are
  {
    c.skip(3 * pixels(c, -width, -height));
    return;
  }
  (void)pixels(c, width, height);
  const std::uint32_t n = c.count(1u << 30, 1, "bytes of a JPEG");
  const auto size = jpegSize(c.here(), n);
  if (size) (void)pixels(c, size->first, size->second);
  c.skip(n);
}

void walkGrey(ByteCursor& c)
{
  const auto width = c.read<std::uint32_t>(), height = c.read<std::uint32_t>();
  c.skip(sizeof(std::uint32_t));
  const auto bytes = c.read<std::uint32_t>();
  const auto depth = c.read<std::uint32_t>();
  if (c.flag() || depth > kMostDepths) c.damage("an image packed in an unknown way");
  // Eight bits a pixel at least, and sixty-four at most.
  const std::size_t n = pixels(c, width, height);
  if (bytes < n || bytes > 8 * n) c.damage("an image's size and its bytes contradict each other");
  c.skip(bytes);
}

void walkPicture(ByteCursor& c, const ObjectHeader& h)
{
  requireVersion(c, h, 9, 9);
  if (c.flag())
    c.text(kLongestText, "bytes of a file's name");
  else if (c.flag())
    walkColors(c);
  else
    walkGrey(c);
}

void walkImage(ByteCursor& c, const ObjectHeader& h)
{
  requireVersion(c, h, 4, 4);
  walkNested(c, {"CPose3D"});
  walkNested(c, {"TCamera"});
  walkNested(c, {"CImage"});
  c.skip(kTime);
  c.text(kLongestText, "bytes of sensor label");
}

const std::map<std::string, Layout>& leaves()
{
  static const std::map<std::string, Layout> table = {
      {"mrpt::obs::CActionRobotMovement2D", walkMovement},
      {"mrpt::obs::CObservation2DRangeScan", walkScan},
      {"mrpt::obs::CObservationBearingRange", walkBearingRange},
      {"mrpt::obs::CObservationComment", walkComment},
      {"mrpt::obs::CObservationImage", walkImage},
      {"mrpt::obs::CObservationOdometry", walkOdometry},
      {"slamot::obs::CObservationColorBlobs", walkBlobs}};
  return table;
}

Layout nestedLayout(const std::string& name)
{
  static const std::map<std::string, Layout> table = {{"CImage", walkPicture},
                                                      {"CMatrix", walkMatrix},
                                                      {"CMatrixD", walkMatrix},
                                                      {"CMatrixF", walkMatrix},
                                                      {"CPose2D", walkPose2D},
                                                      {"CPose3D", walkPose3D},
                                                      {"CPosePDFGaussian", walkGaussian},
                                                      {"CPosePDFGaussianInf", walkGaussianInf},
                                                      {"CPosePDFParticles", walkParticles},
                                                      {"CPosePDFSOG", walkModes},
                                                      {"TCamera", walkCamera}};
  return table.at(name);
}

// Nesting is no deeper than the layouts call each other: a pose in a PDF in a movement.
void walkNested(ByteCursor& c, std::initializer_list<const char*> classes)
{
  const ByteCursor start = c;
  const ObjectHeader header = readHeader(c);
  const std::string name = shortName(header.name);
  if (std::find(classes.begin(), classes.end(), name) == classes.end())
    start.damage("holds a '" + header.name + "' where a " + *classes.begin() + " should be",
                 "fetch or record the file anew", core::ExitStatus::kUnreadable);
  nestedLayout(name)(c, header);
  requireEndFlag(c, name);
}
}  // namespace

bool hasLayout(const ObjectHeader& header)
{
  return header.id != nullptr && leaves().count(header.id->className) > 0;
}

void walkObject(ByteCursor& cursor, const ObjectHeader& header)
{
  leaves().at(header.id->className)(cursor, header);
  requireEndFlag(cursor, header.id->className);
}

PicturePlace pictureIn(ByteCursor cursor)
{
  (void)readHeader(cursor);
  walkNested(cursor, {"CPose3D"});
  walkNested(cursor, {"TCamera"});
  const std::size_t begin = cursor.at();
  walkNested(cursor, {"CImage"});
  return {begin, cursor.at()};
}

void requireVersion(const ByteCursor& cursor, const ObjectHeader& header, int oldest, int newest)
{
  if (header.version >= oldest && header.version <= newest) return;
  cursor.damage(
      "version " + std::to_string(header.version) + " of " + header.name + " is not known, only " +
          std::to_string(oldest) + " to " + std::to_string(newest),
      "save it anew with rawlog-edit --cut --from-index 0", core::ExitStatus::kUnreadable);
}

void requireEndFlag(ByteCursor& cursor, const std::string& className)
{
  const ByteCursor start = cursor;
  if (cursor.read<std::uint8_t>() != kEndFlag)
    start.damage("a " + className + " does not end where it should",
                 "fetch or record the file anew", core::ExitStatus::kUnreadable);
}
}  // namespace slamot::mrpt
