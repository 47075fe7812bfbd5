#include "plugin/plugin_library.hpp"

#include <dlfcn.h>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "maggic/plugin.hpp"
#include "plugin/elf_file.hpp"

namespace maggic {
namespace {

constexpr std::string_view kAlias = MAGGIC_STRINGIZE(MAGGIC_PLUGIN_ALIAS);
/// What the aliases of every ABI begin with.
constexpr std::string_view kAliasStem = "maggic_plugin_v";
static_assert(kAlias.starts_with(kAliasStem));

[[noreturn]] void refuse(std::string reason) { throw std::runtime_error(std::move(reason)); }

void check_alias(const std::filesystem::path& file) {
  const std::vector<std::string> symbols = ElfFile(file).exported_symbols();
  if (std::ranges::find(symbols, kAlias) != symbols.end()) return;
  const auto other = std::ranges::find_if(
      symbols, [](const std::string& name) { return name.starts_with(kAliasStem); });
  if (other == symbols.end()) {
    refuse("is not a Maggic plugin: it does not end in a MAGGIC_PLUGIN line");
  }
  refuse(fmt::format("is built for plugin ABI {}, this program speaks {}: build it again",
                     other->substr(kAliasStem.size()), kPluginAbi));
}

/// The loader's own words, without the file name they begin with.
std::string loader_message(const std::filesystem::path& file) {
  const char* const text = ::dlerror();
  if (text == nullptr) return "for an unknown reason";
  std::string_view message = text;
  const std::string prefix = file.string() + ": ";
  if (message.starts_with(prefix)) message.remove_prefix(prefix.size());
  return std::string(message);
}

boost::dll::shared_library open_library(const std::filesystem::path& file) {
  boost::dll::shared_library library;
  std::error_code error;
  // rtld_now: a missing symbol is an error here and not a crash in the middle of a match.
  library.load(file, error, boost::dll::load_mode::rtld_now);
  if (error) refuse("cannot be opened: " + loader_message(file));
  return library;
}

}  // namespace

PluginLibrary::PluginLibrary(const std::filesystem::path& file) {
  check_alias(file);
  library_ = open_library(file);
  descriptor_ = library_.get<const PluginDescriptor*>(std::string(kAlias));
  info_.file = file;
  info_.name = file.stem().string();
  check_descriptor();
  info_.kind = descriptor_->kind;
  info_.summary = descriptor_->summary;
}

void PluginLibrary::check_descriptor() const {
  if (descriptor_ == nullptr) refuse("has no descriptor");
  if (descriptor_->size != sizeof(PluginDescriptor)) {
    refuse(fmt::format("has a descriptor of {} bytes, expected {}: build it again",
                       descriptor_->size, sizeof(PluginDescriptor)));
  }
  const auto or_nothing = [](const char* text) { return text == nullptr ? "nothing" : text; };
  const std::string_view toolchain = or_nothing(descriptor_->toolchain);
  if (toolchain != MAGGIC_TOOLCHAIN) {
    refuse(fmt::format("is built with '{}', this program with '{}': build it again", toolchain,
                       MAGGIC_TOOLCHAIN));
  }
  const std::string_view name = or_nothing(descriptor_->name);
  if (name != info_.name) {
    refuse(fmt::format("calls itself '{}', expected '{}' as the file is named", name, info_.name));
  }
  if (descriptor_->kind < StageKind::kSource || descriptor_->kind > StageKind::kSink) {
    refuse(fmt::format("is of unknown kind {}", static_cast<int>(descriptor_->kind)));
  }
  if (descriptor_->summary == nullptr || descriptor_->create == nullptr ||
      descriptor_->destroy == nullptr) {
    refuse("has an incomplete descriptor: summary, create and destroy are expected");
  }
}

Stage* PluginLibrary::create() const {
  std::string reason = "it returned nothing";
  Stage* const stage = descriptor_->create(
      [](void* context, const char* message) { *static_cast<std::string*>(context) = message; },
      &reason);
  if (stage == nullptr) {
    throw PluginError(fmt::format("plugin '{}' ({}) cannot be created: {}", info_.name,
                                  info_.file.string(), reason));
  }
  return stage;
}

void PluginLibrary::destroy(Stage* stage) const noexcept { descriptor_->destroy(stage); }

}  // namespace maggic
