# Installs the program, the library with its headers, the plugins, the ready pipelines, and the CMake
# package `maggic` that plugins out of this tree are built with. Everything finds everything else by
# relative paths, so an installation can be moved.
include(CMakePackageConfigHelpers)
set(MAGGIC_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/maggic)

set_target_properties(maggic_opencv PROPERTIES EXPORT_NAME opencv)
install(TARGETS maggic maggic_testing maggic_opencv EXPORT maggicTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT maggicTargets NAMESPACE maggic:: DESTINATION ${MAGGIC_PACKAGE_DIR})
install(DIRECTORY framework/include/maggic DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY pipelines DESTINATION ${CMAKE_INSTALL_DATADIR}/maggic)

configure_package_config_file(cmake/maggicConfig.cmake.in ${PROJECT_BINARY_DIR}/maggicConfig.cmake
  INSTALL_DESTINATION ${MAGGIC_PACKAGE_DIR})
# Before 1.0 every minor version may change the plugin ABI.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/maggicConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/maggicConfig.cmake
  ${PROJECT_BINARY_DIR}/maggicConfigVersion.cmake cmake/maggic_add_plugin.cmake
  DESTINATION ${MAGGIC_PACKAGE_DIR})
