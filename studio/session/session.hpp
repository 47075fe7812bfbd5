#pragma once
/// What the page may see and change of a running pipeline.

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "studio/session/bad_request.hpp"
#include "studio/session/event.hpp"
#include "studio/session/picture.hpp"

namespace maggic::studio {

/// Called from the server's threads, several at a time. Every function that takes or returns JSON
/// speaks that of the path of the same name under `/api`, and throws BadRequest for what it cannot
/// do; another exception is a failure of its own. None waits for longer than it takes the next
/// frame to come or a new colour table to be compiled.
class Session {
 public:
  virtual ~Session() = default;

  virtual nlohmann::json state() const = 0;
  /// Ends or resumes the flow of frames. @param request `{"paused": bool}`. @return as state().
  virtual nlohmann::json pause(const nlohmann::json& request) = 0;
  /// Processes one frame while paused; of sources that are not live only. @return as state().
  virtual nlohmann::json step() = 0;

  virtual nlohmann::json colors() const = 0;
  virtual nlohmann::json change_colors(const nlohmann::json& change) = 0;
  virtual nlohmann::json undo() = 0;
  virtual nlohmann::json redo() = 0;
  virtual nlohmann::json save(const nlohmann::json& request) = 0;

  virtual nlohmann::json density() = 0;
  virtual nlohmann::json plane() = 0;
  /// A pixel outside of the picture is a BadRequest.
  virtual nlohmann::json explain(int x_px, int y_px) = 0;

  /// Names that next_picture() knows.
  virtual std::vector<std::string> views() const = 0;
  /// The newest picture of a view, encoded once for all who ask, and only while someone asks.
  /// @param view one of views().
  /// @param width_px width wanted, at least 1; a picture is never enlarged; 0: the frame's own.
  /// @param after sequence number of the last picture the caller has; 0: none yet.
  /// @param timeout how long to wait for a newer one.
  /// @return null when none came in time.
  virtual std::shared_ptr<const Picture> next_picture(std::string_view view, int width_px,
                                                      std::uint64_t after,
                                                      std::chrono::milliseconds timeout) = 0;
  /// The first event after `after`, of those still kept.
  /// @param after number of the last event the caller has. 0, for a new listener, or a number not
  ///        yet reached, which is of an earlier session, stands for the newest event but one.
  /// @return nothing when none came in time.
  virtual std::optional<Event> next_event(std::uint64_t after,
                                          std::chrono::milliseconds timeout) = 0;
};

}  // namespace maggic::studio
