# Flags of every target of the project (tisserand_options), and the version that programs print.
add_library(tisserand_options INTERFACE)
target_compile_options(tisserand_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                                   -Woverloaded-virtual $<$<BOOL:${TISSERAND_WERROR}>:-Werror>)
target_compile_definitions(tisserand_options INTERFACE TISSERAND_VERSION="${PROJECT_VERSION}")
if(TISSERAND_NATIVE)
  target_compile_options(tisserand_options INTERFACE -march=native)
endif()
target_include_directories(tisserand_options INTERFACE ${PROJECT_SOURCE_DIR})
