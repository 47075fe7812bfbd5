# A plugin made by `maggic new` builds against the installed package, passes its own test and runs in
# a pipeline. Called as
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

run("maggic new" ${maggic} new normalizer warm ${WORK})
run("configuring" ${CMAKE_COMMAND} -S ${WORK}/warm -B ${WORK}/build -G ${GENERATOR}
  -D CMAKE_PREFIX_PATH=${WORK}/prefix -D CMAKE_CXX_COMPILER=${COMPILER} "-DCMAKE_CXX_FLAGS=${FLAGS}")
run("building" ${CMAKE_COMMAND} --build ${WORK}/build)
run("testing" ${CMAKE_CTEST_COMMAND} --test-dir ${WORK}/build --output-on-failure
  --no-tests=error)

set(plugins ${WORK}/build/lib/maggic/plugins)
run("maggic plugins" ${maggic} plugins --plugin-path ${plugins})
expect_output("maggic plugins" "normalizer +warm +")
if(output MATCHES "refused")
  message(FATAL_ERROR "a plugin was refused:\n${output}")
endif()

file(WRITE ${WORK}/pipeline.yaml "
plugins: [${plugins}]
source: {synthetic_match: {frames: 5}}
normalizer: {warm: {gain: 1.2}}
segmenter: hue_pivots
tracker: two_tag
sinks: [{jsonl: {path: ${WORK}/out.jsonl}}]
")
run("maggic run" ${maggic} run ${WORK}/pipeline.yaml)
file(STRINGS ${WORK}/out.jsonl lines)
list(LENGTH lines count)
if(NOT count EQUAL 5)
  message(FATAL_ERROR "expected 5 lines in ${WORK}/out.jsonl, found ${count}")
endif()
file(REMOVE_RECURSE ${WORK})
