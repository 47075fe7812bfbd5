/// labelled_images: frames with all that is truly in them, as files other programs can learn from.
///
/// For `maggic sweep`, for training and for measuring: needs a source that knows the truth of every
/// pixel (synthetic_match with `labels: true`). Three files a sample, NAME being the frame's
/// number:
///
///     000030.png         the picture
///     000030.labels.png  same size, 8-bit gray: the palette's label of every pixel, 0 background
///     000030.json        robots and ball as an annotation of that picture
///
///     {"media":"000030.png","size_px":[640,480],"tolerance_px":0.5,
///      "ball":{"x":..,"y":..,"x_mm":..,"y_mm":..},
///      "robots":[{"team":"blue","id":0,"player_colors":["red"],"x":..,"y":..,"heading_deg":..,
///                 "x_mm":..,"y_mm":..,"heading_rad":..,"tags":[{"color":"blue","x":..,"y":..}]}],
///      "labels":["background","orange",..]}
///
/// `x`, `y` are pixels, (0,0) being the centre of the first one: of a robot midway between its team
/// tag and the mean of its player tags; `heading_deg` points from these to the team tag,
/// counter-clockwise with y up in the picture. `x_mm`, `y_mm`, `heading_rad` are the robot's own,
/// as in every output of Maggic. `ball` is null when there is none; `labels` names the gray values.
///
///     sinks:
///       - labelled_images: {path: out/challenging, every: 30}
///
/// The folder is made where its parent exists. A sample's picture is written last, so whoever sees
/// a picture finds the rest of its sample; one that cannot be completed is taken away again.

#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "maggic/atomic_file.hpp"
#include "maggic/plugin.hpp"

namespace {

namespace fs = std::filesystem;
using maggic::BallDetection;
using maggic::Palette;
using maggic::RobotDetection;
using maggic::TagSighting;
using Json = nlohmann::ordered_json;  // keeps the documented order of the fields

constexpr double kTolerancePx = 0.5;  // the truth is exact; a pixel's centre is what may be off

double rounded(double value) { return std::round(value * 1e4) / 1e4; }

Json to_json(const BallDetection& ball) {
  return {{"x", rounded(ball.centroid_px.x)},
          {"y", rounded(ball.centroid_px.y)},
          {"x_mm", rounded(ball.position_mm.x)},
          {"y_mm", rounded(ball.position_mm.y)}};
}

Json to_json(const RobotDetection& robot, const Palette& palette) {
  Json colors = Json::array();
  for (const maggic::Label label : robot.player_colors) colors.push_back(palette.name(label));
  Json json{{"team", name_of(robot.team)}, {"id", robot.id}, {"player_colors", std::move(colors)}};
  Json tags = Json::array();
  for (const TagSighting& tag : robot.tags) {
    tags.push_back({{"color", palette.name(tag.label)},
                    {"x", rounded(tag.centroid_px.x)},
                    {"y", rounded(tag.centroid_px.y)}});
  }
  if (robot.tags.size() > 1) {  // the team tag first
    const cv::Point2d team = robot.tags.front().centroid_px;
    cv::Point2d players(0.0, 0.0);
    for (std::size_t i = 1; i < robot.tags.size(); ++i) players += robot.tags[i].centroid_px;
    players /= static_cast<double>(robot.tags.size() - 1);
    const cv::Point2d middle = (team + players) / 2.0;
    const cv::Point2d way = team - players;
    json["x"] = rounded(middle.x);
    json["y"] = rounded(middle.y);
    json["heading_deg"] = rounded(std::atan2(-way.y, way.x) * 180.0 / std::numbers::pi);
  }
  json["x_mm"] = rounded(robot.position_mm.x);
  json["y_mm"] = rounded(robot.position_mm.y);
  json["heading_rad"] = rounded(robot.heading_rad);
  json["tags"] = std::move(tags);
  return json;
}

std::string as_png(const cv::Mat& picture) {
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".png", picture, bytes)) throw std::runtime_error("cannot encode a PNG");
  return {bytes.begin(), bytes.end()};
}

class LabelledImages final : public maggic::Sink {
 public:
  void describe(maggic::Parameters& p) override {
    p.text({"path", "folder of the samples", "", maggic::Presence::kRequired}, path_);
    p.check("path", !path_.empty(), "is empty, expected the name of a folder");
    p.integer({"every", "write each n-th frame, beginning with frame 0", "frames"}, every_,
              {1, 1'000'000'000});
  }

  void prepare(const maggic::StageContext& context) override {
    palette_ = &context.palette;
    reporter_ = &context.reporter;
  }

  void open(const maggic::RunInfo& /*info*/) override {
    std::error_code error;
    fs::create_directory(path_, error);
    if (!fs::is_directory(path_)) {
      throw std::runtime_error(fmt::format("cannot make the folder '{}': {}", path_,
                                           error ? error.message() : "a file has that name"));
    }
  }

  void write(const maggic::FrameResult& result, const maggic::Field& /*field*/) override {
    const maggic::Frame& frame = result.frame;
    if (frame.sequence % static_cast<std::uint64_t>(every_) != 0) return;
    if (!frame.has_truth || frame.truth_labels.empty()) {
      ++unlabelled_;
      reporter_->warn("a frame came without true labels and was not written");
      return;
    }
    write_sample(frame);
    ++written_;
  }

  void close() override {
    if (unlabelled_ > 0 && written_ == 0) {
      throw std::runtime_error(fmt::format(
          "nothing was written into '{}': no frame has true labels; expected a source that gives "
          "them, such as synthetic_match with labels: true",
          path_));
    }
  }

 private:
  void write_sample(const maggic::Frame& frame) const {
    const std::string name = fmt::format("{:06}", frame.sequence);
    const fs::path picture = fs::path(path_) / (name + ".png");
    const fs::path labels = fs::path(path_) / (name + ".labels.png");
    const fs::path annotation = fs::path(path_) / (name + ".json");
    fs::remove(picture);  // of an earlier run: it must not stand beside the labels of this one
    try {
      maggic::write_file_atomically(labels, as_png(frame.truth_labels));
      maggic::write_file_atomically(annotation, annotation_of(frame, name).dump(1) + '\n');
      maggic::write_file_atomically(picture, as_png(frame.bgr));
    } catch (...) {
      std::error_code ignored;
      for (const fs::path& file : {labels, annotation, picture}) fs::remove(file, ignored);
      throw;
    }
  }

  Json annotation_of(const maggic::Frame& frame, const std::string& name) const {
    Json robots = Json::array();
    for (const RobotDetection& robot : frame.truth.robots) {
      robots.push_back(to_json(robot, *palette_));
    }
    Json labels = Json::array();
    for (std::size_t label = 0; label < palette_->size(); ++label) {
      labels.push_back(palette_->name(static_cast<maggic::Label>(label)));
    }
    return {{"media", name + ".png"},
            {"size_px", {frame.bgr.cols, frame.bgr.rows}},
            {"tolerance_px", kTolerancePx},
            {"ball", frame.truth.ball ? to_json(*frame.truth.ball) : Json()},
            {"robots", std::move(robots)},
            {"labels", std::move(labels)}};
  }

  std::string path_;
  int every_ = 1;
  const Palette* palette_ = nullptr;
  maggic::Reporter* reporter_ = nullptr;
  std::uint64_t written_ = 0;
  std::uint64_t unlabelled_ = 0;
};

}  // namespace

MAGGIC_PLUGIN(LabelledImages, "writes frames with their true labels, robots and ball as files")
