#pragma once
/// How a shared library becomes a plugin: one line at the end of its source file.
///
///     MAGGIC_PLUGIN(MyNormalizer, "what it does, in one line")
///
/// The class must derive from one of the kinds (ColorNormalizer, ImageNormalizer, ColorSegmenter,
/// ImageSegmenter, Tracker, Source, Sink) and be default-constructible. The plugin's name is its
/// folder's: `maggic_add_plugin()` passes it in as MAGGIC_PLUGIN_NAME.

#include <cstdint>
#include <exception>
#include <type_traits>
#include <vector>  // Boost 1.74's library_info.hpp forgets it under BOOST_DLL_USE_STD_FS

#include <boost/dll/alias.hpp>

#include "maggic/normalizer.hpp"
#include "maggic/segmenter.hpp"
#include "maggic/sink.hpp"
#include "maggic/source.hpp"
#include "maggic/tracker.hpp"

/// Compiler, its ABI and the standard library: what must agree for C++ objects to cross the
/// library's border.
#if defined(__GLIBCXX__)
#define MAGGIC_STANDARD_LIBRARY "libstdc++"
#elif defined(_LIBCPP_VERSION)
#define MAGGIC_STANDARD_LIBRARY "libc++"
#else
#define MAGGIC_STANDARD_LIBRARY "unknown"
#endif
#define MAGGIC_STRINGIZE_(x) #x
#define MAGGIC_STRINGIZE(x) MAGGIC_STRINGIZE_(x)
#define MAGGIC_TOOLCHAIN                                                     \
  MAGGIC_STANDARD_LIBRARY " cxxabi " MAGGIC_STRINGIZE(__GXX_ABI_VERSION) " c++" \
      MAGGIC_STRINGIZE(__cplusplus)

namespace maggic {

/// Raised whenever a class in this SDK changes its layout or its virtual functions. It is part of
/// the exported symbol's name, so a plugin of another ABI is refused before a line of it runs.
inline constexpr int kPluginAbi = 1;

/// Receives what a guarded call threw; `message` is valid for the call only.
using PluginErrorSink = void (*)(void* context, const char* message);

/// What a plugin's library exports. Plain data and function pointers only; `size` first, so that
/// it can be checked before anything else is read.
struct PluginDescriptor {
  std::uint32_t size;           ///< sizeof(PluginDescriptor) as the plugin was compiled.
  const char* toolchain;        ///< MAGGIC_TOOLCHAIN as the plugin was compiled.
  StageKind kind;
  const char* name;             ///< Equals the file's name without `.so`.
  const char* summary;          ///< One line for `maggic plugins`.
  /// Creates a stage; null after telling `on_error` when the constructor threw. The exception
  /// never leaves the library.
  Stage* (*create)(PluginErrorSink on_error, void* context);
  void (*destroy)(Stage* stage) noexcept;
};

namespace detail {

template <class T>
constexpr StageKind kind_of() {
  if constexpr (std::is_base_of_v<Source, T>) return StageKind::kSource;
  else if constexpr (std::is_base_of_v<Normalizer, T>) return StageKind::kNormalizer;
  else if constexpr (std::is_base_of_v<Segmenter, T>) return StageKind::kSegmenter;
  else if constexpr (std::is_base_of_v<Tracker, T>) return StageKind::kTracker;
  else {
    static_assert(std::is_base_of_v<Sink, T>, "a plugin derives from one of the stage kinds");
    return StageKind::kSink;
  }
}

template <class T>
Stage* create_guarded(PluginErrorSink on_error, void* context) {
  try {
    return new T();
  } catch (const std::exception& e) {
    on_error(context, e.what());
  } catch (...) {
    on_error(context, "an exception that is not a std::exception");
  }
  return nullptr;
}

}  // namespace detail
}  // namespace maggic

#ifndef MAGGIC_PLUGIN_NAME
#define MAGGIC_PLUGIN_NAME "unnamed"
#endif

/// Exports `Class` as this library's plugin. Exactly once a library, at global scope.
#define MAGGIC_PLUGIN(Class, summary_text)                                       \
  namespace {                                                                    \
  const ::maggic::PluginDescriptor maggic_plugin_descriptor{                     \
      sizeof(::maggic::PluginDescriptor),                                        \
      MAGGIC_TOOLCHAIN,                                                          \
      ::maggic::detail::kind_of<Class>(),                                        \
      MAGGIC_PLUGIN_NAME,                                                        \
      summary_text,                                                              \
      &::maggic::detail::create_guarded<Class>,                                  \
      [](::maggic::Stage* stage) noexcept { delete stage; }};                    \
  }                                                                              \
  BOOST_DLL_ALIAS(maggic_plugin_descriptor, maggic_plugin_v1)
