# Every fuzzing target runs over its corpus as a test, with any compiler (label fuzz). The targets of the reducer's
# readers and those of formats alone link different libraries.
function(tisserand_replay target library)
  add_executable(replay_${target} ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/${target}_fuzz.cpp
                                  ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/replay.cpp ${ARGN})
  target_link_libraries(replay_${target} PRIVATE ${library})
  add_test(NAME Fuzz.${target} COMMAND replay_${target} ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus/${target})
  set_tests_properties(Fuzz.${target} PROPERTIES LABELS fuzz TIMEOUT 120)
endfunction()

foreach(target part scene)
  tisserand_replay(${target} tisserand_formats)
endforeach()
tisserand_replay(superelement tisserand_formats ${CMAKE_CURRENT_SOURCE_DIR}/formats/superelement_container.cpp)
target_link_libraries(replay_superelement PRIVATE dep::hdf5)
if(TISSERAND_REDUCER)
  foreach(target abaqus nastran dmig matrix_text)
    tisserand_replay(${target} tisserand_reducer)
  endforeach()
endif()
