# Flags of every target of the project (tisserand_options), and the version that programs print. The processor flags are
# here too: Eigen's alignment follows from them, so they must be the same in every translation unit.
add_library(tisserand_options INTERFACE)
target_compile_options(tisserand_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                                   -Woverloaded-virtual $<$<BOOL:${TISSERAND_WERROR}>:-Werror>)
# False alarms of GCC 12 stay off: undefined registers of its own avx512fintrin.h taken for uninitialised values (GCC bug
# 105593), bounds of std::string when strings are joined (105329, 105651), and Eigen's vector loads of three numbers into
# a register of four. Real faults of these kinds are what the sanitizers of the preset asan-ubsan find.
target_compile_options(
  tisserand_options
  INTERFACE "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-restrict>")
target_compile_definitions(tisserand_options INTERFACE TISSERAND_VERSION="${PROJECT_VERSION}")
if(TISSERAND_NATIVE)
  # Without AVX-512: headers of GCC 12 raise false alarms there, and matrices of this size gain nothing from it.
  target_compile_options(tisserand_options INTERFACE -march=native -mno-avx512f)
endif()
if(TISSERAND_SANITIZE)
  target_compile_options(tisserand_options INTERFACE -fsanitize=${TISSERAND_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(tisserand_options INTERFACE -fsanitize=${TISSERAND_SANITIZE})
  # Checks of every pointer double the time to compile Eigen; the address sanitizer and Eigen's assertions see the same.
  if(TISSERAND_SANITIZE MATCHES undefined)
    target_compile_options(tisserand_options INTERFACE -fno-sanitize=null,alignment,object-size,vptr)
  endif()
endif()
target_include_directories(tisserand_options INTERFACE ${PROJECT_SOURCE_DIR})

# Of a program that initialises PETSc: see keep_modules.cpp. Nothing without sanitizers.
function(tisserand_keep_modules target)
  if(TISSERAND_SANITIZE)
    target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/keep_modules.cpp)
    set_source_files_properties(${PROJECT_SOURCE_DIR}/cmake/keep_modules.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    target_link_options(${target} PRIVATE -Wl,--export-dynamic-symbol=dlclose)
  endif()
endfunction()

# tisserand_precompile(target header...): Eigen with its instances and what nearly every file includes, parsed once; saves
# seconds per file. tisserand_precompile_as(target other) takes those of another target. Not with a compiler cache such as
# ccache: it cannot look behind precompiled headers.
function(tisserand_precompile target)
  if(NOT CMAKE_CXX_COMPILER_LAUNCHER)
    target_precompile_headers(${target} PRIVATE ${PROJECT_SOURCE_DIR}/common/math/eigen_instances.hpp <Eigen/Geometry>
                              <fmt/format.h> <string> <vector> ${ARGN})
  endif()
endfunction()
function(tisserand_precompile_as target other)
  if(NOT CMAKE_CXX_COMPILER_LAUNCHER)
    target_precompile_headers(${target} REUSE_FROM ${other})
  endif()
endfunction()
