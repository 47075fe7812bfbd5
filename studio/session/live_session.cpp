#include "studio/session/live_session.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

#include "maggic/base64.hpp"
#include "maggic/picture_colors.hpp"
#include "studio/session/hue_plane.hpp"

namespace maggic::studio {
namespace {

constexpr std::chrono::milliseconds kPatience{1000};
constexpr std::chrono::milliseconds kBetweenLooksAtFiles{500};
constexpr std::chrono::milliseconds kBetweenLooksWhilePaused{20};

// So many pixels show where colours lie; more only take longer.
constexpr double kMostSampledPixels = 100'000.0;

std::vector<std::string> names_of(const PluginRegistry::Scan& scan, StageKind kind) {
  std::vector<std::string> names;
  for (const PluginInfo& plugin : scan.plugins) {
    if (plugin.kind == kind) names.push_back(plugin.name);
  }
  return names;
}

nlohmann::json plane_as_json(const cv::Mat& plane, std::string_view key) {
  return {{"width", plane.cols},
          {"height", plane.rows},
          {std::string(key), base64({reinterpret_cast<const char*>(plane.data), plane.total()})}};
}

cv::Mat sampled(const cv::Mat& bgr) {
  const double share = static_cast<double>(bgr.total()) / kMostSampledPixels;
  const int step = std::max(1, static_cast<int>(std::ceil(std::sqrt(share))));
  cv::Mat sample;
  cv::resize(bgr, sample, {(bgr.cols + step - 1) / step, (bgr.rows + step - 1) / step}, 0, 0,
             cv::INTER_NEAREST);
  return sample;
}

// Null for a gray.
nlohmann::json hue_in_json(const cv::Vec3b& bgr) {
  if (bgr[0] == bgr[1] && bgr[1] == bgr[2]) return nullptr;
  return hue_of(bgr);
}

}  // namespace

/// Keeps the newest frame, and tells how frames go.
class LiveSession::FrameSink final : public Sink {
 public:
  explicit FrameSink(LiveSession& session) : session_(session) {}

  void open(const RunInfo& info) override {
    const std::lock_guard lock(session_.mutex_);
    session_.source_ = info.source;
  }

  void write(const FrameResult& result, const Field& field) override {
    {
      const std::lock_guard lock(session_.mutex_);
      session_.frame_size_px_ = result.frame.bgr.size();
    }
    session_.frames_.offer(result, field);
    session_.frame_events_.add(result, session_.processed_, session_.dropped_);
  }

