# `cmake --install` lays down the libraries, their headers and what find_package(sigmascape) reads: the target of a room is
# sigmascape::<room>.
include(CMakePackageConfigHelpers)
set(package_folder lib/cmake/sigmascape)
get_property(rooms GLOBAL PROPERTY SIGMASCAPE_ROOMS)
list(TRANSFORM rooms PREPEND sigmascape_ OUTPUT_VARIABLE room_targets)
install(TARGETS ${room_targets} sigmascape_options EXPORT sigmascape ARCHIVE DESTINATION lib)
install(EXPORT sigmascape NAMESPACE sigmascape:: FILE sigmascape-targets.cmake DESTINATION ${package_folder})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/sigmascape DESTINATION include FILES_MATCHING PATTERN "*.h")
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/sigmascape-config.cmake.in ${PROJECT_BINARY_DIR}/sigmascape-config.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/sigmascape-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/sigmascape-config.cmake ${PROJECT_BINARY_DIR}/sigmascape-config-version.cmake
              ${CMAKE_CURRENT_LIST_DIR}/dependencies.cmake DESTINATION ${package_folder})
