#pragma once

#include "app/templates/shared.hpp"

namespace maggic::app::templates {

inline constexpr Plugin kSegmenter = {R"cpp(
/// @NAME@: one sentence on how it tells colours apart
///
/// When to use it, and where the idea comes from. As it stands it looks for one colour: that of
/// every pixel whose red outweighs its blue.
///
///     segmenter:
///       @NAME@:
///         color: orange
///         least_difference: 60

#include "maggic/plugin.hpp"

namespace {

// ColorSegmenter: the answer depends on the colour alone, so it is compiled into a table before
// the first frame. Derive from maggic::ImageSegmenter where the picture is needed.
class @CLASS@ final : public maggic::ColorSegmenter {
 public:
  void describe(maggic::Parameters& p) override {
    if (color_ == maggic::kBackground) color_ = p.palette().find("orange").value_or(color_);
    p.color({"color", "label of the pixels that are red enough"}, color_);
    p.integer({"least_difference", "how much red outweighs blue at least", "8-bit steps"},
              least_difference_, {0, 255});
  }

  void segment(const maggic::ColorBatch& /*original*/, const maggic::ColorBatch& normalized,
               std::span<maggic::Label> labels) const override {
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const bool is_red = normalized.r[i] - normalized.b[i] >= least_difference_;
      labels[i] = is_red ? color_ : maggic::kBackground;
    }
  }

 private:
  maggic::Label color_ = maggic::kBackground;
  int least_difference_ = 60;
};

}  // namespace

MAGGIC_PLUGIN(@CLASS@, "one colour: red outweighs blue")
)cpp",
                                      R"cpp(
#include <array>

#include <gmock/gmock.h>

#include "maggic/testing.hpp"

namespace {

/// Name of the label that a pixel gets which looks the same before and after normalisation.
std::string_view color_of(std::array<std::uint8_t, 3> bgr, const char* yaml) {
  const auto stage = maggic::testing::make<maggic::Segmenter>("@NAME@", yaml);
  const maggic::ColorBatch batch{{&bgr[0], 1}, {&bgr[1], 1}, {&bgr[2], 1}};
  maggic::Label label = maggic::kBackground;
  dynamic_cast<const maggic::ColorSegmenter&>(*stage).segment(batch, batch, {&label, 1});
  return maggic::testing::standard_palette().name(label);
}

TEST(@CLASS@, KeepsTheContractOfASegmenter) {
  // With other parameters too: what holds for the defaults alone is found out late.
  for (const char* yaml : {"", "color: blue"}) {
    EXPECT_THAT(maggic::testing::check_conformance(maggic::StageKind::kSegmenter, "@NAME@", yaml),
                ::testing::IsEmpty())
        << yaml;
  }
}

TEST(@CLASS@, LabelsWhatIsRedEnough) {
  EXPECT_EQ(color_of({100, 0, 160}, "color: red"), "red");
  EXPECT_EQ(color_of({100, 0, 159}, "color: red"), "background");
}

}  // namespace
)cpp"};

}  // namespace maggic::app::templates
