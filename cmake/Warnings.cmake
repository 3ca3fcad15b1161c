# SPDX-License-Identifier: GPL-3.0-or-later
# Flags of every target of the project (tisserand_options). The processor flags are
# here too: Eigen's alignment follows from them, so they must be the same in every translation unit.
add_library(tisserand_options INTERFACE)
target_compile_options(tisserand_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                                   -Woverloaded-virtual -Wfloat-conversion -Wdouble-promotion $<$<BOOL:${TISSERAND_WERROR}>:-Werror>)
# False alarms of GCC 12 stay off: undefined registers of its own avx512fintrin.h taken for uninitialised values (GCC bug
# 105593), bounds of std::string when strings are joined (105329, 105651), and Eigen's vector loads of three numbers into
# a register of four. Real faults of these kinds are what the sanitizers of the preset asan-ubsan find.
target_compile_options(
  tisserand_options
  INTERFACE "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-restrict>")
if(NOT TISSERAND_PROCESSOR AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  set(processor x86-64-v3)
else()
  set(processor ${TISSERAND_PROCESSOR})
endif()
if(processor)
  target_compile_options(tisserand_options INTERFACE -march=${processor})
  if(processor STREQUAL "native" AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
    # Headers of GCC 12 raise false alarms with AVX-512, and matrices of this size gain nothing from it.
    target_compile_options(tisserand_options INTERFACE -mno-avx512f)
    # Clang 19 takes some processors for ones with AVX10, which brings half of AVX-512 back.
    include(CheckCXXCompilerFlag)
    check_cxx_compiler_flag(-mno-avx10.1-256 TISSERAND_KNOWS_AVX10)
    if(TISSERAND_KNOWS_AVX10)
      target_compile_options(tisserand_options INTERFACE -mno-avx10.1-256)
    endif()
  endif()
endif()
if(TISSERAND_SANITIZE)
  target_compile_options(tisserand_options INTERFACE -fsanitize=${TISSERAND_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(tisserand_options INTERFACE -fsanitize=${TISSERAND_SANITIZE})
  target_compile_definitions(tisserand_options INTERFACE TISSERAND_SANITIZED)
  # Checks of every pointer double the time to compile Eigen; the address sanitizer and Eigen's assertions see the same.
  # Alignment is checked: only this finds objects that lie where moves of a whole register fault.
  if(TISSERAND_SANITIZE MATCHES undefined)
    target_compile_options(tisserand_options INTERFACE -fno-sanitize=null,object-size,vptr)
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

# Headers that are parsed once. tisserand_precompile(target header...) compiles them; tisserand_precompile_as(target other)
# takes those of another target. Clang reads of a precompiled header only what a file uses, so that a wide one pays: the
# standard library, json, headers of the project that many files include, and instances of what Eigen is asked for most.
# GCC pays in each file for the size of the header: Eigen with its instances and little else. mechanism/model/model.hpp stays
# out: an edit of a kernel would compile everything. Not with a compiler cache such as ccache, which cannot look into them.
set(precompiled ${PROJECT_SOURCE_DIR}/common/math/eigen_instances.hpp <Eigen/Geometry> <fmt/format.h> <string> <vector>)
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  list(APPEND precompiled
       <Eigen/SparseCore> <algorithm> <array> <bit> <cerrno> <charconv> <chrono> <cmath> <complex> <csignal> <cstdint>
       <cstdio> <cstdlib> <cstring> <filesystem> <fstream> <functional> <iterator> <limits> <map> <memory>
       <nlohmann/json.hpp> <numbers> <numeric> <optional> <random> <set> <span> <sstream> <string_view> <tuple>
       <unordered_map> <unordered_set> <utility> <variant>)
  foreach(header common/error common/text common/units common/math/rotation common/math/eigen_expressions
                 formats/scene/scene formats/superelement/superelement formats/results/results formats/part/part)
    list(APPEND precompiled ${PROJECT_SOURCE_DIR}/${header}.hpp)
  endforeach()
endif()
function(tisserand_precompile target)
  if(NOT CMAKE_CXX_COMPILER_LAUNCHER)
    target_precompile_headers(${target} PRIVATE ${precompiled} ${ARGN})
  endif()
endfunction()
function(tisserand_precompile_as target other)
  if(NOT CMAKE_CXX_COMPILER_LAUNCHER)
    target_precompile_headers(${target} REUSE_FROM ${other})
  endif()
endfunction()
