# maggic_add_plugin([SOURCES file...] [LIBRARIES target...] [TEST_SOURCES file...]
#                   [TEST_LIBRARIES target...])
#
# Makes the plugin of the current folder: <folder>.cpp, with SOURCES beside it where one file would
# grow too long, becomes <folder>.so, and <folder>_test.cpp, where it exists and testing is on, the
# test program <folder>_test, which loads the plugin like any host and runs under ctest. TEST_SOURCES
# are compiled into the test program: further tests, and those of SOURCES they test directly. Works
# in this tree and, through find_package(maggic), out of it.
function(maggic_add_plugin)
  cmake_parse_arguments(PLUGIN "" "" "SOURCES;LIBRARIES;TEST_SOURCES;TEST_LIBRARIES" ${ARGN})
  if(PLUGIN_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "maggic_add_plugin: unknown arguments ${PLUGIN_UNPARSED_ARGUMENTS}")
  endif()
  get_filename_component(name ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  set(plugin_dir ${CMAKE_BINARY_DIR}/lib/maggic/plugins)

  add_library(${name} MODULE ${name}.cpp ${PLUGIN_SOURCES})
  target_link_libraries(${name} PRIVATE maggic::maggic ${PLUGIN_LIBRARIES})
  target_compile_definitions(${name} PRIVATE MAGGIC_PLUGIN_NAME="${name}")
  set_target_properties(${name} PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${plugin_dir}
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  if(TARGET maggic_warnings)
    target_link_libraries(${name} PRIVATE maggic_warnings)
  endif()
  file(RELATIVE_PATH to_libraries /lib/maggic/plugins /${CMAKE_INSTALL_LIBDIR})
  set_target_properties(${name} PROPERTIES INSTALL_RPATH "$ORIGIN/${to_libraries}")
  install(TARGETS ${name} LIBRARY DESTINATION lib/maggic/plugins)
  set_property(GLOBAL APPEND PROPERTY MAGGIC_PLUGINS ${name})  # for tests that load them all

  if(BUILD_TESTING AND EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${name}_test.cpp)
    add_executable(${name}_test ${name}_test.cpp ${PLUGIN_TEST_SOURCES})
    target_link_libraries(${name}_test PRIVATE maggic::testing GTest::gmock_main
      ${PLUGIN_TEST_LIBRARIES})
    if(TARGET maggic_warnings)
      target_link_libraries(${name}_test PRIVATE maggic_warnings maggic_test_options)
    endif()
    add_dependencies(${name}_test ${name})
    add_test(NAME ${name}_test COMMAND ${name}_test)
    set_property(TEST ${name}_test APPEND PROPERTY ENVIRONMENT_MODIFICATION
      MAGGIC_PLUGIN_PATH=path_list_prepend:${plugin_dir})
  endif()
endfunction()
