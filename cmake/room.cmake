# What nearly every file reads, compiled once. Files include it all the same, which tests/architecture holds them to.
add_library(sigmascape_standard_headers OBJECT ${CMAKE_CURRENT_LIST_DIR}/standard_headers.cpp)
target_link_libraries(sigmascape_standard_headers PRIVATE sigmascape_options fmt::fmt)
target_precompile_headers(sigmascape_standard_headers PRIVATE
  <algorithm> <array> <cmath> <complex> <cstdint> <filesystem> <fmt/format.h> <fmt/ranges.h> <functional> <limits> <map> <memory>
  <optional> <span> <string> <string_view> <vector>)

# sigmascape_room(NAME <room> USES <room>... LINKS <target>... PRIVATE_LINKS <target>...)
#
# A room is a folder of src/sigmascape and a library. USES is its row of the room table: the rooms whose headers it may include.
# tests/architecture holds every #include against these rows.
function(sigmascape_room)
  cmake_parse_arguments(ROOM "" "NAME" "USES;LINKS;PRIVATE_LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${ROOM_NAME}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${ROOM_NAME}/*.h)
  list(TRANSFORM ROOM_USES PREPEND sigmascape_ OUTPUT_VARIABLE used_rooms)
  set(library sigmascape_${ROOM_NAME})
  if(sources)
    add_library(${library} STATIC ${sources} ${headers})
    target_include_directories(${library} PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>" "$<INSTALL_INTERFACE:include>")
    target_link_libraries(${library} PUBLIC ${used_rooms} ${ROOM_LINKS} PRIVATE sigmascape_options ${ROOM_PRIVATE_LINKS})
    target_compile_features(${library} PUBLIC cxx_std_20)
    target_precompile_headers(${library} REUSE_FROM sigmascape_standard_headers)
  else()
    add_library(${library} INTERFACE)
    target_include_directories(${library} INTERFACE "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>" "$<INSTALL_INTERFACE:include>")
    target_link_libraries(${library} INTERFACE ${used_rooms} ${ROOM_LINKS} ${ROOM_PRIVATE_LINKS})
    target_compile_features(${library} INTERFACE cxx_std_20)
  endif()
  set_target_properties(${library} PROPERTIES EXPORT_NAME ${ROOM_NAME})
  set_property(GLOBAL APPEND PROPERTY SIGMASCAPE_ROOMS ${ROOM_NAME})
  add_library(sigmascape::${ROOM_NAME} ALIAS ${library})
endfunction()
