# Most of the time of a small file goes into the same headers. One precompiled header serves all libraries and programs, since they
# share their flags; tests have another, with GoogleTest.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  set(acinus_precompile_default ON)
else()
  set(acinus_precompile_default OFF)  # saves time, and is tried, with gcc only
endif()
option(ACINUS_PRECOMPILE "Precompiled headers" ${acinus_precompile_default})
# Not <filesystem>: it brings std::quoted, which calls of a function of that name would then find through their arguments.
set(acinus_common_headers
  <Eigen/Core> <Eigen/Geometry> <fmt/format.h>
  <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <numeric> <optional> <set> <span> <string>
  <utility> <vector>)

set(acinus_light_options $<$<CONFIG:Release>:-O1>)

# acinus_make_precompiled(name HEADERS... [LINK targets...] [OPTIONS flags...]): an object library that holds no code, only the
# precompiled header. Who reuses it must have the same flags.
function(acinus_make_precompiled name)
  cmake_parse_arguments(arg "" "" "HEADERS;LINK;OPTIONS" ${ARGN})
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/generated/${name}.cpp)
  target_link_libraries(${name} PRIVATE acinus_flags Eigen3::Eigen fmt::fmt ${arg_LINK})
  target_compile_options(${name} PRIVATE ${arg_OPTIONS})
  target_precompile_headers(${name} PRIVATE ${arg_HEADERS})
endfunction()

if(ACINUS_PRECOMPILE)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # ccache needs it to see which precompiled header a file was compiled with.
    target_compile_options(acinus_flags INTERFACE $<BUILD_INTERFACE:-fpch-preprocess>)
  endif()
  if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
    # Without these it passes every file with a precompiled header on to the compiler.
    list(PREPEND CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros)
  endif()
  acinus_make_precompiled(acinus_common HEADERS ${acinus_common_headers})
  acinus_make_precompiled(acinus_light HEADERS ${acinus_common_headers} OPTIONS ${acinus_light_options})
endif()

# acinus_precompile(targets...): with the header of the libraries.
function(acinus_precompile)
  foreach(target ${ARGN})
    if(ACINUS_PRECOMPILE)
      target_precompile_headers(${target} REUSE_FROM acinus_common)
    endif()
  endforeach()
endfunction()

# acinus_light(targets...): code that reads, arranges and writes. It computes nothing that a run waits for, and compiles in
# two thirds of the time with fewer optimisations.
function(acinus_light)
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE ${acinus_light_options})
    if(ACINUS_PRECOMPILE)
      target_precompile_headers(${target} REUSE_FROM acinus_light)
    endif()
  endforeach()
endfunction()
