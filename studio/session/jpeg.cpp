#include "studio/session/jpeg.hpp"

#include <memory>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>
#include <turbojpeg.h>

namespace maggic::studio {
namespace {

constexpr int kQuality = 80;

struct Destroy {
  void operator()(void* compressor) const { tjDestroy(compressor); }
};

struct Free {
  void operator()(unsigned char* bytes) const { tjFree(bytes); }
};

}  // namespace

std::vector<std::uint8_t> jpeg_of(const cv::Mat& bgr) {
  const std::unique_ptr<std::remove_pointer_t<tjhandle>, Destroy> compressor(tjInitCompress());
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const int failed =
      compressor ? tjCompress2(compressor.get(), bgr.data, bgr.cols, static_cast<int>(bgr.step),
                               bgr.rows, TJPF_BGR, &bytes, &size, TJSAMP_420, kQuality, 0)
                 : -1;
  const std::unique_ptr<unsigned char, Free> owner(bytes);
  if (failed != 0) {
    throw std::runtime_error(fmt::format("a picture of {}×{} cannot be a JPEG: {}", bgr.cols,
                                         bgr.rows, tjGetErrorStr2(compressor.get())));
  }
  return {bytes, bytes + size};
}

}  // namespace maggic::studio
