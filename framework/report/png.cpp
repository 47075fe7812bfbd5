#include "maggic/png.hpp"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <zlib.h>

namespace maggic {
namespace {

using Byte = std::uint8_t;
constexpr std::size_t kChannels = 3;

void append_u32(std::string& out, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) out += static_cast<char>(value >> shift & 0xFF);
}

void append_chunk(std::string& out, std::string_view type, std::string_view data) {
  append_u32(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t start = out.size();
  out.append(type).append(data);
  const auto* bytes = reinterpret_cast<const Bytef*>(out.data() + start);
  append_u32(out, static_cast<std::uint32_t>(
                      crc32(crc32(0, nullptr, 0), bytes, static_cast<uInt>(out.size() - start))));
}

Byte paeth(int left, int up, int corner) {
  const int guess = left + up - corner;
  const int to_left = std::abs(guess - left);
  const int to_up = std::abs(guess - up);
  const int to_corner = std::abs(guess - corner);
  if (to_left <= to_up && to_left <= to_corner) return static_cast<Byte>(left);
  return static_cast<Byte>(to_up <= to_corner ? up : corner);
}

/// PNG's row filters of use here, by their number.
enum Filter : Byte { kNone = 0, kSub = 1, kUp = 2, kPaeth = 4 };

Byte predicted(Filter filter, const std::vector<Byte>& row, const std::vector<Byte>& above,
               std::size_t i) {
  const Byte left = i < kChannels ? Byte{0} : row[i - kChannels];
  switch (filter) {
    case kNone: return 0;
    case kSub: return left;
    case kUp: return above[i];
    case kPaeth: return paeth(left, above[i], i < kChannels ? Byte{0} : above[i - kChannels]);
  }
  return 0;
}

/// Appends the row under the filter that leaves the smallest numbers, which compress best.
void append_filtered(const std::vector<Byte>& row, const std::vector<Byte>& above,
                     std::string& out) {
  std::string best;
  long best_sum = -1;
  std::string filtered(row.size(), '\0');
  for (const Filter filter : {kNone, kSub, kUp, kPaeth}) {
    long sum = 0;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const auto rest = static_cast<Byte>(row[i] - predicted(filter, row, above, i));
      filtered[i] = static_cast<char>(rest);
      sum += std::abs(static_cast<std::int8_t>(rest));
    }
    if (best_sum >= 0 && sum >= best_sum) continue;
    best_sum = sum;
    best = static_cast<char>(filter) + filtered;
  }
  out += best;
}

std::string deflated(const std::string& data) {
  std::string out(compressBound(static_cast<uLong>(data.size())), '\0');
  auto size = static_cast<uLongf>(out.size());
  const int result =
      compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                reinterpret_cast<const Bytef*>(data.data()), static_cast<uLong>(data.size()), 6);
  if (result != Z_OK) throw std::runtime_error("a picture could not be compressed");
  out.resize(size);
  return out;
}

}  // namespace

std::string png_bytes(const cv::Mat& bgr) {
  if (bgr.empty() || bgr.type() != CV_8UC3) {
    throw std::invalid_argument("a PNG needs a picture of 8 bit and three channels");
  }
  std::vector<Byte> row(static_cast<std::size_t>(bgr.cols) * kChannels);
  std::vector<Byte> above(row.size(), 0);
  std::string filtered;
  filtered.reserve((row.size() + 1) * static_cast<std::size_t>(bgr.rows));
  for (int y = 0; y < bgr.rows; ++y) {
    const Byte* pixels = bgr.ptr(y);
    for (std::size_t i = 0; i < row.size(); i += kChannels) {
      row[i] = pixels[i + 2];
      row[i + 1] = pixels[i + 1];
      row[i + 2] = pixels[i];
    }
    append_filtered(row, above, filtered);
    std::swap(row, above);
  }

  std::string header;
  append_u32(header, static_cast<std::uint32_t>(bgr.cols));
  append_u32(header, static_cast<std::uint32_t>(bgr.rows));
  constexpr std::array<char, 5> kEightBitRgb{8, 2, 0, 0, 0};
  header.append(kEightBitRgb.data(), kEightBitRgb.size());
  std::string png("\x89PNG\r\n\x1a\n");
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", deflated(filtered));
  append_chunk(png, "IEND", "");
  return png;
}

}  // namespace maggic
