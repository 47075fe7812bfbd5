# How every target of this project is compiled.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

option(MAGGIC_WARNINGS_AS_ERRORS "Treat warnings as errors" OFF)
set(MAGGIC_SANITIZE "" CACHE STRING "Sanitizers for everything, e.g. address,undefined")
option(MAGGIC_BENCH "Build the Google Benchmark programs" OFF)
option(MAGGIC_FUZZ "Build the libFuzzer targets (clang only)" OFF)

find_program(MAGGIC_CCACHE ccache)
if(MAGGIC_CCACHE)
  # ccache takes precompiled headers only when it need not look at their defines and times.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
    CCACHE_SLOPPINESS=pch_defines,time_macros ${MAGGIC_CCACHE})
endif()

# Warnings are for our own targets alone, hence a target to link rather than global flags. Members left
# out of a designated initializer have defaults on purpose.
add_library(maggic_warnings INTERFACE)
target_compile_options(maggic_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
  -Wno-sign-conversion -Wno-missing-field-initializers -Wnon-virtual-dtor -Woverloaded-virtual)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # g++ 12 sees these inside std::string where there is nothing (GCC bugs 105562 and 105651).
  target_compile_options(maggic_warnings INTERFACE -Wno-restrict -Wno-maybe-uninitialized)
endif()
if(MAGGIC_WARNINGS_AS_ERRORS)
  target_compile_options(maggic_warnings INTERFACE -Werror)
endif()

if(MAGGIC_SANITIZE)
  add_compile_options(-fsanitize=${MAGGIC_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${MAGGIC_SANITIZE})
endif()

# What most test programs include, compiled once, tests themselves hardly optimised and not watched for
# undefined behaviour: all only to shorten the build. What is tested is compiled as ever.
add_library(maggic_test_options INTERFACE)
target_compile_options(maggic_test_options INTERFACE -O1
  $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
if(MAGGIC_SANITIZE MATCHES undefined)
  target_compile_options(maggic_test_options INTERFACE -fno-sanitize=undefined)
endif()
