# Compiles a file once for each instruction set; the program chooses one at run time. CORPUSCLE_ISA names the set in the code.
# An inline function that is compiled here must not replace its copy in other code when the program is linked, because that code must run
# on any processor. Therefore exceptions are off, and a test checks the exported symbols.
#
# Debug and sanitized builds have only the first set: the source is the same in all, and a sanitized set takes minutes to compile.
set(CORPUSCLE_INSTRUCTION_SETS baseline)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT CMAKE_BUILD_TYPE STREQUAL Debug AND NOT CORPUSCLE_SANITIZE)
  list(APPEND CORPUSCLE_INSTRUCTION_SETS avx2 avx512)
  add_compile_definitions(CORPUSCLE_AVX)
endif()
function(add_lanes target)
  set(flags_avx2 -march=x86-64-v3)
  set(flags_avx512 -march=x86-64-v4)
  # These options come after all others. The constants of a model are doubles even if its numbers are floats.
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS $<IF:$<CXX_COMPILER_ID:Clang>,-Wno-implicit-float-conversion,-Wno-float-conversion>)
  foreach(set IN LISTS CORPUSCLE_INSTRUCTION_SETS)
    set(object ${target}-lanes-${set})
    add_library(${object} OBJECT ${ARGN})
    target_include_directories(${object} PRIVATE $<TARGET_PROPERTY:${target},INCLUDE_DIRECTORIES>)
    target_compile_definitions(${object} PRIVATE CORPUSCLE_ISA=${set})
    # At least -O2, so that small functions are inlined and leave no symbols. A sanitized set may leave some; it is not checked.
    # g++ 12 gives false warnings in its own AVX-512 headers.
    target_compile_options(${object} PRIVATE ${flags_${set}} -fno-exceptions
      $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize;-Wno-uninitialized;-Wno-maybe-uninitialized>)
    target_link_libraries(${object} PRIVATE corpuscle_options)
    if(NOT CORPUSCLE_SANITIZE)
      target_compile_options(${object} PRIVATE $<$<NOT:$<CONFIG:Release>>:-O2>)
    endif()
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${object}>)
    set_property(TARGET ${target} APPEND PROPERTY LANE_OBJECTS ${object})
  endforeach()
endfunction()
