#pragma once
/// What the templates of every kind share. @NAME@, @CLASS@ and @KIND@ are filled in.

#include <string_view>

namespace maggic::app::templates {

/// The two files that differ from kind to kind.
struct Plugin {
  std::string_view source;
  std::string_view test;
};

inline constexpr std::string_view kCMakeLists = R"cmake(
cmake_minimum_required(VERSION 3.25)
project(@NAME@ LANGUAGES CXX)

# On its own this folder needs the installed package; inside Maggic's tree everything is there.
if(NOT COMMAND maggic_add_plugin)
  if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release)
  endif()
  include(CTest)
  find_package(maggic REQUIRED)
  if(BUILD_TESTING)
    find_package(GTest REQUIRED)
  endif()
endif()

maggic_add_plugin()
)cmake";

inline constexpr std::string_view kReadme = R"md(
# @NAME@

A @KIND@ for Maggic. What it does and how it is configured stands on top of `@NAME@.cpp`.

Build and test it (leave `-D…` out where Maggic is installed in a usual place):

    cmake -S . -B build -D CMAKE_PREFIX_PATH=/where/maggic/is/installed
    cmake --build build
    ctest --test-dir build --output-on-failure

Use it: name it in a pipeline file, and tell `maggic` where it lies.

    maggic describe @NAME@ --plugin-path build/lib/maggic/plugins
    maggic run PIPELINE --plugin-path build/lib/maggic/plugins
)md";

}  // namespace maggic::app::templates
