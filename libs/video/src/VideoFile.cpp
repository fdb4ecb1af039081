#include <slamot/core/Error.h>
#include <slamot/video/VideoFile.h>

#include <filesystem>
#include <fstream>
#include <opencv2/videoio.hpp>

namespace slamot::video
{
namespace
{
namespace fs = std::filesystem;

class Mp4File : public VideoFile
{
 public:
  Mp4File(const std::string& path, const VideoFormat& format)
      : path_(path),
        partial_((path_.parent_path() / ("partial." + path_.filename().string())).string()),
        format_(format)
  {
    // OpenCV would tell of it in lines of its own.
    if (fs::is_directory(path_) || !std::ofstream(partial_)) fail("can't be written");
    writer_.open(partial_, cv::VideoWriter::fourcc('m', 'p', '4', 'v'), format.fps,
                 {format.width, format.height});
    if (!writer_.isOpened()) fail("can't be written: OpenCV has no encoder for it");
  }
  ~Mp4File() override
  {
    writer_.release();
    std::error_code ignored;
    fs::remove(partial_, ignored);
  }
  Mp4File(const Mp4File&) = delete;
  Mp4File& operator=(const Mp4File&) = delete;

  void add(const unsigned char* bgr, std::size_t stride) override
  {
    // OpenCV takes a pointer to what it only reads.
    writer_.write(
        cv::Mat(format_.height, format_.width, CV_8UC3, const_cast<unsigned char*>(bgr), stride));
    ++frames_;
  }

  // The writer tells of no failure, such as a full disk: what was written is looked at.
  void finish() override
  {
    writer_.release();
    cv::VideoCapture written(partial_);
    if (!written.isOpened() ||
        std::llround(written.get(cv::CAP_PROP_FRAME_COUNT)) != static_cast<long long>(frames_))
      fail("can't be written whole");
    written.release();
    std::error_code error;
    fs::rename(partial_, path_, error);
    if (error) fail("can't be written");
  }

 private:
  [[noreturn]] void fail(const std::string& what)
  {
    std::error_code ignored;
    if (!fs::is_directory(partial_)) fs::remove(partial_, ignored);
    throw core::Error(core::ExitStatus::kUnreadable, path_.string(), what,
                      "check the folder and its space");
  }

  fs::path path_;
  std::string partial_;
  VideoFormat format_;
  cv::VideoWriter writer_;
  std::size_t frames_ = 0;
};
}  // namespace
}  // namespace slamot::video

#ifdef __clang__
#pragma clang diagnostic ignored "-Wreturn-type-c-linkage"
#endif
extern "C" std::unique_ptr<slamot::video::VideoFile> slamotOpenVideo(
    const std::string& path, const slamot::video::VideoFormat& format)
{
  return std::make_unique<slamot::video::Mp4File>(path, format);
}
