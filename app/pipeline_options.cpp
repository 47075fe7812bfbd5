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

PluginRegistry make_registry(const CommandLine& line) {
  PluginRegistry registry;
  for (const fs::path& folder : line.plugin_folders) registry.add_folder(folder);
  return registry;
}

}  // namespace maggic::app
