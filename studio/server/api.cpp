#include "studio/server/api.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "studio/server/event_stream.hpp"
#include "studio/server/json_answer.hpp"
#include "studio/server/picture_stream.hpp"

namespace maggic::studio {
namespace {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

/// A view that there is.
std::string known_view(const Session& session, std::string_view name) {
  const std::vector<std::string> views = session.views();
  if (std::ranges::find(views, name) == views.end()) {
    throw BadRequest(
        404, fmt::format("there is no view '{}' (known: {})", name, fmt::join(views, ", ")));
  }
  return std::string(name);
}

/// Width asked for; 0 where none was.
int wanted_width_px(const Request& request) {
  constexpr int kNarrowest = 16;
  constexpr int kWidest = 8192;
  if (!request.has_param("width")) return 0;
  const int width_px = whole_number(request, "width");
  if (width_px < kNarrowest || width_px > kWidest) {
    throw BadRequest(400, fmt::format("width: found {}, expected {} to {} pixels", width_px,
                                      kNarrowest, kWidest));
  }
  return width_px;
}

std::shared_ptr<void> slot_of(StreamSlots& slots) {
  std::shared_ptr<void> slot = slots.take();
  if (!slot) {
    throw BadRequest(
        503, fmt::format("{} streams of this kind are open, and no more may be", slots.most()));
  }
  return slot;
}

/// Answers with `stream` for as long as it goes on, holding `slot`.
template <typename Stream>
void answer_stream(Response& response, std::shared_ptr<Stream> stream, std::shared_ptr<void> slot) {
  response.status = 200;
  response.set_header("Cache-Control", "no-store");
  response.set_content_provider(
      Stream::kContentType,
      [stream = std::move(stream), slot = std::move(slot)](std::size_t, httplib::DataSink& sink) {
        return stream->send_next(sink);
      });
}

void answer_picture(const ApiContext& c, const Request& request, std::string_view name,
                    Response& response) {
  using namespace std::chrono_literals;
  const std::string view = known_view(c.session, name);
  const int width_px = wanted_width_px(request);
  const auto until = std::chrono::steady_clock::now() + 2s;
  std::shared_ptr<const Picture> picture;
  while (!picture && !c.stop.raised() && std::chrono::steady_clock::now() < until) {
    picture = c.session.next_picture(view, width_px, 0, 100ms);
  }
  if (!picture) throw BadRequest(503, "no picture came within two seconds");
  response.status = 200;
  response.set_header("Cache-Control", "no-store");
  response.set_content(reinterpret_cast<const char*>(picture->jpeg.data()), picture->jpeg.size(),
                       "image/jpeg");
}

/// The number of the last event a browser got before it was cut off; 0 for one that is new.
std::uint64_t last_event_number(const Request& request) {
  const std::string text = request.get_header_value("Last-Event-ID");
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? number : 0;
}

json with_streams(json state, const StreamSlots& slots) {
  state["streams"] = {{"open", slots.open()}, {"max", slots.most()}};
  return state;
}

}  // namespace

void add_api_routes(Routes& routes, const ApiContext& c) {
  // Answers with what `what` makes of a request.
  const auto add = [&routes](const char* method, const char* path, auto what) {
    routes.add(method, path, [what](const Request& request, std::string_view, Response& response) {
      answer_json(response, 200, what(request));
    });
  };
  add("GET", "/api/state",
      [c](const Request&) { return with_streams(c.session.state(), c.picture_slots); });
  add("POST", "/api/pause", [c](const Request& request) {
    return with_streams(c.session.pause(body_object(request)), c.picture_slots);
  });
  add("POST", "/api/step",
      [c](const Request&) { return with_streams(c.session.step(), c.picture_slots); });
  add("GET", "/api/colors", [c](const Request&) { return c.session.colors(); });
  add("PUT", "/api/colors",
      [c](const Request& request) { return c.session.change_colors(body_object(request)); });
  add("POST", "/api/undo", [c](const Request&) { return c.session.undo(); });
  add("POST", "/api/redo", [c](const Request&) { return c.session.redo(); });
  add("POST", "/api/save",
      [c](const Request& request) { return c.session.save(body_object(request)); });
  add("GET", "/api/density", [c](const Request&) { return c.session.density(); });
  add("GET", "/api/plane", [c](const Request&) { return c.session.plane(); });
  add("GET", "/api/explain", [c](const Request& request) {
    return c.session.explain(whole_number(request, "x"), whole_number(request, "y"));
  });

  routes.add("GET", "/api/picture/*.jpg",
             [c](const Request& request, std::string_view name, Response& response) {
               answer_picture(c, request, name, response);
             });
  routes.add("GET", "/api/stream/*.mjpg",
             [c](const Request& request, std::string_view name, Response& response) {
               auto stream = std::make_shared<PictureStream>(c.session, known_view(c.session, name),
                                                             wanted_width_px(request), c.stop);
               answer_stream(response, std::move(stream), slot_of(c.picture_slots));
             });
  routes.add(
      "GET", "/api/events", [c](const Request& request, std::string_view, Response& response) {
        auto stream = std::make_shared<EventStream>(c.session, last_event_number(request), c.stop);
        answer_stream(response, std::move(stream), slot_of(c.event_slots));
      });
}

}  // namespace maggic::studio
