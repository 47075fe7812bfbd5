#include "maggic/tracking_engine.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include <fmt/format.h>

#include "tracking/ball_tracker.hpp"
#include "tracking/robot_tracker.hpp"

namespace maggic {
namespace {

// After a longer gap nothing learnt of the motion holds any more.
constexpr double kMaxGapS = 0.5;

// Files are checked by TagLayout::describe; this guards layouts that code has put together.
void require_sound(const TagLayout& layout) {
  const auto teams = std::ranges::count(layout.patches, PatchRole::kTeam, &TagPatch::role);
  if (teams != 1 || layout.patches.size() < 2 || layout.patches.size() > kMaxPatches) {
    throw std::invalid_argument(fmt::format(
        "tag layout '{}' has {} patches, {} of them the team's; expected 2 to {}, one the team's",
        layout.name, layout.patches.size(), teams, kMaxPatches));
  }
  for (const TagId& entry : layout.ids) {
    if (entry.colors.size() + 1 == layout.patches.size() && entry.id >= 0) continue;
    throw std::invalid_argument(fmt::format(
        "tag layout '{}': id {} has {} colours; expected an id from 0 with {}, one a player patch",
        layout.name, entry.id, entry.colors.size(), layout.patches.size() - 1));
  }
}

std::vector<tracking::LayoutModel> models_of(const std::vector<TagLayout>& layouts) {
  if (layouts.empty()) throw std::invalid_argument("no tag layout given, expected at least one");
  std::ranges::for_each(layouts, require_sound);
  return {layouts.begin(), layouts.end()};
}

}  // namespace

class TrackingEngine::Impl {
 public:
  Impl(const TrackingParameters& parameters, const std::vector<TagLayout>& layouts,
       Reporter* reporter)
      : parameters_(parameters),
        reporter_(reporter),
        tag_layouts_(layouts),
        layouts_(models_of(layouts)),
        robots_(parameters_, layouts_),
        ball_(parameters_) {}

  void track(const TrackerInput& input, Detections& out) {
    out.clear();
    out.sequence = input.sequence;
    out.captured = input.captured;
    const double dt_s = step_to(input.captured);
    robots_.track(input, dt_s);
    if (reporter_ && robots_.is_cut_short()) {
      reporter_->warn(
          "a frame held more blobs in tag colours than can all be tried as robots; the least "
          "likely were left out. Narrower colours or a larger blobs.min_area_mm2 make it cleaner");
    }
    bodies_.clear();
    for (const tracking::RobotTrack& robot : robots_.tracks()) {
      if (robot.missed_frames > 0) continue;
      bodies_.push_back({robot.pose(), robots_.half_body_mm(robot)});
    }
    ball_.track(input, bodies_, dt_s);
    robots_.report(input, out);
    ball_.report(input, out);
  }

  std::string explain(const TrackerInput& input, std::size_t blob, const Palette& palette) const {
    if (std::string owner = robots_.explain_owner(input, blob, palette); !owner.empty()) {
      return owner;
    }
    if (ball_.is_seen_as(blob)) return "the ball";
    const std::string as_robot = robots_.explain_refusal(input, blob, palette);
    if (input.blobs[blob].label != parameters_.ball_color) return as_robot;
    const std::string as_ball = ball_.explain(input, bodies_, blob);
    return robots_.may_be_patch(parameters_.ball_color) ? as_ball + "\n" + as_robot : as_ball;
  }

  TrackedPattern pattern() const {
    return {tag_layouts_, parameters_.blue_team_color, parameters_.yellow_team_color,
            parameters_.ball_color, parameters_.ball_diameter_mm};
  }

 private:
  double step_to(Timestamp captured) {
    const double dt_s = std::chrono::duration<double>(captured - last_).count();
    const bool usable = started_ && dt_s >= 0.0 && dt_s <= kMaxGapS;
    started_ = true;
    last_ = captured;
    if (usable) return dt_s;
    robots_.forget();
    ball_.forget();
    return 0.0;
  }

  TrackingParameters parameters_;
  Reporter* reporter_;
  std::vector<TagLayout> tag_layouts_;
  std::vector<tracking::LayoutModel> layouts_;
  tracking::RobotTracker robots_;
  tracking::BallTracker ball_;
  std::vector<tracking::RobotBody> bodies_;
  bool started_ = false;
  Timestamp last_{0};
};

TrackingEngine::TrackingEngine(const TrackingParameters& parameters, std::vector<TagLayout> layouts,
                               Reporter* reporter)
    : impl_(std::make_unique<Impl>(parameters, layouts, reporter)) {}

TrackingEngine::~TrackingEngine() = default;

void TrackingEngine::track(const TrackerInput& input, Detections& out) { impl_->track(input, out); }

std::string TrackingEngine::explain(const TrackerInput& input, std::size_t blob,
                                    const Palette& palette) const {
  return impl_->explain(input, blob, palette);
}

TrackedPattern TrackingEngine::pattern() const { return impl_->pattern(); }

}  // namespace maggic
