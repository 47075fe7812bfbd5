#include "app/score_json.hpp"

#include <cmath>

namespace maggic::app {

OrderedJson to_json(const std::vector<Figure>& figures) {
  OrderedJson json = OrderedJson::object();
  for (const Figure& figure : figures) {
    json[figure.name] =
        figure.value ? OrderedJson(std::round(*figure.value * 1e6) / 1e6) : OrderedJson();
  }
  return json;
}

OrderedJson objects_json(const Scorecard& card, const Palette& palette) {
  OrderedJson objects = OrderedJson::array();
  for (const RobotTally& robot : card.each_robot()) {
    objects.push_back({{"name", name_of(robot.identity, palette)},
                       {"figures", to_json(robot_figures(robot.tally))}});
  }
  if (card.ball().frames > 0) {
    objects.push_back({{"name", "ball"}, {"figures", to_json(ball_figures(card.ball()))}});
  }
  return objects;
}

OrderedJson frames_json(const Scorecard& card, const RunSummary& summary) {
  return {{"judged", card.frames()},
          {"processed", summary.processed},
          {"dropped", summary.dropped},
          {"skipped", summary.skipped},
          {"failed", summary.failed}};
}

OrderedJson to_json(Tolerance tolerance) {
  return {{"distance", tolerance.distance},
          {"unit", tolerance.unit == Tolerance::Unit::kPixels ? "px" : "mm"}};
}

std::string json_text(const OrderedJson& json) {
  return json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + '\n';
}

}  // namespace maggic::app
