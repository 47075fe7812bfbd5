#pragma once

#include "app/templates/shared.hpp"

namespace maggic::app::templates {

inline constexpr Plugin kNormalizer = {R"cpp(
/// @NAME@: one sentence on what it does to a colour
///
/// When to use it, and where the idea comes from. As it stands it multiplies every channel.
///
///     normalizer:
///       @NAME@:
///         gain: 1.5

#include <algorithm>

#include "maggic/plugin.hpp"

namespace {

// ColorNormalizer: the answer depends on the colour alone, so it is compiled into a table before
// the first frame. Derive from maggic::ImageNormalizer where the picture is needed.
class @CLASS@ final : public maggic::ColorNormalizer {
 public:
  void describe(maggic::Parameters& p) override {
    p.number({"gain", "what every channel is multiplied by"}, gain_, {0.0, 10.0});
  }

  void normalize(const maggic::ColorBatch& in,
                 const maggic::MutableColorBatch& out) const override {
    for (std::size_t i = 0; i < in.size(); ++i) {
      out.b[i] = brightened(in.b[i]);
      out.g[i] = brightened(in.g[i]);
      out.r[i] = brightened(in.r[i]);
    }
  }

 private:
  std::uint8_t brightened(std::uint8_t channel) const {
    return static_cast<std::uint8_t>(std::min(channel * gain_, 255.0));
  }

  double gain_ = 1.5;
};

}  // namespace

MAGGIC_PLUGIN(@CLASS@, "multiplies every channel")
)cpp",
                                       R"cpp(
#include <array>

#include <gmock/gmock.h>

#include "maggic/testing.hpp"

namespace {

std::array<std::uint8_t, 3> normalized(std::array<std::uint8_t, 3> bgr, const char* yaml) {
  const auto stage = maggic::testing::make<maggic::Normalizer>("@NAME@", yaml);
  std::array<std::uint8_t, 3> out{};
  dynamic_cast<const maggic::ColorNormalizer&>(*stage).normalize(
      {{&bgr[0], 1}, {&bgr[1], 1}, {&bgr[2], 1}}, {{&out[0], 1}, {&out[1], 1}, {&out[2], 1}});
  return out;
}

TEST(@CLASS@, KeepsTheContractOfANormalizer) {
  // With other parameters too: what holds for the defaults alone is found out late.
  for (const char* yaml : {"", "gain: 0.5", "gain: 3"}) {
    EXPECT_THAT(maggic::testing::check_conformance(maggic::StageKind::kNormalizer, "@NAME@", yaml),
                ::testing::IsEmpty())
        << yaml;
  }
}

TEST(@CLASS@, MultipliesEveryChannel) {
  EXPECT_THAT(normalized({10, 20, 30}, "gain: 2"), ::testing::ElementsAre(20, 40, 60));
}

TEST(@CLASS@, StopsAtWhite) {
  EXPECT_THAT(normalized({200, 200, 200}, "gain: 2"), ::testing::ElementsAre(255, 255, 255));
}

}  // namespace
)cpp"};

}  // namespace maggic::app::templates
