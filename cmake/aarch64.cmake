# SPDX-License-Identifier: GPL-3.0-or-later
# Toolchain file: programs for 64-bit ARM Linux, compiled by clang on another machine.
# SYSROOT is a folder with Debian's arm64 libraries and headers, as scripts/cross_aarch64 makes it.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(SYSROOT "" CACHE PATH "Folder with the libraries and headers of the other machine")
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES SYSROOT)
if(NOT IS_DIRECTORY "${SYSROOT}")
  message(FATAL_ERROR "cmake/aarch64.cmake: SYSROOT is no folder: '${SYSROOT}'; scripts/cross_aarch64 makes one")
endif()

set(triple aarch64-linux-gnu)
set(CMAKE_SYSROOT ${SYSROOT})
set(CMAKE_LIBRARY_ARCHITECTURE ${triple})
foreach(language C CXX)
  set(CMAKE_${language}_COMPILER_TARGET ${triple})
endforeach()
find_program(CMAKE_C_COMPILER NAMES clang-19 clang REQUIRED)
find_program(CMAKE_CXX_COMPILER NAMES clang++-19 clang++ REQUIRED)
find_program(CMAKE_AR NAMES llvm-ar-19 llvm-ar REQUIRED)
find_program(CMAKE_RANLIB NAMES llvm-ranlib-19 llvm-ranlib REQUIRED)
set(CMAKE_EXE_LINKER_FLAGS_INIT -fuse-ld=lld) # the linker of GNU knows one processor only

# Programs are those of this machine; everything else comes from the sysroot.
set(CMAKE_FIND_ROOT_PATH ${SYSROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR} ${SYSROOT}/usr/lib/${triple}/pkgconfig:${SYSROOT}/usr/share/pkgconfig)
