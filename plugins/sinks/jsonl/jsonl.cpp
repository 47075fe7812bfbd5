/// jsonl: every frame's robots and ball as one line of JSON.
///
/// For logging, plotting and A/B tests: each line is complete in itself, so a file can be read
/// while it grows, and a crash loses at most the frames still queued. Field names are stable:
///
///     {"frame":12,"t_capture":0.4,
///      "ball":{"x_mm":..,"y_mm":..,"vx_mm_s":..,"vy_mm_s":..,"x_px":..,"y_px":..,
///              "confidence":..,"state":"seen"},
///      "robots":[{"team":"blue","id":0,"player_colors":["red"],"x_mm":..,"y_mm":..,
///                 "heading_rad":..,"vx_mm_s":..,"vy_mm_s":..,"omega_rad_s":..,"x_px":..,"y_px":..,
///                 "confidence":..,"state":"predicted"}]}
///
/// `ball` is null when there is none; `id` is -1 when the player colours are unknown; `t_capture`
/// is in seconds, from the Unix epoch for live sources and from the first frame for recorded ones.
/// Lengths are rounded to 0.001 mm or px, angles to 1e-5 rad.
///
///     sinks:
///       - jsonl: {path: out/detections.jsonl}     # `-` writes to standard output
///
/// The folder of `path` must exist; an existing file is replaced.

#include <cerrno>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include "maggic/plugin.hpp"

namespace {

using maggic::BallDetection;
using maggic::Detections;
using maggic::RobotDetection;
using Json = nlohmann::ordered_json;  // keeps the documented order of the fields

double rounded(double value, double steps_per_unit) {
  return std::round(value * steps_per_unit) / steps_per_unit;
}
double length(double value) { return rounded(value, 1e3); }
double angle(double value) { return rounded(value, 1e5); }

Json to_json(const BallDetection& ball) {
  return {{"x_mm", length(ball.position_mm.x)},      {"y_mm", length(ball.position_mm.y)},
          {"vx_mm_s", length(ball.velocity_mm_s.x)}, {"vy_mm_s", length(ball.velocity_mm_s.y)},
          {"x_px", length(ball.centroid_px.x)},      {"y_px", length(ball.centroid_px.y)},
          {"confidence", length(ball.confidence)},   {"state", name_of(ball.state)}};
}

Json to_json(const RobotDetection& robot, const maggic::Palette& palette) {
  Json colors = Json::array();
  for (const maggic::Label label : robot.player_colors) colors.push_back(palette.name(label));
  return {{"team", name_of(robot.team)},
          {"id", robot.id},
          {"player_colors", std::move(colors)},
          {"x_mm", length(robot.position_mm.x)},
          {"y_mm", length(robot.position_mm.y)},
          {"heading_rad", angle(robot.heading_rad)},
          {"vx_mm_s", length(robot.velocity_mm_s.x)},
          {"vy_mm_s", length(robot.velocity_mm_s.y)},
          {"omega_rad_s", angle(robot.angular_velocity_rad_s)},
          {"x_px", length(robot.centroid_px.x)},
          {"y_px", length(robot.centroid_px.y)},
          {"confidence", length(robot.confidence)},
          {"state", name_of(robot.state)}};
}

class Jsonl final : public maggic::Sink {
 public:
  ~Jsonl() override {
    if (owns_descriptor()) ::close(descriptor_);
  }

  void describe(maggic::Parameters& p) override {
    p.text({"path", "file to write, `-` for standard output", "", maggic::Presence::kRequired},
           path_);
    p.check("path", !path_.empty(), "is empty, expected a file name or `-`");
  }

  void prepare(const maggic::StageContext& context) override { palette_ = &context.palette; }

  void open(const maggic::RunInfo& /*info*/) override {
    if (path_ == "-") {
      descriptor_ = STDOUT_FILENO;
      return;
    }
    const std::filesystem::path folder = std::filesystem::path(path_).parent_path();
    std::error_code ignored;
    if (!folder.empty() && !std::filesystem::is_directory(folder, ignored)) {
      throw std::runtime_error(
          fmt::format("cannot write '{}': folder {} does not exist", path_, folder.string()));
    }
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail("open", errno);
    struct stat status {};
    is_regular_file_ = ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
  }

  void write(const maggic::FrameResult& result, const maggic::Field& /*field*/) override {
    const Detections& found = result.detections;
    Json robots = Json::array();
    for (const RobotDetection& robot : found.robots) robots.push_back(to_json(robot, *palette_));
    const Json line = {{"frame", found.sequence},
                       {"t_capture", std::chrono::duration<double>(found.captured).count()},
                       {"ball", found.ball ? to_json(*found.ball) : Json()},
                       {"robots", std::move(robots)}};
    // One system call a line: what the kernel has taken survives a crash of the program.
    write_line(line.dump() + '\n');
  }

  void close() override {
    if (!owns_descriptor()) return;
    const int result = ::close(descriptor_);
    descriptor_ = -1;
    if (result != 0) fail("complete", errno);
  }

 private:
  bool owns_descriptor() const { return descriptor_ >= 0 && descriptor_ != STDOUT_FILENO; }

  [[noreturn]] void fail(std::string_view what, int error) const {
    throw std::runtime_error(
        fmt::format("cannot {} '{}': {}", what, path_, std::generic_category().message(error)));
  }

  void write_line(const std::string& line) {
    std::size_t done = 0;
    while (done < line.size()) {
      const ssize_t count = ::write(descriptor_, line.data() + done, line.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) {
        const int error = errno;
        drop_partial_line();
        fail("write", error);
      }
      done += static_cast<std::size_t>(count);
    }
    bytes_written_ += static_cast<off_t>(line.size());
  }

  /// A full disk may take half a line; without this the next line would be glued to it.
  void drop_partial_line() {
    if (!is_regular_file_) return;
    if (::ftruncate(descriptor_, bytes_written_) == 0) {
      ::lseek(descriptor_, bytes_written_, SEEK_SET);
    }
  }

  std::string path_;
  const maggic::Palette* palette_ = nullptr;
  int descriptor_ = -1;
  bool is_regular_file_ = false;
  off_t bytes_written_ = 0;
};

}  // namespace

MAGGIC_PLUGIN(Jsonl, "writes robots and ball of every frame as one line of JSON")
