#pragma once

#include "app/templates/shared.hpp"

namespace maggic::app::templates {

inline constexpr Plugin kSink = {R"cpp(
/// @NAME@: one sentence on where results go
///
/// When to use it. As it stands it writes the number of robots of every frame, one line a frame.
///
///     sinks:
///       - @NAME@:
///           path: robots.csv

#include <fstream>
#include <stdexcept>
#include <string>

#include "maggic/plugin.hpp"

namespace {

class @CLASS@ final : public maggic::Sink {
 public:
  void describe(maggic::Parameters& p) override {
    p.text({"path", "file to write", "", maggic::Presence::kRequired}, path_);
  }

  void open(const maggic::RunInfo& /*info*/) override {
    file_.open(path_);
    if (!file_) throw std::runtime_error("cannot write '" + path_ + "'");
    file_ << "frame,robots\n";
  }

  void write(const maggic::FrameResult& result, const maggic::Field& /*field*/) override {
    file_ << result.detections.sequence << ',' << result.detections.robots.size() << '\n';
    if (!file_) throw std::runtime_error("cannot write '" + path_ + "'");
  }

  void close() override {
    file_.close();
    if (!file_) throw std::runtime_error("'" + path_ + "' is not complete");
  }

 private:
  std::string path_;
  std::ofstream file_;
};

}  // namespace

MAGGIC_PLUGIN(@CLASS@, "writes the number of robots of every frame")
)cpp",
                                 R"cpp(
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>

#include "maggic/testing.hpp"

namespace {

const std::string kFile = ::testing::TempDir() + "@NAME@_test.csv";

TEST(@CLASS@, KeepsTheContractOfASink) {
  EXPECT_THAT(maggic::testing::check_conformance(maggic::StageKind::kSink, "@NAME@",
                                                 "path: '" + kFile + "'"),
              ::testing::IsEmpty());
}

TEST(@CLASS@, WritesOneLineAFrame) {
  const auto sink = maggic::testing::make<maggic::Sink>("@NAME@", "path: '" + kFile + "'");
  const maggic::Field field(maggic::FieldParameters{}, cv::Size(64, 48));
  maggic::FrameResult result;
  result.detections.sequence = 7;
  result.detections.robots.resize(2);
  sink->open({maggic::testing::standard_palette(), {}});
  sink->write(result, field);
  sink->close();
  std::ostringstream text;
  text << std::ifstream(kFile).rdbuf();
  EXPECT_EQ(text.str(), "frame,robots\n7,2\n");
}

}  // namespace
)cpp"};

}  // namespace maggic::app::templates
