#include "tracking/robot_track.hpp"

#include <algorithm>
#include <cmath>

namespace maggic::tracking {
namespace {

constexpr double kTravelSlackMm = 30.0;
constexpr double kMaxGateMm = 150.0;
// With a standard deviation beyond this a heading says nothing of front and back any more.
constexpr double kLostHeadingRad = radians(60.0);

}  // namespace

void RobotTrack::predict(double dt_s, const TrackingParameters& parameters) {
  position.predict(dt_s, parameters.acceleration_mm_s2);
  if (!heading_measured) heading.slow_down(dt_s);
  heading.predict(dt_s, parameters.angular_acceleration_rad_s2);
  heading_measured = false;
  unseen_s += dt_s;
  candidate = -1;
}

double RobotTrack::max_travel_mm(const TrackingParameters& parameters) const {
  return kTravelSlackMm + parameters.max_speed_mm_s * unseen_s;
}

double RobotTrack::gate_mm(const TrackingParameters& parameters) const {
  return std::min({12.0 + 3.0 * position.sigma_mm(), max_travel_mm(parameters), kMaxGateMm});
}

bool RobotTrack::is_refuted_by(int color_id) const {
  if (contrary_id != color_id) return false;
  const bool sure = agreeing_frames >= kSwitchFrames;
  const int needed = color_id == kUnknownId && sure ? kForgetFrames : kSwitchFrames;
  // The frame at hand is evidence as well.
  return contrary_frames + 1 >= needed;
}

void RobotTrack::start(const Candidate& sighting, int claimed_id,
                       const TrackingParameters& parameters) {
  team = sighting.team;
  position.start(sighting.pose.position_mm, parameters.position_noise_mm * sighting.position_sigmas,
                 parameters.max_speed_mm_s);
  heading.start(sighting.pose.heading_rad,
                radians(parameters.heading_noise_deg) * std::max(1.0, sighting.heading_sigmas));
  heading_known = sighting.heading_known;
  heading_measured = sighting.heading_sigmas > 0.0;
  seen_frames = 0;
  note_colors(sighting, claimed_id);
}

void RobotTrack::update(const Candidate& sighting, int claimed_id,
                        const TrackingParameters& parameters) {
  if (is_put_right_by(sighting)) {
    // Without the right heading the place was off as well: not a motion that could be measured.
    const int seen = seen_frames;
    const int agreeing = claimed_id == id ? agreeing_frames : 0;
    start(sighting, claimed_id, parameters);
    seen_frames = seen + 1;
    agreeing_frames += agreeing;
    return;
  }
  position.correct(sighting.pose.position_mm,
                   parameters.position_noise_mm * sighting.position_sigmas);
  if (sighting.heading_sigmas > 0.0) {
    correct_heading(sighting, radians(parameters.heading_noise_deg) * sighting.heading_sigmas);
  } else if (heading.sigma_rad() > kLostHeadingRad) {
    heading_known = false;
  }
  note_colors(sighting, claimed_id);
}

bool RobotTrack::is_put_right_by(const Candidate& sighting) const {
  if (!sighting.heading_known) return false;
  if (!heading_known) return true;
  // One patch takes its side from the track; several know it, and no robot turns about in a frame.
  return sighting.found > 1 &&
         std::abs(wrap_turn(sighting.pose.heading_rad - heading.heading_rad())) > kPi / 2.0;
}

void RobotTrack::correct_heading(const Candidate& sighting, double noise_rad) {
  double measured = sighting.pose.heading_rad;
  if (!sighting.heading_known) {
    const double now = heading.heading_rad();
    measured = now + wrap_line(measured - now);
  }
  heading.correct(measured, noise_rad);
  heading_measured = true;
}

void RobotTrack::note_colors(const Candidate& sighting, int claimed_id) {
  if (claimed_id != id || seen_frames == 0) {
    id = claimed_id;
    agreeing_frames = 0;
    contrary_frames = 0;
  }
  if (sighting.complete) {
    layout = sighting.layout;
    if (sighting.color_id == id) {
      ++agreeing_frames;
      contrary_frames = 0;
    } else {
      contrary_frames = sighting.color_id == contrary_id ? contrary_frames + 1 : 1;
      contrary_id = sighting.color_id;
    }
  } else if (seen_frames == 0) {
    layout = sighting.layout;
  }
  ++seen_frames;
  missed_frames = 0;
  unseen_s = 0.0;
}

}  // namespace maggic::tracking
