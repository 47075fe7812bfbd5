#pragma once
/// A session without a pipeline: it remembers what it was told, and its pictures are made up.

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "studio/session/session.hpp"

namespace maggic::studio {

class FakeSession final : public Session {
 public:
  using json = nlohmann::json;

  /// @param picture_bytes of each picture.
  explicit FakeSession(std::size_t picture_bytes = 1000) : picture_bytes_(picture_bytes) {}

  json state() const override {
    const std::lock_guard lock(mutex_);
    return {{"pipeline", "fake"}, {"running", !paused_}};
  }
  json pause(const json& request) override {
    if (!request.contains("paused")) throw BadRequest(422, "paused: missing");
    {
      const std::lock_guard lock(mutex_);
      paused_ = request["paused"].get<bool>();
    }
    return state();
  }
  json step() override {
    {
      const std::lock_guard lock(mutex_);
      ++stepped_;
    }
    return state();
  }

  json colors() const override {
    const std::lock_guard lock(mutex_);
    return colors_.back();
  }
  /// Takes `gray_threshold` from 0 to 255.
  json change_colors(const json& change) override {
    const int threshold = change.at("gray_threshold").get<int>();
    if (threshold < 0 || threshold > 255) {
      throw BadRequest(422, json{{"mistakes",
                                  {{{"key", "segmenter.gray_threshold"},
                                    {"message", "expected a number from 0 to 255"}}}}});
    }
    const std::lock_guard lock(mutex_);
    colors_.push_back({{"gray_threshold", threshold}, {"revision", colors_.size() + 1}});
    return colors_.back();
  }
  json undo() override {
    const std::lock_guard lock(mutex_);
    if (colors_.size() == 1) throw BadRequest(409, "there is nothing to undo");
    colors_.pop_back();
    return colors_.back();
  }
  json redo() override { throw BadRequest(409, "there is nothing to redo"); }
  json save(const json& request) override {
    return {{"file", request.value("file", "venue.yaml")}};
  }

  json density() override { throw std::runtime_error("the fake has no frames"); }
  json plane() override { return {{"width", 1}, {"height", 1}, {"labels", "\xff not UTF-8"}}; }
  json explain(int x_px, int y_px) override { return {{"x", x_px}, {"y", y_px}}; }

  std::vector<std::string> views() const override { return {"overlay", "labels", "never"}; }

  /// A new one every 10 ms; none of the view `never`.
  std::shared_ptr<const Picture> next_picture(std::string_view view, int width_px,
                                              std::uint64_t after,
                                              std::chrono::milliseconds timeout) override {
    constexpr std::chrono::milliseconds kInterval(10);
    using Clock = std::chrono::steady_clock;
    const auto give_up = Clock::now() + timeout;
    std::unique_lock lock(mutex_);
    const auto there = began_ + kInterval * after;
    if (view == "never" || there > give_up) {
      never_.wait_until(lock, give_up);
      return nullptr;
    }
    while (Clock::now() < there) never_.wait_until(lock, there);
    auto picture = std::make_shared<Picture>();
    picture->sequence = static_cast<std::uint64_t>((Clock::now() - began_) / kInterval) + 1;
    picture->jpeg.assign(picture_bytes_, static_cast<std::uint8_t>(width_px));
    ++pictures_given_;
    return picture;
  }

  std::optional<Event> next_event(std::uint64_t after, std::chrono::milliseconds timeout) override {
    std::unique_lock lock(mutex_);
    const auto next = [&]() -> const Event* {
      const bool unknown = after == 0 || after > events_.size();
      if (events_.empty() || after == events_.size()) return nullptr;
      return unknown ? &events_.back() : &events_[after];
    };
    happened_.wait_for(lock, timeout, [&] { return next() != nullptr; });
    const Event* event = next();
    return event == nullptr ? std::nullopt : std::optional(*event);
  }
  void happen(std::string name, std::string data) {
    {
      const std::lock_guard lock(mutex_);
      events_.push_back({events_.size() + 1, std::move(name), std::move(data)});
    }
    happened_.notify_all();
  }

  int stepped() const {
    const std::lock_guard lock(mutex_);
    return stepped_;
  }
  int pictures_given() const {
    const std::lock_guard lock(mutex_);
    return pictures_given_;
  }

 private:
  const std::size_t picture_bytes_;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  mutable std::mutex mutex_;
  std::condition_variable never_;  ///< Waited on, so that waiting leaves the mutex free.
  std::condition_variable happened_;
  bool paused_ = false;
  int stepped_ = 0;
  int pictures_given_ = 0;
  std::vector<json> colors_{{{"gray_threshold", 60}, {"revision", 1}}};
  std::vector<Event> events_;
};

}  // namespace maggic::studio
