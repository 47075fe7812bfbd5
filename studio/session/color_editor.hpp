#pragma once
/// The document of a running pipeline, changed step by step.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "maggic/pipeline_builder.hpp"
#include "studio/session/color_settings.hpp"
#include "studio/session/event_log.hpp"
#include "studio/session/pipeline_exchange.hpp"

namespace maggic::studio {

/// Changes are built into a new pipeline on the caller's thread and exchanged between two frames;
/// one with a mistake changes nothing. Safe from any thread; one change at a time. JSON as spoken
/// under /api/colors.
class ColorEditor {
 public:
  /// All references outlive the editor.
  /// @param running built from `request`, and not yet run.
  /// @throws ConfigError as merged_document does.
  ColorEditor(PipelineRequest request, const Pipeline& running, PipelineExchange& exchange,
              PluginRegistry& registry, Reporter& reporter, EventLog& events);

  nlohmann::json colors() const;
  nlohmann::json change(const nlohmann::json& change);
  nlohmann::json undo();
  nlohmann::json redo();

  /// Writes a calibration file that makes the pipeline what it is now: `{"file": path}`, absent for
  /// the one it was started with.
  nlohmann::json save(const nlohmann::json& request);

  /// Takes over what was written into the pipeline's or the calibration's file since it was read
  /// last; what was not saved is kept for undo. Mistakes become an event; the pipeline runs on as
  /// it is.
  void follow_files();

 private:
  /// A document and what its stages say of themselves.
  struct Version {
    Node document;
    ColorStages stages;
  };
  using FileTimes = std::vector<std::optional<std::filesystem::file_time_type>>;

  /// Builds `document` and puts it to use. @return the version before.
  /// @throws ConfigError, StageError; nothing changes then.
  Version use(Node document);
  /// The same for what the page asks. @throws BadRequest with its mistakes.
  Version use_or_refuse(Node document);
  nlohmann::json step(std::vector<Version>& from, std::vector<Version>& to,
                      std::string_view nothing_left);
  nlohmann::json answer() const;
  void tell_of_change();
  std::filesystem::path file_to_save(const nlohmann::json& request) const;
  FileTimes file_times() const;
  void reload();

  PipelineRequest request_;
  PipelineExchange& exchange_;
  PluginRegistry& registry_;
  Reporter& reporter_;
  EventLog& events_;

  mutable std::mutex mutex_;
  Version now_;
  nlohmann::json saved_settings_;
  std::vector<Version> undo_;
  std::vector<Version> redo_;
  /// Of the last change, so that a drag is one step of undo.
  std::vector<std::string> last_keys_;
  std::chrono::steady_clock::time_point last_change_{};  ///< When it was done.
  std::uint64_t revision_ = 1;
  std::chrono::nanoseconds compile_time_{0};
  FileTimes read_at_;
};

}  // namespace maggic::studio
