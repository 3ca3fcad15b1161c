# Flags of every target of the project (tisserand_options), and the version that programs print. The processor flags are
# here too: Eigen's alignment follows from them, so they must be the same in every translation unit.
add_library(tisserand_options INTERFACE)
target_compile_options(tisserand_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                                   -Woverloaded-virtual $<$<BOOL:${TISSERAND_WERROR}>:-Werror>)
# GCC 12 takes the undefined registers of its own avx512fintrin.h for uninitialised values (GCC bug 105593).
# Its warnings about the bounds of std::string when strings are joined are false as often (GCC bugs 105329, 105651): shown,
# but no errors.
target_compile_options(
  tisserand_options
  INTERFACE "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-error=array-bounds;-Wno-error=stringop-overflow;-Wno-error=stringop-overread;-Wno-error=restrict>")
target_compile_definitions(tisserand_options INTERFACE TISSERAND_VERSION="${PROJECT_VERSION}")
if(TISSERAND_NATIVE)
  # Without AVX-512: headers of GCC 12 raise false alarms there, and matrices of this size gain nothing from it.
  target_compile_options(tisserand_options INTERFACE -march=native -mno-avx512f)
endif()
if(TISSERAND_SANITIZE)
  target_compile_options(tisserand_options INTERFACE -fsanitize=${TISSERAND_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(tisserand_options INTERFACE -fsanitize=${TISSERAND_SANITIZE})
endif()
target_include_directories(tisserand_options INTERFACE ${PROJECT_SOURCE_DIR})

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
