#include "image_contract.hpp"

#include <array>
#include <thread>

#include <opencv2/core.hpp>

#include "guarded.hpp"

namespace maggic::testing {
namespace {

/// Odd, tiny, narrow and flat ones; some sizes return, as when a stream changes its size.
const std::array kSizes = {cv::Size(1, 1),   cv::Size(7, 1),  cv::Size(1, 7),   cv::Size(2, 2),
                           cv::Size(3, 5),   cv::Size(17, 9), cv::Size(64, 48), cv::Size(65, 33),
                           cv::Size(64, 48), cv::Size(1, 1)};

std::string text_of(cv::Size size) { return fmt::format("{}×{}", size.width, size.height); }

cv::Mat random_picture(cv::Size size, std::size_t seed) {
  cv::Mat picture(size, CV_8UC3);
  cv::RNG random(seed + 1);
  random.fill(picture, cv::RNG::UNIFORM, 0, 256);
  return picture;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  for (int row = 0; row < a.rows; ++row) {
    const std::size_t bytes = a.elemSize() * static_cast<std::size_t>(a.cols);
    if (!std::equal(a.ptr(row), a.ptr(row) + bytes, b.ptr(row))) return false;
  }
  return true;
}

/// One call with padded rows on every side, with every promise about memory checked.
cv::Mat call(const ImageFunction& function, cv::Size size, std::size_t seed, std::uint8_t fill,
             Findings& findings) {
  std::vector<GuardedImage> in_memory;
  std::vector<cv::Mat> in;
  std::vector<cv::Mat> expected_in;
  for (int i = 0; i < function.inputs; ++i) {
    expected_in.push_back(random_picture(size, 2 * seed + static_cast<std::size_t>(i)));
    in_memory.emplace_back(size, CV_8UC3, std::uint8_t{0});
    in.push_back(in_memory.back().view());
    expected_in.back().copyTo(in.back());
  }
  GuardedImage out_memory(size, function.output_type, fill);
  cv::Mat out = out_memory.view();
  const std::uint8_t* const given = out.data;

  function.run(in, out);

  for (std::size_t i = 0; i < in.size(); ++i) {
    if (!in_memory[i].intact() || !same(expected_in[i], in_memory[i].view())) {
      findings.add("a picture of {} was written to its input, expected it to be read only",
                   text_of(size));
    }
  }
  if (!out_memory.intact()) {
    findings.add("a picture of {} was written beyond the ends of its rows", text_of(size));
  }
  if (out.data != given || out.size() != size || out.type() != function.output_type) {
    findings.add("the output of {} was replaced, expected the host's own to be filled",
                 text_of(size));
  }
  return out_memory.view().clone();
}

std::vector<cv::Mat> answers(const ImageFunction& function, std::uint8_t fill, Findings& findings) {
  std::vector<cv::Mat> result;
  for (std::size_t i = 0; i < kSizes.size(); ++i) {
    result.push_back(call(function, kSizes[i], i, fill, findings));
  }
  return result;
}

}  // namespace

void check_image_function(const ImageFunction& first, const ImageFunction& second,
                          Findings& findings) {
  // An image stage may learn from earlier pictures, so both instances see the same sequence. They
  // start from differently filled outputs: a pixel left unwritten shows as a difference.
  std::vector<cv::Mat> here;
  std::vector<cv::Mat> there;
  Findings unused;  // the other instance breaks the same promises about memory
  std::thread other(
      [&] { runs(unused, "", [&] { there = answers(second, std::uint8_t{0x11}, unused); }); });
  runs(findings, "a picture", [&] { here = answers(first, std::uint8_t{0xEE}, findings); });
  other.join();
  if (here.size() != there.size()) {
    findings.add("of two instances on two threads one failed");
    return;
  }
  for (std::size_t i = 0; i < here.size(); ++i) {
    if (!same(here[i], there[i])) {
      findings.add(
          "two instances on two threads disagree on a picture of {}, or left pixels "
          "unwritten",
          text_of(kSizes[i]));
    }
    double largest = 0;
    cv::minMaxLoc(here[i].reshape(1), nullptr, &largest);
    if (largest >= first.values) {
      findings.add("label {} was written, expected labels below the palette's size {}", largest,
                   first.values);
    }
  }
}

}  // namespace maggic::testing
