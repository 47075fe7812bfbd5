#include "studio/session/color_editor.hpp"

#include <array>
#include <exception>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "maggic/atomic_file.hpp"
#include "maggic/config_error.hpp"
#include "studio/session/bad_request.hpp"

namespace maggic::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostSteps = 200;
constexpr std::chrono::milliseconds kPatience{500};

// Changes that follow each other so closely are one: a pivot that is dragged.
constexpr std::chrono::milliseconds kOneDrag{700};

// The path that a mistake's message begins with, "pivots.red[0]: …"; empty when it has none.
std::string_view path_in(std::string_view message) {
  constexpr std::string_view kOfPaths = "abcdefghijklmnopqrstuvwxyz0123456789_.[]";
  const std::size_t end = message.find(": ");
  if (end == std::string_view::npos) return {};
  const std::string_view path = message.substr(0, end);
  return path.find_first_not_of(kOfPaths) == std::string_view::npos ? path : std::string_view();
}

/// @param segmenter whose parameters the paths in messages are.
BadRequest refusal(const ConfigError& error, std::string_view segmenter) {
  nlohmann::json mistakes = nlohmann::json::array();
  for (const Mistake& mistake : error.mistakes()) {
    const std::string_view path = path_in(mistake.message);
    const std::string key = path.empty() ? "" : fmt::format("segmenter.{}.{}", segmenter, path);
    mistakes.push_back({{"key", key}, {"message", mistake.message}});
  }
  return {422, nlohmann::json{{"mistakes", std::move(mistakes)}}};
}

std::vector<std::string> keys_of(const nlohmann::json& change) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : change.items()) {
    if (key != "revision") keys.push_back(key);
  }
  return keys;
}

// Sections that only a new start can change.
constexpr std::array<std::string_view, 4> kOfTheRun{"source", "sinks", "palette", "plugins"};
// Sections that tracks and followed light depend on.
constexpr std::array<std::string_view, 3> kOfHistory{"tracker", "field", "light"};

template <std::size_t kCount>
bool same(const Node& a, const Node& b, const std::array<std::string_view, kCount>& sections) {
  const auto text = [](const Node* node) { return node != nullptr ? to_yaml(*node) : ""; };
  for (const std::string_view section : sections) {
    if (text(a.find(section)) != text(b.find(section))) return false;
  }
  return true;
}

