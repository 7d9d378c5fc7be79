# libcorpuscle.so: the objects of the static library. It shows what the public headers mark with CORPUSCLE_API, and nothing else.
if(CORPUSCLE_SANITIZE)  # the run-time library of a sanitizer is in the program
  return()
endif()
file(STRINGS ${PROJECT_SOURCE_DIR}/include/corpuscle.h abi_line REGEX "^#define CORPUSCLE_ABI ")
string(REGEX REPLACE "[^0-9]" "" CORPUSCLE_ABI "${abi_line}")
set(map ${CMAKE_CURRENT_BINARY_DIR}/exported_symbols.map)
configure_file(${PROJECT_SOURCE_DIR}/cmake/exported_symbols.map.in ${map} @ONLY)

set(objects $<TARGET_OBJECTS:corpuscle> $<TARGET_OBJECTS:corpuscle_cold>)
get_target_property(lane_objects corpuscle LANE_OBJECTS)
foreach(object IN LISTS lane_objects)
  list(APPEND objects $<TARGET_OBJECTS:${object}>)
endforeach()
add_library(corpuscle_shared SHARED ${objects})
set_target_properties(corpuscle_shared PROPERTIES OUTPUT_NAME corpuscle LINKER_LANGUAGE CXX LINK_DEPENDS ${map}
  VERSION ${CORPUSCLE_ABI}.${PROJECT_VERSION} SOVERSION ${CORPUSCLE_ABI})
target_include_directories(corpuscle_shared INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(corpuscle_shared INTERFACE cxx_std_20)
get_target_property(libraries corpuscle LINK_LIBRARIES)
target_link_libraries(corpuscle_shared PRIVATE ${libraries})
target_link_options(corpuscle_shared PRIVATE LINKER:--version-script=${map},-z,defs,--as-needed)
