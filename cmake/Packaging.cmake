# SPDX-License-Identifier: GPL-3.0-or-later
# What `cmake --install` puts where, and the Debian packages of it: tisserand-mechanism, tisserand-reducer, and tisserand with
# both. Each is a component. Below share/doc/tisserand and share/tisserand the folders are those of the sources, so that links
# between pages and the paths of examples hold where all three are installed.
set(pages_folder ${CMAKE_INSTALL_DATADIR}/doc/tisserand)
set(data_folder ${CMAKE_INSTALL_DATADIR}/tisserand)
set(packaging ${PROJECT_BINARY_DIR}/packaging)

# Pages, and the pictures in them. A program's package has those on what it reads and writes.
file(GLOB pages CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} README.md MAP.md CHANGELOG.md CONTRIBUTING.md CONVENTIONS.md DECISIONS.md
     SECURITY.md
     docs/*.md docs/pictures/*.png)
foreach(folder IN ITEMS formats reducer mechanism)
  file(GLOB_RECURSE more CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${folder}/*.md)
  list(APPEND pages ${more})
endforeach()
foreach(page IN LISTS pages)
  if(page MATCHES "^reducer/|^formats/PART")
    set(component reducer)
  elseif(page MATCHES "^mechanism/|^formats/")
    set(component mechanism)
  else()
    set(component tisserand)
  endif()
  cmake_path(GET page PARENT_PATH folder)
  install(FILES ${page} DESTINATION ${pages_folder}/${folder} COMPONENT ${component})
endforeach()

# What people copy from: examples, the meshes and references that they use, schemas for editors.
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
install(DIRECTORY examples meshes DESTINATION ${data_folder} COMPONENT tisserand
        REGEX "/(run|one_against_pieces|tables)$" PERMISSIONS ${CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS})
foreach(folder IN ITEMS tests/verification/references tests/verification/references/cardona)
  file(GLOB references CONFIGURE_DEPENDS ${folder}/*.csv)
  install(FILES ${references} DESTINATION ${data_folder}/${folder} COMPONENT tisserand)
endforeach()
install(FILES formats/schema/part.schema.json DESTINATION ${data_folder}/schema COMPONENT reducer)
install(FILES formats/schema/scene.schema.json formats/schema/study.schema.json DESTINATION ${data_folder}/schema
        COMPONENT mechanism)
file(RELATIVE_PATH to_data /${pages_folder} /${data_folder})
file(MAKE_DIRECTORY ${packaging})
foreach(folder IN ITEMS examples meshes)
  file(CREATE_LINK ${to_data}/${folder} ${packaging}/${folder} SYMBOLIC)
  install(FILES ${packaging}/${folder} DESTINATION ${pages_folder} COMPONENT tisserand)
endforeach()

# Completion and manual pages ask the programs themselves.
set(programs mechanism)
if(TISSERAND_REDUCER)
  list(APPEND programs reducer)
endif()
set(manuals)
foreach(program IN LISTS programs)
  install(FILES packaging/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
          RENAME ${program} COMPONENT ${program})
  install(FILES packaging/completion.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions RENAME _${program}
          COMPONENT ${program})
  install(FILES packaging/completion.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
          RENAME ${program}.fish COMPONENT ${program})
  add_custom_command(
    OUTPUT ${packaging}/${program}.1.gz
    COMMAND ${CMAKE_COMMAND} -E env ASAN_OPTIONS=detect_leaks=0 # a matter of tests
            ${PROJECT_SOURCE_DIR}/packaging/manual $<TARGET_FILE:${program}> ${packaging}/${program}.1.gz
    DEPENDS ${program} packaging/manual
    VERBATIM)
  list(APPEND manuals ${packaging}/${program}.1.gz)
  install(FILES ${packaging}/${program}.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${program})
endforeach()
add_custom_target(manuals ALL DEPENDS ${manuals})

# Copyright and changelog of each package, where Debian looks for them.
set(components ${programs})
if(TISSERAND_REDUCER)
  list(APPEND components tisserand)
endif()
foreach(component IN LISTS components)
  string(REGEX REPLACE "^(mechanism|reducer)$" "tisserand-\\1" package ${component})
  set(package_of_${component} ${package})
  install(FILES packaging/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
  add_custom_command(
    OUTPUT ${packaging}/${package}/changelog.gz
    COMMAND ${PROJECT_SOURCE_DIR}/packaging/changelog ${package} ${PROJECT_VERSION} ${packaging}/${package}/changelog.gz
    DEPENDS packaging/changelog
    VERBATIM)
  add_custom_target(changelog_${component} ALL DEPENDS ${packaging}/${package}/changelog.gz)
  add_dependencies(manuals changelog_${component})
  install(FILES ${packaging}/${package}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
          COMPONENT ${component})
endforeach()

# A package must run on other processors than that which built it: there is no cpack for a `native` build.
if(NOT TISSERAND_PROCESSOR STREQUAL "native" AND NOT TISSERAND_SANITIZE)
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_NAME tisserand)
  set(CPACK_PACKAGE_CONTACT "Tisserand maintainers <maintainers@tisserand.invalid>")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_COMPONENTS_ALL ${components})
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
  set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
  foreach(component IN LISTS components)
    string(TOUPPER ${component} upper)
    set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package_of_${component}})
    set(CPACK_DEBIAN_${upper}_PACKAGE_SHLIBDEPS ON)
  endforeach()

  set(CPACK_DEBIAN_MECHANISM_DESCRIPTION
      "flexible multibody dynamics: mechanisms in motion
mechanism runs mechanisms of superelements, nonlinear beams and rigid bodies:
assembly, equilibrium, kinematics, dynamics, vibrations. It needs no finite
element program: superelements come from reducer or from other programs.")
  set(CPACK_DEBIAN_MECHANISM_PACKAGE_RECOMMENDS gnuplot-nox)
  set(CPACK_DEBIAN_MECHANISM_PACKAGE_SUGGESTS "chromium, tisserand-reducer")

  set(CPACK_DEBIAN_REDUCER_DESCRIPTION
      "flexible multibody dynamics: parts as superelements
reducer turns a part (beams, shells and solids, from a text file, CAD, meshes
or decks of Nastran and Abaqus) into a superelement: reduced stiffness and
mass of its boundary nodes and internal modes.")
  set(CPACK_DEBIAN_REDUCER_PACKAGE_RECOMMENDS "gnuplot-nox, tisserand-mechanism")
  set(CPACK_DEBIAN_REDUCER_PACKAGE_SUGGESTS "openmpi-bin, slurm-client")

  set(CPACK_DEBIAN_TISSERAND_DESCRIPTION
      "flexible multibody dynamics from CAD, meshes and decks
Both programs of Tisserand: reducer turns parts into superelements, mechanism
runs mechanisms of these. With examples, meshes, a tutorial and all documents.")
  set(CPACK_DEBIAN_TISSERAND_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_TISSERAND_PACKAGE_SHLIBDEPS OFF)
  set(CPACK_DEBIAN_TISSERAND_PACKAGE_DEPENDS
      "tisserand-mechanism (= ${PROJECT_VERSION}), tisserand-reducer (= ${PROJECT_VERSION})")
  include(CPack)
endif()