bool lies_within(const fs::path& file, const fs::path& folder) {
  const fs::path relative = file.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

ColorEditor::ColorEditor(PipelineRequest request, const Pipeline& running,
                         PipelineExchange& exchange, PluginRegistry& registry, Reporter& reporter,
                         EventLog& events)
    : request_(std::move(request)),
      exchange_(exchange),
      registry_(registry),
      reporter_(reporter),
      events_(events),
      compile_time_(running.table_compile_time()) {
  std::vector<Mistake> notes;
  read_at_ = file_times();
  now_ = {merged_document(request_, notes), color_stages(running.parts())};
  saved_settings_ = color_settings(now_.stages);
}

nlohmann::json ColorEditor::colors() const {
  const std::lock_guard lock(mutex_);
  return answer();
}

nlohmann::json ColorEditor::answer() const {
  nlohmann::json told = color_settings(now_.stages);
  told["unsaved"] = told != saved_settings_;
  told["revision"] = revision_;
  told["undo"] = undo_.size();
  told["redo"] = redo_.size();
  told["compile_ms"] = std::chrono::duration<double, std::milli>(compile_time_).count();
  return told;
}

nlohmann::json ColorEditor::change(const nlohmann::json& change) {
  const std::lock_guard lock(mutex_);
  const auto began = std::chrono::steady_clock::now();
  if (change.is_object() && change.contains("revision") && change["revision"] != revision_) {
    throw BadRequest(409, fmt::format("found a change of revision {}, which is now {}: look again "
                                      "first",
                                      change["revision"].dump(), revision_));
  }
  Node document = now_.document;
  try {
    change_colors(document, change);
  } catch (const ConfigError& e) {
    throw refusal(e, plugin_in(now_.document, "segmenter"));
  }
  Version before = use_or_refuse(std::move(document));
  std::vector<std::string> keys = keys_of(change);
  if (undo_.empty() || keys != last_keys_ || began - last_change_ > kOneDrag) {
    undo_.push_back(std::move(before));
  }
  if (undo_.size() > kMostSteps) undo_.erase(undo_.begin());
  last_keys_ = std::move(keys);
  last_change_ = std::chrono::steady_clock::now();
  redo_.clear();
  tell_of_change();
  return answer();
}

nlohmann::json ColorEditor::undo() {
  const std::lock_guard lock(mutex_);
  return step(undo_, redo_, "there is nothing to undo");
}

nlohmann::json ColorEditor::redo() {
  const std::lock_guard lock(mutex_);
  return step(redo_, undo_, "there is nothing to redo");
}

nlohmann::json ColorEditor::step(std::vector<Version>& from, std::vector<Version>& to,
                                 std::string_view nothing_left) {
  if (from.empty()) throw BadRequest(409, std::string(nothing_left));
  last_keys_.clear();
  to.push_back(use_or_refuse(from.back().document));
  from.pop_back();
  tell_of_change();
  return answer();
}

void ColorEditor::tell_of_change() {
  ++revision_;
  events_.add("settings", nlohmann::json{{"revision", revision_}}.dump());
}

ColorEditor::Version ColorEditor::use(Node document) {
  BuiltPipeline built = build_pipeline(document, registry_, reporter_);
  ColorStages stages = color_stages(built.pipeline->parts());
  compile_time_ = built.pipeline->table_compile_time();
  const History history =
      same(document, now_.document, kOfHistory) ? History::kKept : History::kNew;
  exchange_.offer(std::move(built.pipeline), history, kPatience);
  return std::exchange(now_, {std::move(document), std::move(stages)});
}

ColorEditor::Version ColorEditor::use_or_refuse(Node document) {
  const std::string segmenter = plugin_in(document, "segmenter");
  try {
    return use(std::move(document));
  } catch (const ConfigError& e) {
    throw refusal(e, segmenter);
  } catch (const StageError& e) {
    throw BadRequest(422, e.what());
  }
}

nlohmann::json ColorEditor::save(const nlohmann::json& request) {
  const std::lock_guard lock(mutex_);
  const fs::path file = file_to_save(request);
  std::error_code error;
  Node calibration;
  try {
    PipelineRequest without = request_;
    without.calibration.reset();
    std::vector<Mistake> notes;
    const Node pipeline = merged_document(without, notes);
    if (fs::exists(file, error)) calibration = load_document(file);
    write_colors(calibration, pipeline, now_.stages);
  } catch (const ConfigError& e) {
    throw refusal(e, plugin_in(now_.document, "segmenter"));
  }
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  const std::string text = fmt::format(
      "# Colours as set in Maggic Studio on {:%Y-%m-%d at %H:%M}; lay it over the pipeline:\n"
      "#   maggic run {} --calibration {}\n{}\n",
      fmt::localtime(now), request_.pipeline.stem().string(), file.filename().string(),
      to_yaml(calibration));
  try {
    write_file_atomically(file, text);
  } catch (const std::exception& e) {
    throw BadRequest(422, e.what());
  }
  request_.calibration = file;
  read_at_ = file_times();
  saved_settings_ = color_settings(now_.stages);
  tell_of_change();
  return {{"file", fs::absolute(file).string()}};
}

fs::path ColorEditor::file_to_save(const nlohmann::json& request) const {
  const bool names_one = request.is_object() && request.contains("file");
  if (!names_one) {
    if (request_.calibration) return *request_.calibration;
    throw BadRequest(422,
                     "found no file to save to, expected its name: no calibration was given "
                     "when the Studio was started");
  }
  if (!request["file"].is_string() || request["file"].get<std::string>().empty()) {
    throw BadRequest(422, "file: found no name, expected one such as venue.yaml");
  }
  const fs::path folder = fs::weakly_canonical(fs::current_path());
  const fs::path file = fs::weakly_canonical(folder / request["file"].get<std::string>());
  if (request_.calibration && file == fs::weakly_canonical(*request_.calibration)) return file;
  if (!lies_within(file, folder) || file == folder) {
    throw BadRequest(422, fmt::format("file: found {}, expected a file within {}",
                                      request["file"].dump(), folder.string()));
  }
  if (file.extension() != ".yaml" && file.extension() != ".yml") {
    throw BadRequest(422, fmt::format("file: found {}, expected a name that ends with .yaml",
                                      request["file"].dump()));
  }
  if (file == fs::weakly_canonical(request_.pipeline)) {
    throw BadRequest(422, "file: found the pipeline itself, expected a calibration file beside it");
  }
  return file;
}

ColorEditor::FileTimes ColorEditor::file_times() const {
  FileTimes times;
  const auto add = [&](const fs::path& file) {
    std::error_code error;
    const auto time = fs::last_write_time(file, error);
    times.push_back(error ? std::nullopt : std::optional(time));
  };
  add(request_.pipeline);
  if (request_.calibration) add(*request_.calibration);
  return times;
}

void ColorEditor::follow_files() {
  const std::lock_guard lock(mutex_);
  FileTimes times = file_times();
  if (times == read_at_) return;
  read_at_ = std::move(times);
  try {
    reload();
    events_.tell("note", "the pipeline's files were changed and are in use");
  } catch (const std::exception& e) {
    events_.tell("error", fmt::format("a file was changed and is not used:\n{}", e.what()));
  }
}

void ColorEditor::reload() {
  std::vector<Mistake> notes;
  Node document = merged_document(request_, notes);
  if (!same(document, now_.document, kOfTheRun)) {
    throw std::runtime_error(
        "source, sinks, palette and plugin folders are taken at the start: please "
        "start the Studio again");
  }
  undo_.push_back(use(std::move(document)));
  last_keys_.clear();
  redo_.clear();
  saved_settings_ = color_settings(now_.stages);
  tell_of_change();
}

}  // namespace maggic::studio
