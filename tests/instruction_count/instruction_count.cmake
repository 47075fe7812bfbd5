# Counts the instructions of frame_path_work and compares them with the recorded ones. Called as
#   cmake -D VALGRIND=… -D PROGRAM=… -D PIPELINE=… -D RECORDED=… -D COMPILER=… [-D RECORD=ON]
#     -P instruction_count.cmake
# More than 3 % above fails, and so does more than 3 % below: a record that is too high would let
# the next slip pass unseen.
cmake_minimum_required(VERSION 3.25)

set(tolerance_percent 3)

function(recorded key value)
  file(STRINGS ${RECORDED} line REGEX "^${key}: ")
  if(NOT line)
    message(FATAL_ERROR "${RECORDED}: there is no line '${key}: …'")
  endif()
  string(REGEX REPLACE "^${key}: " "" line "${line}")
  set(${value} "${line}" PARENT_SCOPE)
endfunction()

if(NOT RECORD)
  recorded(compiler recorded_compiler)
  if(NOT COMPILER STREQUAL recorded_compiler)
    message("skipped: built by ${COMPILER}, recorded with ${recorded_compiler}")
    return()
  endif()
endif()

execute_process(
  COMMAND ${VALGRIND} --tool=callgrind --instr-atstart=no --callgrind-out-file=/dev/null
    ${PROGRAM} ${PIPELINE}
  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE log)
if(NOT result EQUAL 0 OR NOT log MATCHES "Collected : ([0-9]+)")
  message(FATAL_ERROR "counting the instructions failed (${result}):\n${output}${log}")
endif()
set(instructions ${CMAKE_MATCH_1})
string(STRIP "${output}" vectors)

if(RECORD)
  file(WRITE ${RECORDED} "\
# Instructions that the 20 frames of frame_path_work take, as callgrind counts them. Written by
#   cmake --build build/release --target record_instruction_count
compiler: ${COMPILER}
vector instructions: ${vectors}
instructions: ${instructions}
")
  message("recorded: ${instructions} instructions (${COMPILER}, ${vectors})")
  return()
endif()

recorded("vector instructions" recorded_vectors)
if(NOT vectors STREQUAL recorded_vectors)
  message("skipped: valgrind offers ${vectors} on this machine, recorded with ${recorded_vectors}")
  return()
endif()
recorded(instructions recorded_instructions)
math(EXPR per_mille
  "(1000 * ${instructions} + ${recorded_instructions} / 2) / ${recorded_instructions}")
math(EXPR percent "${per_mille} / 10")
math(EXPR tenths "${per_mille} % 10")
set(figures "${instructions} instructions, ${percent}.${tenths} % of the ${recorded_instructions} recorded")
math(EXPR most "1000 + 10 * ${tolerance_percent}")
math(EXPR least "1000 - 10 * ${tolerance_percent}")
set(how "cmake --build build/release --target record_instruction_count")
if(per_mille GREATER most)
  message(FATAL_ERROR "the frame path takes more than ${tolerance_percent} % more instructions: "
    "${figures}. Where that is worth it, record anew and say why:\n  ${how}")
endif()
if(per_mille LESS least)
  message(FATAL_ERROR "the frame path takes more than ${tolerance_percent} % fewer instructions: "
    "${figures}. Please record the better number:\n  ${how}")
endif()
message("${figures}")
