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
#include <vector>  // Boost 1.74's library_info.hpp forgets it under BOOST_DLL_USE_STD_FS

#include <boost/dll/alias.hpp>
#include <opencv2/core/version.hpp>

#include "maggic/stage_kind_of.hpp"

/// Raised whenever a class in this SDK changes its layout or its virtual functions. It is part of
/// the exported symbol's name, so a plugin of another ABI is refused before a line of it runs.
#define MAGGIC_PLUGIN_ABI 3

#define MAGGIC_STRINGIZE_(x) #x
#define MAGGIC_STRINGIZE(x) MAGGIC_STRINGIZE_(x)
#define MAGGIC_JOIN_(a, b) a##b
#define MAGGIC_JOIN(a, b) MAGGIC_JOIN_(a, b)

/// The name under which a plugin exports its descriptor.
#define MAGGIC_PLUGIN_ALIAS MAGGIC_JOIN(maggic_plugin_v, MAGGIC_PLUGIN_ABI)

/// Compiler, its ABI, the standard library with the switches that change its classes, and OpenCV,
/// whose cv::Mat stages exchange: what must agree for C++ objects to cross the library's border.
#if defined(__GLIBCXX__)
#define MAGGIC_STANDARD_LIBRARY "libstdc++"
#elif defined(_LIBCPP_VERSION)
#define MAGGIC_STANDARD_LIBRARY "libc++"
#else
#define MAGGIC_STANDARD_LIBRARY "unknown"
#endif
#ifdef _GLIBCXX_USE_CXX11_ABI
#define MAGGIC_STRING_ABI " cxx11 " MAGGIC_STRINGIZE(_GLIBCXX_USE_CXX11_ABI)
#else
#define MAGGIC_STRING_ABI ""
#endif
#ifdef _GLIBCXX_DEBUG
#define MAGGIC_CHECKED_CONTAINERS " debug"
#else
#define MAGGIC_CHECKED_CONTAINERS ""
#endif
#define MAGGIC_TOOLCHAIN                                                              \
  MAGGIC_STANDARD_LIBRARY MAGGIC_STRING_ABI MAGGIC_CHECKED_CONTAINERS                 \
  " cxxabi " MAGGIC_STRINGIZE(__GXX_ABI_VERSION)                                      \
  " c++" MAGGIC_STRINGIZE(__cplusplus)                                                \
  " opencv " MAGGIC_STRINGIZE(CV_VERSION_MAJOR) "." MAGGIC_STRINGIZE(CV_VERSION_MINOR)

namespace maggic {

inline constexpr int kPluginAbi = MAGGIC_PLUGIN_ABI;

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
      ::maggic::stage_kind_of<Class>(),                                        \
      MAGGIC_PLUGIN_NAME,                                                        \
      summary_text,                                                              \
      &::maggic::detail::create_guarded<Class>,                                  \
      [](::maggic::Stage* stage) noexcept { delete stage; }};                    \
  }                                                                              \
  BOOST_DLL_ALIAS(maggic_plugin_descriptor, MAGGIC_PLUGIN_ALIAS)
