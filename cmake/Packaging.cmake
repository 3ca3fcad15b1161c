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
        PATTERN run PERMISSIONS ${CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS})
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
