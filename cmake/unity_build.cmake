# Compiles up to eight files of a folder as one, which halves the time of a full build: common headers are read once.
# Therefore names in anonymous namespaces must differ within a folder, and a using-directive belongs inside a function.
# A file with its own compile options is compiled alone.
#   use_unity_build(TARGET file...)
option(CORPUSCLE_UNITY "compile several files as one: faster, but hides a missing include (make lint finds it)" ON)
function(use_unity_build target)
  if(NOT CORPUSCLE_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(file IN LISTS ARGN)
    cmake_path(GET file PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE folder)
    string(MAKE_C_IDENTIFIER "${folder}" folder)
    math(EXPR count_${folder} "0${count_${folder}} + 1")
    math(EXPR group "(${count_${folder}} - 1) / 8")
    set_source_files_properties(${file} PROPERTIES UNITY_GROUP ${folder}_${group})
  endforeach()
endfunction()