 private:
  LiveSession& session_;
};

LiveSession::LiveSession(PipelineRequest request, BuiltPipeline& built, PluginRegistry& registry,
                         Reporter& reporter, const std::atomic<bool>& stop)
    : built_(built),
      stop_(stop),
      pipeline_name_(request.pipeline.stem().string()),
      palette_(built.pipeline->palette()),
      exchange_(built),
      pictures_(frames_, exchange_, palette_),
      editor_(std::move(request), *built.pipeline, exchange_, registry, reporter, events_) {
  const PluginRegistry::Scan scan = registry.scan();
  normalizers_ = names_of(scan, StageKind::kNormalizer);
  segmenters_ = names_of(scan, StageKind::kSegmenter);
  built.sinks.push_back({"studio", StagePtr<Sink>(new FrameSink(*this))});
  file_watch_ = std::jthread([this](const std::stop_token& end) {
    std::mutex mutex;
    std::condition_variable_any ended;
    std::unique_lock lock(mutex);
    while (!ended.wait_for(lock, end, kBetweenLooksAtFiles, [] { return false; }) &&
           !end.stop_requested()) {
      editor_.follow_files();
    }
  });
}

LiveSession::~LiveSession() {
  std::erase_if(built_.sinks, [](const NamedStage<Sink>& sink) {
    return dynamic_cast<FrameSink*>(sink.stage.get()) != nullptr;
  });
}

void LiveSession::on_frame(const FrameResult& result, const RunSummary& summary) {
  processed_ = summary.processed;
  dropped_ = summary.dropped;
  questions_.answer(*built_.pipeline, result);
  const bool is_exchanged = exchange_.between_frames();
  wait_while_paused(result, is_exchanged);
}

void LiveSession::stay_with_last_frame() {
  while (!stop_) {
    const std::shared_ptr<const KeptFrame> last = frames_.newest();
    {
      std::unique_lock lock(mutex_);
      paused_ = true;
      if (!last) unpaused_.wait_for(lock, kBetweenLooksWhilePaused);
    }
    if (last) wait_while_paused(last->result, true);
  }
}

void LiveSession::wait_while_paused(const FrameResult& result, bool is_exchanged) {
  const auto goes_on = [&] {
    const std::lock_guard lock(mutex_);
    return !paused_ || std::exchange(one_step_, false) || stop_;
  };
  // What the pipeline in use made of the frame; null when it failed.
  const FrameResult* shown = &result;
  FrameResult again;
  while (!goes_on()) {
    if (is_exchanged) shown = process_again(result, again) ? &again : nullptr;
    if (shown != nullptr) questions_.answer(*built_.pipeline, *shown);
    is_exchanged = exchange_.between_frames();
    std::unique_lock lock(mutex_);
    if (!is_exchanged) unpaused_.wait_for(lock, kBetweenLooksWhilePaused);
  }
}

bool LiveSession::process_again(const FrameResult& result, FrameResult& again) {
  again.frame = result.frame;  // its picture is shared: processed once, it is not written to again
  try {
    if (built_.pipeline->process(again) != FrameOutcome::kProcessed) return false;
  } catch (const std::exception& e) {
    events_.tell("error", e.what());
    return false;
  }
  frames_.keep(again, *built_.pipeline->field());
  return true;
}

nlohmann::json LiveSession::state() const {
  nlohmann::json palette = nlohmann::json::array();
  for (std::size_t i = 1; i < palette_.size(); ++i) {
    const auto label = static_cast<Label>(i);
    const DisplayColor color = palette_.display_color(label);
    palette.push_back({{"label", i},
                       {"name", palette_.name(label)},
                       {"rgb", {color.red, color.green, color.blue}}});
  }
  const std::lock_guard lock(mutex_);
  return {{"pipeline", pipeline_name_},
          {"source",
           {{"name", built_.source.name},
            {"width", frame_size_px_.width},
            {"height", frame_size_px_.height},
            {"fps", source_.frames_per_second},
            {"live", source_.live}}},
          {"palette", std::move(palette)},
          {"views", ViewPictures::names()},
          {"running", !paused_},
          {"normalizers", normalizers_},
          {"segmenters", segmenters_}};
}

nlohmann::json LiveSession::pause(const nlohmann::json& request) {
  if (!request.is_object() || !request.contains("paused") || !request["paused"].is_boolean()) {
    throw BadRequest(422,
                     "found no truth value under 'paused', expected {\"paused\": true} or false");
  }
  {
    const std::lock_guard lock(mutex_);
    paused_ = request["paused"];
  }
  unpaused_.notify_all();
  return state();
}

nlohmann::json LiveSession::step() {
  {
    const std::lock_guard lock(mutex_);
    if (source_.live) throw BadRequest(409, "a camera's frames cannot be had one by one");
    if (!paused_) throw BadRequest(409, "found a run that goes on, expected a paused one");
    one_step_ = true;
  }
  unpaused_.notify_all();
  return state();
}

nlohmann::json LiveSession::density() {
  const std::shared_ptr<const KeptFrame> frame = frames_.next(0, kPatience);
  if (!frame) throw BadRequest(503, "no frame has come yet");
  const cv::Mat bgr = sampled(frame->result.frame.bgr);
  const cv::Mat normalized = pictures_.normalized(bgr).value_or(bgr);
  const nlohmann::json colors = editor_.colors();
  const int threshold =
      colors["gray_threshold"].is_number() ? colors["gray_threshold"].get<int>() : 0;
  const cv::Mat& of_hue = colors["hue_of"] == "normalized" ? normalized : bgr;
  const HueDensity density = hue_density(of_hue, channel_spread(normalized) > threshold);
  return {{"hue_value", plane_as_json(density.by_value, "counts")},
          {"hue_saturation", plane_as_json(density.by_saturation, "counts")}};
}

nlohmann::json LiveSession::plane() {
  cv::Mat labels;
  exchange_.with_pipeline([&](const Pipeline& pipeline) {
    if (pipeline.color_table() != nullptr) labels = plane_labels(*pipeline.color_table());
  });
  if (labels.empty()) {
    throw BadRequest(409, "a stage needs the whole picture, so no colour has a label of its own");
  }
  return plane_as_json(labels, "labels");
}

nlohmann::json LiveSession::explain(int x_px, int y_px) {
  const std::optional<PixelAnswer> answer = questions_.ask({x_px, y_px}, kPatience);
  if (!answer) throw BadRequest(503, "no frame came to be asked");
  if (answer->stages.empty()) {
    throw BadRequest(422,
                     fmt::format("found the pixel {},{}, expected one within {}×{}", x_px, y_px,
                                 answer->frame_size_px.width, answer->frame_size_px.height));
  }
  // The one that the segmenter judges by.
  std::optional<cv::Mat> judged(cv::Mat3b(1, 1, answer->followed_bgr));
  if (editor_.colors()["hue_of"] == "normalized") judged = pictures_.normalized(*judged);
  const nlohmann::json hue = judged ? hue_in_json(judged->at<cv::Vec3b>(0, 0)) : nullptr;
  nlohmann::json stages = nlohmann::json::array();
  for (const StageAnswer& stage : answer->stages) {
    stages.push_back({{"stage", stage.stage}, {"text", stage.text}});
  }
  return {{"x", x_px},
          {"y", y_px},
          {"rgb", {answer->bgr[2], answer->bgr[1], answer->bgr[0]}},
          {"hue", hue},
          {"answers", std::move(stages)}};
}

}  // namespace maggic::studio
