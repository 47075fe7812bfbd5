#include "app/pipeline_options.hpp"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/source_argument.hpp"

namespace maggic::app {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_directory(path, ignored);
}

std::vector<std::string> names_in(const std::vector<fs::path>& folders) {
  std::vector<std::string> names;
  for (const fs::path& folder : folders) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem());
    }
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

constexpr std::string_view kStandardOutput = "-";

/// The `path` of the one plugin in `stage`, if it has one.
const Node* path_of(const Node& stage) {
  for (const Node::Entry& entry : stage.entries) {
    if (const Node* path = entry.value.find("path")) return path;
  }
  return nullptr;
}

std::vector<const Node*> sink_paths(const Node& document) {
  std::vector<const Node*> paths;
  const Node* sinks = document.find("sinks");
  if (sinks == nullptr) return paths;
  for (const Node& sink : sinks->items) {
    if (const Node* path = path_of(sink)) paths.push_back(path);
  }
  return paths;
}

/// Links count as what they lead to; files that do not exist yet are compared by name.
bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code failed;
  if (fs::equivalent(a, b, failed) && !failed) return true;
  const fs::path whole_a = fs::weakly_canonical(fs::absolute(a, failed), failed);
  if (failed) return false;
  const fs::path whole_b = fs::weakly_canonical(fs::absolute(b, failed), failed);
  return !failed && whole_a == whole_b;
}

bool same_output(const std::string& a, const std::string& b) {
  if (a == kStandardOutput || b == kStandardOutput) return a == b;
  return same_file(a, b);
}

std::string_view without_file_scheme(std::string_view path) {
  constexpr std::string_view kScheme = "file://";
  return path.starts_with(kScheme) ? path.substr(kScheme.size()) : path;
}

Mistake mistake_at(const Place& place, std::string message) {
  return {place.file, place.line, place.column, std::move(message)};
}

std::string to_string(const Place& place) {
  if (place.line == 0) return place.file;
  return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

}  // namespace

std::vector<fs::path> pipeline_folders() {
  std::vector<fs::path> folders{"pipelines"};
  std::error_code failed;
  const fs::path program = fs::read_symlink("/proc/self/exe", failed);
  if (!failed) folders.push_back(program.parent_path().parent_path() / "share/maggic/pipelines");
  return folders;
}

fs::path find_configuration(std::string_view name, const std::vector<fs::path>& folders) {
  if (is_file(name)) return name;
  for (const fs::path& folder : folders) {
    const fs::path plain = folder / name;
    if (is_file(plain)) return plain;
    fs::path with_extension = plain;
    with_extension += ".yaml";
    if (is_file(with_extension)) return with_extension;
  }
  std::error_code ignored;
  if (!name.empty() && fs::exists(name, ignored)) return name;  // a folder: reading it says so
  const std::vector<std::string> known = names_in(folders);
  throw ConfigError(
      {{std::string(name), 0, 0,
        known.empty() ? "no such file"
                      : fmt::format("no such file (known names: {})", fmt::join(known, ", "))}});
}

PipelineRequest make_request(const PipelineOptions& options) {
  PipelineRequest request;
  std::vector<fs::path> folders = pipeline_folders();
  request.pipeline = find_configuration(options.pipeline, folders);
  if (options.calibration) {
    for (fs::path& folder : folders) folder /= "calibrations";
    request.calibration = find_configuration(*options.calibration, folders);
  }
  request.assignments = options.assignments;
  if (options.source) request.source = source_from_argument(*options.source);
  return request;
}

Node sink_node(std::string_view plugin, std::string_view path, std::string_view flag) {
  Node text;
  text.kind = Node::Kind::kScalar;
  text.place.file = flag;
  text.scalar = path;
  text.quoted = true;  // a file may be called 12
  Node parameters;
  parameters.kind = Node::Kind::kMap;
  parameters.place = text.place;
  parameters.entries.push_back({"path", text.place, text});
  Node sink;
  sink.kind = Node::Kind::kMap;
  sink.place = text.place;
  sink.entries.push_back({std::string(plugin), text.place, parameters});
  return sink;
}

void check_outputs(const Node& document, const std::vector<fs::path>& configuration) {
  const Node* source = document.find("source");
  const Node* read = source != nullptr ? path_of(*source) : nullptr;
  const std::vector<const Node*> written = sink_paths(document);
  std::vector<Mistake> mistakes;
  for (auto sink = written.begin(); sink != written.end(); ++sink) {
    const Node& path = **sink;
    if (read != nullptr && path.scalar != kStandardOutput &&
        same_file(path.scalar, without_file_scheme(read->scalar))) {
      mistakes.push_back(mistake_at(
          path.place, fmt::format("writing '{}' would destroy what the source reads, '{}' ({})",
                                  path.scalar, read->scalar, to_string(read->place))));
    }
    for (const fs::path& file : configuration) {
      if (path.scalar == kStandardOutput || !same_file(path.scalar, file)) continue;
      mistakes.push_back(mistake_at(
          path.place,
          fmt::format("writing '{}' would destroy a file the run is configured by", path.scalar)));
    }
    const auto other = std::find_if(written.begin(), sink, [&](const Node* earlier) {
      return same_output(earlier->scalar, path.scalar);
    });
    if (other != sink) {
      mistakes.push_back(mistake_at(
          path.place, fmt::format("'{}' is already written by another sink, as '{}' ({})",
                                  path.scalar, (*other)->scalar, to_string((*other)->place))));
    }
  }
  if (!mistakes.empty()) throw ConfigError(std::move(mistakes));
}

void check_report(const fs::path& report, std::string_view flag,
                  const std::vector<fs::path>& inputs) {
  const auto refuse = [&](std::string message) {
    throw ConfigError({{std::string(flag), 0, 0, std::move(message)}});
  };
  std::error_code ignored;
  const fs::path folder = report.parent_path();
  if (!folder.empty() && !fs::is_directory(folder, ignored)) {
    refuse(fmt::format("cannot write '{}': folder {} does not exist", report.string(),
                       folder.string()));
  }
  if (fs::is_directory(report, ignored)) {
    refuse(fmt::format("cannot write '{}': it is a folder", report.string()));
  }
  for (const fs::path& input : inputs) {
    if (!same_file(report, input)) continue;
    refuse(fmt::format("writing '{}' would destroy '{}', which is read", report.string(),
                       input.string()));
  }
}

std::optional<std::string> source_path(const Node& document) {
  const Node* source = document.find("source");
  const Node* path = source != nullptr ? path_of(*source) : nullptr;
  if (path == nullptr) return std::nullopt;
  return std::string(without_file_scheme(path->scalar));
}

bool writes_to_stdout(const Node& document) {
  return std::ranges::any_of(sink_paths(document),
                             [](const Node* path) { return path->scalar == kStandardOutput; });
}

PluginRegistry make_registry(const CommandLine& line) {
  PluginRegistry registry;
  for (const fs::path& folder : line.plugin_folders) registry.add_folder(folder);
  return registry;
}

}  // namespace maggic::app
