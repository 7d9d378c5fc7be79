# A file compiled once for each instruction set that lanes are chosen from at run time (CORPUSCLE_ISA names the set inside). What it
# makes must not leave it: no exceptions, no contraction, and a test looks at its symbols.
#
# The sanitizers look at one set, the first: the text is the same in all, and with them it takes minutes to compile.
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
  # After all other options: a model's constants are doubles, also where its numbers are floats.
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS $<IF:$<CXX_COMPILER_ID:Clang>,-Wno-implicit-float-conversion,-Wno-float-conversion>)
  foreach(set IN LISTS sets)
    set(object ${target}-lanes-${set})
    add_library(${object} OBJECT ${ARGN})
    target_include_directories(${object} PRIVATE $<TARGET_PROPERTY:${target},INCLUDE_DIRECTORIES>)
    target_compile_definitions(${object} PRIVATE CORPUSCLE_ISA=${set})
    # -O2 at the least, so that small functions are not left as symbols (sanitized, the first set leaves them, and nobody is misled);
    # g++ 12 warns falsely in its own headers of AVX-512.
    target_compile_options(${object} PRIVATE ${flags_${set}} -fno-exceptions
      $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize;-Wno-uninitialized;-Wno-maybe-uninitialized>)
    target_link_libraries(${object} PRIVATE corpuscle_ways)
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
