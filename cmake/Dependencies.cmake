# SPDX-License-Identifier: GPL-3.0-or-later
# Every library of the project as a dep::<name> target. The packages are listed in packages.txt.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
if(TISSERAND_TESTS)
  find_package(GTest REQUIRED)
endif()
if(TISSERAND_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()

pkg_check_modules(MUPARSER REQUIRED IMPORTED_TARGET muparser)

# link_archive(target name [file-name...]): lib<name>.a, else the shared library. Each start of a program pays for its
# shared libraries, 0.1 to 8 ms apiece, and next to nothing for archives. What programs take from archives stays inside
# them: seen from outside, it would replace what shared libraries beside them have from elsewhere (PETSc's HDF5 is of
# another flavour).
function(link_archive target name)
  find_library(${name}_ARCHIVE NAMES lib${name}.a ${name} ${ARGN} PATHS ${CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES}
               PATH_SUFFIXES openblas-serial REQUIRED)
  target_link_libraries(${target} INTERFACE ${${name}_ARCHIVE})
  cmake_path(GET ${name}_ARCHIVE FILENAME file)
  if(file MATCHES "\\.a$")
    target_link_options(${target} INTERFACE LINKER:--exclude-libs,${file})
  endif()
endfunction()

# dep_simple(name header path-suffix library...): libraries that ship neither a CMake config nor a .pc file.
function(dep_simple name header suffix)
  find_path(${name}_INCLUDE ${header} PATH_SUFFIXES ${suffix} REQUIRED)
  add_library(dep_${name} INTERFACE)
  add_library(dep::${name} ALIAS dep_${name})
  target_include_directories(dep_${name} SYSTEM INTERFACE ${${name}_INCLUDE})
  foreach(library ${ARGN})
    link_archive(dep_${name} ${library})
  endforeach()
endfunction()

# SHA-256 only, which needs nothing else of OpenSSL.
dep_simple(crypto openssl/sha.h "" crypto)

# The serial HDF5, in `reducer` too, where PETSc brings the Open MPI one.
dep_simple(hdf5 hdf5.h hdf5/serial hdf5_serial sz aec z)
target_link_libraries(dep_hdf5 INTERFACE ${CMAKE_DL_LIBS} m)

# What HDF5 drags in, for pages.
dep_simple(zlib zlib.h "" z)

# With an OpenBLAS without threads: an idle one spins for 30 ms, longer than a short run takes. Where METIS and Fortran have
# no archive, their full names will do; the names without a version are in packages of no other use here.
dep_simple(suitesparse klu.h suitesparse klu btf umfpack spqr cholmod amd colamd camd ccolamd suitesparseconfig)
link_archive(dep_suitesparse metis libmetis.so.5)
link_archive(dep_suitesparse openblas)
link_archive(dep_suitesparse gfortran libgfortran.so.5)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64") # on 64-bit ARM, long double has 128 bits, and there is no such library
  link_archive(dep_suitesparse quadmath libquadmath.so.0)
endif()
target_link_libraries(dep_suitesparse INTERFACE gomp m)

# Debian's libsundials-dev drags PETSc and MPI in as packages; libsundials_cvode itself links neither.
find_path(cvode_header cvode/cvode.h)
if(TISSERAND_CVODE STREQUAL "AUTO" AND NOT cvode_header)
  set(has_cvode OFF)
else()
  set(has_cvode ${TISSERAND_CVODE})
endif()
if(has_cvode)
  dep_simple(cvode cvode/cvode.h "" sundials_cvode sundials_nvecserial sundials_sunmatrixdense sundials_sunlinsoldense
             sundials_sunlinsolspgmr)
endif()

if(TISSERAND_REDUCER)
  find_package(MPI REQUIRED COMPONENTS C)
  set(BLA_VENDOR OpenBLAS)
  find_package(BLAS REQUIRED)
  find_package(LAPACK REQUIRED)
  add_library(dep_blas INTERFACE)
  add_library(dep::blas ALIAS dep_blas)
  target_link_libraries(dep_blas INTERFACE LAPACK::LAPACK BLAS::BLAS)
  pkg_check_modules(SLEPC REQUIRED IMPORTED_TARGET slepc>=3.18 petsc>=3.18)
  get_target_property(slepc_options PkgConfig::SLEPC INTERFACE_COMPILE_OPTIONS)
  if(slepc_options)
    list(FILTER slepc_options EXCLUDE REGEX "_FORTIFY_SOURCE|-Wdate-time")
    set_target_properties(PkgConfig::SLEPC PROPERTIES INTERFACE_COMPILE_OPTIONS "${slepc_options}")
  endif()
  add_library(dep_slepc INTERFACE)
  add_library(dep::slepc ALIAS dep_slepc)
  target_link_libraries(dep_slepc INTERFACE PkgConfig::SLEPC MPI::MPI_C)
  target_compile_definitions(dep_slepc INTERFACE OMPI_SKIP_MPICXX=1)
  # For new solvers of SLEPc's own form: of the same release as the library, which its manual prescribes.
  find_path(SLEPC_PRIVATE slepc/private/epsimpl.h HINTS ${SLEPC_INCLUDE_DIRS} NO_DEFAULT_PATH)
  if(NOT SLEPC_PRIVATE)
    message(STATUS "slepc/private/epsimpl.h is missing: eigensolver krylov_schur serves in place of block_lanczos, and "
                   "modes of large parts take two to three times as long")
  endif()
  # The CHOLMOD that PETSc loads anyway, on the same BLAS; it and MUMPS run with OpenMP.
  find_library(CHOLMOD_SHARED libcholmod.so REQUIRED)
  add_library(dep_cholmod INTERFACE)
  add_library(dep::cholmod ALIAS dep_cholmod)
  target_link_libraries(dep_cholmod INTERFACE ${CHOLMOD_SHARED} gomp)
  dep_simple(gmsh gmsh.h "" gmsh)
endif()
