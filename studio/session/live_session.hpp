#pragma once
/// A session on a pipeline that runs in this program.

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "maggic/runner.hpp"
#include "studio/session/color_editor.hpp"
#include "studio/session/event_log.hpp"
#include "studio/session/frame_events.hpp"
#include "studio/session/frame_questions.hpp"
#include "studio/session/newest_frame.hpp"
#include "studio/session/pipeline_exchange.hpp"
#include "studio/session/session.hpp"
#include "studio/session/view_pictures.hpp"

namespace maggic::studio {

/// Adds a sink to the pipeline that keeps the newest frame for those who look, and is called after
/// every frame. Everything that takes time happens on the sink's thread or the server's.
class LiveSession final : public Session {
 public:
  /// @param built from `request`; outlives the session, as all references do.
  /// @param stop ends a pause.
  LiveSession(PipelineRequest request, BuiltPipeline& built, PluginRegistry& registry,
              Reporter& reporter, const std::atomic<bool>& stop);
  ~LiveSession() override;

  /// To be called by the run loop after every frame, as `on_frame`. Waits while paused.
  void on_frame(const FrameResult& result, const RunSummary& summary);

  /// When the run has ended by itself: answers and takes changes on the frame kept last, as when
  /// paused, until `stop`.
  void stay_with_last_frame();

  /// Tells listeners; see Session.
  void tell(std::string_view level, std::string_view text) { events_.tell(level, text); }

  nlohmann::json state() const override;
  nlohmann::json pause(const nlohmann::json& request) override;
  nlohmann::json step() override;
  nlohmann::json colors() const override { return editor_.colors(); }
  nlohmann::json change_colors(const nlohmann::json& change) override {
    return editor_.change(change);
  }
  nlohmann::json undo() override { return editor_.undo(); }
  nlohmann::json redo() override { return editor_.redo(); }
  nlohmann::json save(const nlohmann::json& request) override { return editor_.save(request); }
  nlohmann::json density() override;
  nlohmann::json plane() override;
  nlohmann::json explain(int x_px, int y_px) override;
  std::vector<std::string> views() const override { return ViewPictures::names(); }
  std::shared_ptr<const Picture> next_picture(std::string_view view, int width_px,
                                              std::uint64_t after,
                                              std::chrono::milliseconds timeout) override {
    return pictures_.next(view, width_px, after, timeout);
  }
  std::optional<Event> next_event(std::uint64_t after, std::chrono::milliseconds timeout) override {
    return events_.next(after, timeout);
  }

 private:
  class FrameSink;

  /// @param is_exchanged whether another pipeline than the one in use made `result`.
  void wait_while_paused(const FrameResult& result, bool is_exchanged);
  /// What the pipeline in use makes of a frame that went through another one.
  /// @return whether it could.
  bool process_again(const FrameResult& result, FrameResult& again);

  BuiltPipeline& built_;
  const std::atomic<bool>& stop_;
  const std::string pipeline_name_;
  const Palette palette_;
  std::vector<std::string> normalizers_;
  std::vector<std::string> segmenters_;

  EventLog events_;
  FrameEvents frame_events_{events_};
  PipelineExchange exchange_;
  NewestFrame frames_;
  ViewPictures pictures_;
  FrameQuestions questions_;
  ColorEditor editor_;

  std::atomic<std::uint64_t> processed_{0};
  std::atomic<std::uint64_t> dropped_{0};
  mutable std::mutex mutex_;  ///< Of what follows.
  std::condition_variable unpaused_;
  bool paused_ = false;
  bool one_step_ = false;
  cv::Size frame_size_px_;
  SourceInfo source_;

  std::jthread file_watch_;  ///< Ends first.
};

}  // namespace maggic::studio
