# Every dependency is a Debian 12 package (names in cmake/debian-packages.txt); nothing is vendored.
find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc imgcodecs videoio)  # pictures, geometry, codecs
find_package(yaml-cpp 0.7 REQUIRED)        # YAML events with places; we build the tree ourselves
find_package(Boost 1.74 REQUIRED)          # headers only: DLL, static_vector, intrusive_ptr
find_package(fmt 9 REQUIRED)               # text formatting that is checked at compile time
find_package(nlohmann_json 3.11 REQUIRED)  # JSON Lines out, truth and reports in
find_package(ZLIB REQUIRED)                # pictures of reports as PNG
find_package(CLI11 2.1 REQUIRED)           # command line of the program, one translation unit
find_package(PkgConfig REQUIRED)           # for httplib, whose flags have to be those it was built with
pkg_check_modules(httplib REQUIRED IMPORTED_TARGET cpp-httplib>=0.11)  # HTTP for Maggic Studio
# Pictures for Maggic Studio: OpenCV's imgcodecs would make every start of the program 0.2 s longer.
pkg_check_modules(turbojpeg REQUIRED IMPORTED_TARGET libturbojpeg)
find_package(hwy 1.0.3 REQUIRED)          # vector instructions, chosen when the program runs
find_package(Protobuf 3.21 REQUIRED)       # packets of the network sinks: protoc and light runtime
find_package(Threads REQUIRED)
if(BUILD_TESTING)
  find_package(GTest 1.12 REQUIRED)        # tests
  find_package(rapidcheck REQUIRED)        # property tests
  # python3 is looked for by the tests that need it: a client of the network sinks.
endif()
if(MAGGIC_BENCH)
  find_package(benchmark 1.7 REQUIRED)     # benchmarks
endif()

# yaml-cpp 0.7 exports a bare target.
if(NOT TARGET yaml-cpp::yaml-cpp)
  add_library(yaml-cpp::yaml-cpp ALIAS yaml-cpp)
endif()

# OpenCV 4.6's headers warn under C++20 and Debian's targets do not carry their include folder as a
# system one.
add_library(maggic_opencv INTERFACE)
target_include_directories(maggic_opencv SYSTEM INTERFACE
  $<BUILD_INTERFACE:${OpenCV_INCLUDE_DIRS}>)
target_link_libraries(maggic_opencv INTERFACE opencv_core opencv_imgproc)
