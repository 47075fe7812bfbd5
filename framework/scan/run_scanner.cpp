#include "maggic/run_scanner.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>

#include "scan/background_gate.hpp"
#include "scan/band_workers.hpp"
#include "scan/row_kernels.hpp"
#include "scan/run_buffer.hpp"

namespace maggic {
namespace {

constexpr int kLargestSide = 65535;

std::size_t pixels_in(const ScanArea& area) {
  return std::accumulate(area.begin(), area.end(), std::size_t{0},
                         [](std::size_t sum, const RowSpan& span) {
                           return sum + static_cast<std::size_t>(span.end - span.begin);
                         });
}

}  // namespace

class RunScanner::Bands {
 public:
  explicit Bands(unsigned threads) : workers_(threads), bands_(threads) {}

  void set_table(const ColorTable& table) {
    gate_.emplace(table);
    look_up_.block_ids = table.block_ids().data();
    look_up_.block_labels = table.block_labels().data();
    look_up_.first_colored_spread = gate_->helps() ? gate_->first_colored_spread().data() : nullptr;
  }

  void scan(const PictureRows& bgr, const ScanArea& area, const ChannelGains* gains,
            std::vector<Run>& runs) {
    ColorLookUp look_up = look_up_;
    look_up.gains_q12 = gains != nullptr ? gains->factors_q12().data() : nullptr;
    share(area, runs, [&](std::span<const RowSpan> spans, RunBuffer& found) {
      scan_colors(bgr, spans, look_up, found);
    });
  }

  void scan_labels(const PictureRows& labels, const ScanArea& area, std::vector<Run>& runs) {
    share(area, runs, [&](std::span<const RowSpan> spans, RunBuffer& found) {
      maggic::scan_labels(labels, spans, found);
    });
  }

 private:
  struct Band {
    std::span<const RowSpan> area;
    RunBuffer runs;
  };

  template <class ScanSpans>
  void share(const ScanArea& area, std::vector<Run>& runs, const ScanSpans& scan_spans) {
    divide(area);
    auto work = [&](std::size_t band) {
      bands_[band].runs.clear();
      scan_spans(bands_[band].area, bands_[band].runs);
    };
    workers_.run(work);
    runs.clear();
    for (const Band& band : bands_) {
      runs.insert(runs.end(), band.runs.runs().begin(), band.runs.runs().end());
    }
  }

  // Bands of about as many pixels each. No span is cut, so no run is.
  void divide(const ScanArea& area) {
    if (bands_.size() == 1) {
      bands_.front().area = area;
      return;
    }
    const std::size_t pixels = pixels_in(area);
    std::size_t next = 0;
    std::size_t taken = 0;
    for (std::size_t band = 0; band < bands_.size(); ++band) {
      const std::size_t first = next;
      const std::size_t wanted = pixels * (band + 1) / bands_.size();
      for (; next < area.size() && taken < wanted; ++next) {
        taken += static_cast<std::size_t>(area[next].end - area[next].begin);
      }
      bands_[band].area = std::span(area).subspan(first, next - first);
    }
  }

  BandWorkers workers_;
  std::vector<Band> bands_;
  std::optional<BackgroundGate> gate_;
  ColorLookUp look_up_;
};

RunScanner::RunScanner(unsigned threads) : bands_(std::make_unique<Bands>(std::max(1U, threads))) {}
RunScanner::~RunScanner() = default;

void RunScanner::set_table(const ColorTable& table) { bands_->set_table(table); }

void RunScanner::scan(const cv::Mat& bgr, const ScanArea& area, const ChannelGains* gains,
                      std::vector<Run>& runs) {
  CV_Assert(bgr.type() == CV_8UC3 && bgr.cols <= kLargestSide && bgr.rows <= kLargestSide);
  bands_->scan({bgr.data, bgr.step}, area, gains, runs);
}

void RunScanner::scan_labels(const cv::Mat& labels, const ScanArea& area, std::vector<Run>& runs) {
  CV_Assert(labels.type() == CV_8UC1 && labels.cols <= kLargestSide && labels.rows <= kLargestSide);
  bands_->scan_labels({labels.data, labels.step}, area, runs);
}

void draw_runs(const std::vector<Run>& runs, cv::Size size, cv::Mat& labels) {
  labels.create(size, CV_8UC1);
  labels.setTo(kBackground);
  for (const Run& run : runs) {
    std::fill(labels.ptr(run.row) + run.begin, labels.ptr(run.row) + run.end, run.label);
  }
}

}  // namespace maggic
