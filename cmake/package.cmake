# `cmake --install` lays down the program, the libraries, their headers and what find_package(sigmascape) reads: the target of a
# room is sigmascape::<room>.
include(CMakePackageConfigHelpers)
install(TARGETS sigmascape_cli)
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

# The C interface as one library for what loads it as it runs: ctypes of Python, C#, MATLAB. Nothing else can be seen of it.
add_library(sigmascape_shared SHARED $<TARGET_OBJECTS:sigmascape_c_interface>)
set(exports ${CMAKE_CURRENT_LIST_DIR}/c_interface_exports.map)
set_target_properties(sigmascape_shared PROPERTIES
  OUTPUT_NAME sigmascape_c LINKER_LANGUAGE CXX LINK_DEPENDS ${exports}
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
target_link_libraries(sigmascape_shared PRIVATE sigmascape_c_interface sigmascape_options)
target_link_options(sigmascape_shared PRIVATE LINKER:--version-script=${exports})
install(TARGETS sigmascape_shared LIBRARY DESTINATION lib)
