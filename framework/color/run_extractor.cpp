#include "maggic/run_extractor.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include <opencv2/core.hpp>

namespace maggic {
namespace {

constexpr std::size_t kMaxWidth = 65535;
constexpr std::size_t kWord = sizeof(std::uint64_t);

// The labels of one row, with room for the seal and for a word that begins in it.
using RowLabels = std::array<Label, kMaxWidth + 1 + kWord>;

std::uint64_t load_word(const Label* labels) {
  std::uint64_t word;
  std::memcpy(&word, labels, kWord);
  return word;
}

// Index of the first byte that is not zero.
std::size_t first_byte(std::uint64_t word) {
  const int bits = std::endian::native == std::endian::little ? std::countr_zero(word)
                                                              : std::countl_zero(word);
  return static_cast<std::size_t>(bits) / 8;
}

// Moves on from x while the label is `label`; the seal behind the row ends it.
std::size_t skip(const Label* labels, std::size_t x, Label label) {
  const std::uint64_t repeated = std::uint64_t{label} * 0x0101010101010101U;
  for (;; x += kWord) {
    const std::uint64_t difference = load_word(labels + x) ^ repeated;
    if (difference != 0) return x + first_byte(difference);
  }
}

// Writes behind the row what ends a run, and behind that what ends background.
void seal(RowLabels& labels, std::size_t width) {
  labels[width] = kBackground;
  labels[width + 1] = 1;
}

void append_runs(const RowLabels& labels, std::size_t width, std::size_t row,
                 std::vector<Run>& runs) {
  std::size_t x = 0;
  for (;;) {
    if (labels[x] == kBackground) x = skip(labels.data(), x, kBackground);
    if (x >= width) return;
    const Label label = labels[x];
    // On noise most runs are short: spare them the word.
    std::size_t end = x + 1;
    if (labels[end] == label) end = skip(labels.data(), end, label);
    end = std::min(end, width);
    runs.push_back({static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(x),
                    static_cast<std::uint16_t>(end), label});
    x = end;
    if (x >= width) return;
  }
}

// A pixel is its table index read as 24 bits, lowest byte first, so one load of four bytes does
// where a byte beyond the pixel may be read: everywhere but at the last pixel of the row.
void look_up_row(const std::uint8_t* bgr, std::size_t width, const ColorTable& table,
                 Label* labels) {
  const Label* of_color = table.labels().data();
  std::size_t x = 0;
  if constexpr (std::endian::native == std::endian::little) {
    for (; x + 1 < width; ++x) {
      std::uint32_t pixel;
      std::memcpy(&pixel, bgr + 3 * x, sizeof pixel);
      labels[x] = of_color[pixel & 0xFFFFFFU];
    }
  }
  for (; x < width; ++x) labels[x] = table(bgr[3 * x], bgr[3 * x + 1], bgr[3 * x + 2]);
}

void look_up_row(const std::uint8_t* bgr, std::size_t width, const ColorTable& table,
                 const ChannelMap& map, Label* labels) {
  for (std::size_t x = 0; x < width; ++x) {
    labels[x] = table(map.b[bgr[3 * x]], map.g[bgr[3 * x + 1]], map.r[bgr[3 * x + 2]]);
  }
}

// Fills the labels of each row by `label_row(y, labels)` and appends its runs.
template <class LabelRow>
void extract_rows(cv::Size size, std::vector<Run>& runs, LabelRow label_row) {
  runs.clear();
  const auto width = static_cast<std::size_t>(size.width);
  RowLabels labels;
  for (int y = 0; y < size.height; ++y) {
    label_row(y, labels.data());
    seal(labels, width);
    append_runs(labels, width, static_cast<std::size_t>(y), runs);
  }
}

}  // namespace

void extract_runs(const cv::Mat& bgr, const ColorTable& table, std::vector<Run>& runs) {
  CV_Assert(bgr.type() == CV_8UC3 && bgr.cols <= int{kMaxWidth} && bgr.rows <= int{kMaxWidth});
  extract_rows(bgr.size(), runs, [&](int y, Label* labels) {
    look_up_row(bgr.ptr(y), static_cast<std::size_t>(bgr.cols), table, labels);
  });
}

void extract_runs(const cv::Mat& bgr, const ColorTable& table, const ChannelMap& map,
                  std::vector<Run>& runs) {
  CV_Assert(bgr.type() == CV_8UC3 && bgr.cols <= int{kMaxWidth} && bgr.rows <= int{kMaxWidth});
  extract_rows(bgr.size(), runs, [&](int y, Label* labels) {
    look_up_row(bgr.ptr(y), static_cast<std::size_t>(bgr.cols), table, map, labels);
  });
}

void extract_runs(const cv::Mat& labels, std::vector<Run>& runs) {
  CV_Assert(labels.type() == CV_8UC1 && labels.cols <= int{kMaxWidth} &&
            labels.rows <= int{kMaxWidth});
  extract_rows(labels.size(), runs, [&](int y, Label* row) {
    std::memcpy(row, labels.ptr(y), static_cast<std::size_t>(labels.cols));
  });
}

void draw_runs(const std::vector<Run>& runs, cv::Size size, cv::Mat& labels) {
  labels.create(size, CV_8UC1);
  labels.setTo(kBackground);
  for (const Run& run : runs) {
    std::fill(labels.ptr(run.row) + run.begin, labels.ptr(run.row) + run.end, run.label);
  }
}

}  // namespace maggic
