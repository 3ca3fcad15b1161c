# SPDX-License-Identifier: GPL-3.0-or-later
# What `--version` prints: the version of the project, the commit, and what a program is built with.

# header_version(variable header regex...): for a library that tells its version to neither CMake nor pkg-config, the captures
# of regular expressions on the defines of a header, joined by dots.
function(header_version variable header)
  set(numbers)
  file(READ ${header} lines)
  foreach(regex IN LISTS ARGN)
    string(REGEX MATCH "#define +${regex}" found "${lines}")
    list(APPEND numbers ${CMAKE_MATCH_1})
  endforeach()
  list(JOIN numbers "." version)
  set(${variable} "${version}" PARENT_SCOPE)
endfunction()
header_version(hdf5_version ${hdf5_INCLUDE}/H5public.h "H5_VERS_INFO +\"HDF5 library version: ([0-9.]+)")
header_version(suitesparse_version ${suitesparse_INCLUDE}/SuiteSparse_config.h "SUITESPARSE_MAIN_VERSION +([0-9]+)"
               "SUITESPARSE_SUB_VERSION +([0-9]+)" "SUITESPARSE_SUBSUB_VERSION +([0-9]+)")
set(libraries "Eigen ${Eigen3_VERSION}, HDF5 ${hdf5_version}, yaml-cpp ${yaml-cpp_VERSION}, fmt ${fmt_VERSION}, CLI11 ${CLI11_VERSION}")
string(APPEND libraries ", nlohmann-json ${nlohmann_json_VERSION}")
set(mechanism_libraries "${libraries}, SuiteSparse ${suitesparse_version}, muParser ${MUPARSER_VERSION}")
if(has_cvode)
  header_version(sundials_version ${cvode_INCLUDE}/sundials/sundials_config.h "SUNDIALS_VERSION +\"([0-9.]+)")
  string(APPEND mechanism_libraries ", SUNDIALS ${sundials_version}")
endif()
if(TISSERAND_REDUCER)
  header_version(gmsh_version ${gmsh_INCLUDE}/gmsh.h "GMSH_API_VERSION +\"([0-9.]+)")
  set(reducer_libraries
      "${libraries}, PETSc ${SLEPC_petsc_VERSION}, SLEPc ${SLEPC_slepc_VERSION}, SuiteSparse ${suitesparse_version}, gmsh ${gmsh_version}")
endif()

# tisserand_version(program target): compiles version_text() of a program into `target`. Each build asks git for the commit; the
# source changes, and is compiled again, only where the text does.
function(tisserand_version program target)
  set(source ${PROJECT_BINARY_DIR}/generated/${program}_version.cpp)
  add_custom_target(
    ${program}_version
    COMMAND
      ${CMAKE_COMMAND} -Doutput=${source} "-Dfirst=${program} ${PROJECT_VERSION} (Tisserand)"
      "-Dcompiler=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}, ${CMAKE_BUILD_TYPE}, ${CMAKE_SYSTEM_PROCESSOR} ${processor}"
      "-Dlibraries=${${program}_libraries}" -P ${PROJECT_SOURCE_DIR}/cmake/write_version.cmake
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    BYPRODUCTS ${source}
    VERBATIM)
  target_sources(${target} PRIVATE ${source})
  add_dependencies(${target} ${program}_version)
endfunction()
