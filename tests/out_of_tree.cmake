# A plugin of every kind made by `maggic new` builds against the installed package and passes its own
# test, and all five run together in a pipeline. Called as
#   cmake -D BUILD=… -D WORK=… -D GENERATOR=… -D COMPILER=… -D FLAGS=… -P out_of_tree.cmake
cmake_minimum_required(VERSION 3.25)

function(run what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${what} failed (${result}):\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(expect_output what text)
  if(NOT output MATCHES "${text}")
    message(FATAL_ERROR "${what}: expected '${text}' in\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
# The tests of this tree point to its plugins; what follows must find the installed ones by itself.
unset(ENV{MAGGIC_PLUGIN_PATH})

# Installed, then moved: nothing may depend on where it was installed first.
run("installing" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)
file(RENAME ${WORK}/first ${WORK}/prefix)
set(maggic ${WORK}/prefix/bin/maggic)

# One project for all of them: the compiler and OpenCV are looked for only once.
set(kinds source normalizer segmenter tracker sink)
set(project "cmake_minimum_required(VERSION 3.25)\nproject(all_kinds LANGUAGES CXX)\n"
  "include(CTest)\nfind_package(maggic REQUIRED)\nfind_package(GTest REQUIRED)\n")
foreach(kind ${kinds})
  run("maggic new ${kind}" ${maggic} new ${kind} new_${kind} ${WORK}/plugins)
  list(APPEND project "add_subdirectory(new_${kind})\n")
endforeach()
file(WRITE ${WORK}/plugins/CMakeLists.txt ${project})

set(configuration -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${WORK}/prefix
  -D CMAKE_CXX_COMPILER=${COMPILER} "-DCMAKE_CXX_FLAGS=${FLAGS}")
run("configuring one on its own" ${CMAKE_COMMAND} -S ${WORK}/plugins/new_sink -B ${WORK}/build_one
  ${configuration})
run("configuring" ${CMAKE_COMMAND} -S ${WORK}/plugins -B ${WORK}/build ${configuration})
run("building" ${CMAKE_COMMAND} --build ${WORK}/build)
run("testing" ${CMAKE_CTEST_COMMAND} --test-dir ${WORK}/build --output-on-failure
  --no-tests=error)

set(plugins ${WORK}/build/lib/maggic/plugins)
run("maggic plugins" ${maggic} plugins --plugin-path ${plugins})
foreach(kind ${kinds})
  expect_output("maggic plugins" "${kind} +new_${kind} +")
endforeach()
if(output MATCHES "refused")
  message(FATAL_ERROR "a plugin was refused:\n${output}")
endif()

file(WRITE ${WORK}/pipeline.yaml "
plugins: [${plugins}]
source: {new_source: {frames: 5}}
normalizer: new_normalizer
segmenter: new_segmenter
tracker: new_tracker
sinks:
  - jsonl: {path: ${WORK}/out.jsonl}
  - new_sink: {path: ${WORK}/out.csv}
")
run("maggic run" ${maggic} run ${WORK}/pipeline.yaml)
file(STRINGS ${WORK}/out.jsonl lines)
list(LENGTH lines count)
if(NOT count EQUAL 5)
  message(FATAL_ERROR "expected 5 lines in ${WORK}/out.jsonl, found ${count}")
endif()
file(REMOVE_RECURSE ${WORK})
