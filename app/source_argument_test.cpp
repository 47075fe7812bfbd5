#include "app/source_argument.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace maggic::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// "plugin", or "plugin key=value" as the one parameter stands.
std::string outline(const Node& source) {
  if (source.kind != Node::Kind::kMap || source.entries.size() != 1) return "not one plugin";
  const auto& [plugin, place, parameters] = source.entries[0];
  if (parameters.kind != Node::Kind::kMap) return plugin + " without a map of parameters";
  std::string text = plugin;
  for (const Node::Entry& entry : parameters.entries) {
    text += " " + entry.key + "=" + entry.value.scalar;
  }
  return text;
}

std::string outline_of(const std::string& argument) {
  return outline(source_from_argument(argument));
}

class SourceArgument : public ::testing::Test {
 protected:
  SourceArgument() {
    std::filesystem::create_directories(folder_);
    for (const char* name : {"film.mp4", "no_extension", "field.PNG", "odd*.jpg", "12"}) {
      std::ofstream(folder_ / name) << "content does not matter";
    }
  }
  ~SourceArgument() override { std::filesystem::remove_all(folder_); }

  std::string path(const char* name) const { return folder_ / name; }

  const std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) / ("source_arg_" + std::to_string(::getpid()));
};

TEST_F(SourceArgument, ANumberOrAVideoDeviceIsACamera) {
  EXPECT_EQ(outline_of("0"), "camera device=0");
  EXPECT_EQ(outline_of("12"), "camera device=12");
  EXPECT_EQ(outline_of("/dev/video2"), "camera device=/dev/video2");
  EXPECT_EQ(outline_of("/dev/v4l/by-id/usb-cam"), "camera device=/dev/v4l/by-id/usb-cam");
}

TEST_F(SourceArgument, SyntheticIsTheSyntheticMatchAsThePipelineHasIt) {
  EXPECT_EQ(outline_of("synthetic"), "synthetic_match");
}

TEST_F(SourceArgument, AnAddressIsAVideo) {
  EXPECT_EQ(outline_of("rtsp://10.0.0.2:554/live?x=*"), "video path=rtsp://10.0.0.2:554/live?x=*");
  EXPECT_EQ(outline_of("udp://@:1234"), "video path=udp://@:1234");
}

TEST_F(SourceArgument, AFolderAPatternOrAPictureIsImages) {
  EXPECT_EQ(outline_of(folder_), "images path=" + folder_.string());
  EXPECT_EQ(outline_of(path("*.png")), "images path=" + path("*.png"));
  EXPECT_EQ(outline_of(path("shot?.raw")), "images path=" + path("shot?.raw"));
  EXPECT_EQ(outline_of(path("field.PNG")), "images path=" + path("field.PNG"));
  EXPECT_EQ(outline_of(path("odd*.jpg")), "images path=" + path("odd*.jpg"));
}

TEST_F(SourceArgument, AnyOtherFileIsAVideo) {
  EXPECT_EQ(outline_of(path("film.mp4")), "video path=" + path("film.mp4"));
  EXPECT_EQ(outline_of(path("no_extension")), "video path=" + path("no_extension"));
  EXPECT_EQ(outline_of(path("12")), "video path=" + path("12"));
}

TEST_F(SourceArgument, WhatIsNotThereIsRefusedWithWhatIsAccepted) {
  for (const std::string& argument : {path("nowhere.mp4"), std::string(), std::string("-1"),
                                      std::string("://x"), std::string("1:a://x")}) {
    EXPECT_THAT([&] { source_from_argument(argument); },
                ThrowsMessage<std::invalid_argument>(
                    AllOf(HasSubstr("'" + argument + "'"), HasSubstr("/dev/video0"),
                          HasSubstr("rtsp://"), HasSubstr("synthetic"))));
  }
}

TEST_F(SourceArgument, MistakesAreToldAsBeingInTheFlag) {
  const Node source = source_from_argument("0");
  EXPECT_EQ(source.entries[0].value.entries[0].value.place.file, "--source");
}

}  // namespace
}  // namespace maggic::app
