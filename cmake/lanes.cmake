# Compiles a file once for each instruction set; the program chooses one at run time. CORPUSCLE_ISA names the set in the code.
# An inline function that is compiled here must not replace its copy in other code when the program is linked, because that code must run
# on any processor. Therefore exceptions are off, and a test checks the exported symbols.
#
# Only the first set is sanitized: the source is the same in all, and a sanitized set takes minutes to compile.
if(NOT TARGET corpuscle_not_sanitized)
  add_library(corpuscle_not_sanitized INTERFACE)
  if(CORPUSCLE_SANITIZE)
    target_compile_options(corpuscle_not_sanitized INTERFACE -fno-sanitize=all)
  endif()
endif()
function(add_lanes target)
  set(sets baseline)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    list(APPEND sets avx2 avx512)
  endif()
  set(flags_avx2 -march=x86-64-v3)
  set(flags_avx512 -march=x86-64-v4)
  # These options come after all others. The constants of a model are doubles even if its numbers are floats.
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS $<IF:$<CXX_COMPILER_ID:Clang>,-Wno-implicit-float-conversion,-Wno-float-conversion>)
  foreach(set IN LISTS sets)
    set(object ${target}-lanes-${set})
    add_library(${object} OBJECT ${ARGN})
    target_include_directories(${object} PRIVATE $<TARGET_PROPERTY:${target},INCLUDE_DIRECTORIES>)
    target_compile_definitions(${object} PRIVATE CORPUSCLE_ISA=${set})
    # At least -O2, so that small functions are inlined and leave no symbols. The sanitized first set may leave some; it is not checked.
    # g++ 12 gives false warnings in its own AVX-512 headers.
    target_compile_options(${object} PRIVATE ${flags_${set}} -fno-exceptions
      $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize;-Wno-uninitialized;-Wno-maybe-uninitialized>)
    target_link_libraries(${object} PRIVATE corpuscle_options)
    if(NOT set STREQUAL baseline OR NOT CORPUSCLE_SANITIZE)
      target_compile_options(${object} PRIVATE $<$<NOT:$<CONFIG:Release>>:-O2>)
    endif()
    if(NOT set STREQUAL baseline)
      target_link_libraries(${object} PRIVATE corpuscle_not_sanitized)
    endif()
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${object}>)
    set_property(TARGET ${target} APPEND PROPERTY LANE_OBJECTS ${object})
  endforeach()
endfunction()
