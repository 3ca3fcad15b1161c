# What `cmake --install` puts where, and the Debian package of it. Below share/doc/tisserand and share/tisserand the folders
# are those of the sources, so that links between pages and the paths of examples hold.
set(pages_folder ${CMAKE_INSTALL_DOCDIR})
set(data_folder ${CMAKE_INSTALL_DATADIR}/tisserand)
set(packaging ${PROJECT_BINARY_DIR}/packaging)

# Pages, and the pictures in them.
file(GLOB pages CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} README.md CHANGELOG.md CONVENTIONS.md DECISIONS.md
     docs/*.md docs/pictures/*.png)
foreach(folder IN ITEMS formats reducer mechanism)
  file(GLOB_RECURSE more CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${folder}/*.md)
  list(APPEND pages ${more})
endforeach()
foreach(page IN LISTS pages)
  cmake_path(GET page PARENT_PATH folder)
  install(FILES ${page} DESTINATION ${pages_folder}/${folder})
endforeach()
install(FILES packaging/copyright DESTINATION ${pages_folder})

# What people copy from: examples, the meshes and references that they use, schemas for editors.
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
install(DIRECTORY examples meshes DESTINATION ${data_folder}
        PATTERN run PERMISSIONS ${CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS}
        PATTERN one_against_pieces PERMISSIONS ${CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS})
foreach(folder IN ITEMS tests/verification/references tests/verification/references/cardona)
  file(GLOB references CONFIGURE_DEPENDS ${folder}/*.csv)
  install(FILES ${references} DESTINATION ${data_folder}/${folder})
endforeach()
install(DIRECTORY formats/schema DESTINATION ${data_folder})
file(RELATIVE_PATH to_data /${pages_folder} /${data_folder})
file(MAKE_DIRECTORY ${packaging})
foreach(folder IN ITEMS examples meshes)
  file(CREATE_LINK ${to_data}/${folder} ${packaging}/${folder} SYMBOLIC)
  install(FILES ${packaging}/${folder} DESTINATION ${pages_folder})
endforeach()

# Completion and manual pages ask the programs themselves.
set(programs mechanism)
if(TISSERAND_REDUCER)
  list(APPEND programs reducer)
endif()
set(manuals)
foreach(program IN LISTS programs)
  install(FILES packaging/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
          RENAME ${program})
  install(FILES packaging/completion.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions RENAME _${program})
  install(FILES packaging/completion.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
          RENAME ${program}.fish)
  add_custom_command(
    OUTPUT ${packaging}/${program}.1
    COMMAND ${CMAKE_COMMAND} -E env ASAN_OPTIONS=detect_leaks=0 # a matter of tests
            ${PROJECT_SOURCE_DIR}/packaging/manual $<TARGET_FILE:${program}> ${packaging}/${program}.1
    DEPENDS ${program} packaging/manual
    VERBATIM)
  list(APPEND manuals ${packaging}/${program}.1)
endforeach()
add_custom_target(manuals ALL DEPENDS ${manuals})
install(FILES ${manuals} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)

# A package must run on other processors than that which built it: `cpack` works where TISSERAND_NATIVE is off.
if(NOT TISSERAND_NATIVE)
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_NAME tisserand)
  set(CPACK_PACKAGE_CONTACT "Tisserand maintainers <maintainers@tisserand.invalid>")
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "flexible multibody dynamics from CAD, meshes and decks")
  set(CPACK_PACKAGE_DESCRIPTION
      "reducer turns a part (beams, shells and solids; drawn, from CAD, meshes, Nastran
or Abaqus decks) into a superelement: reduced stiffness and mass of its boundary
nodes and internal modes. mechanism runs mechanisms of superelements, nonlinear
beams and rigid bodies: assembly, equilibrium, kinematics, dynamics, vibrations.")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS gnuplot-nox)
  include(CPack)
endif()
