# SPDX-License-Identifier: GPL-3.0-or-later
# tisserand_rooms(target): one translation unit per folder ("room"). Headers of templates are then parsed and instances made
# once per room, not once per file: a first build takes three quarters of the time and less. While you edit, -DTISSERAND_UNITY=OFF compiles
# only the files that changed. Folders named after the target compile file by file.
function(tisserand_rooms target)
  if(NOT TISSERAND_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # GCC inlines less in large units: as much as in small ones.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:--param=large-unit-insns=1000000>)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  foreach(source ${sources})
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder} NORMALIZE)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE room)
    cmake_path(GET room PARENT_PATH room)
    string(MAKE_C_IDENTIFIER ${room} room)
    if(NOT room IN_LIST ARGN)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room})
    endif()
  endforeach()
endfunction()
