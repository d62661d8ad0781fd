# Version and git hash, read once at configure time.
execute_process(COMMAND git -C ${CMAKE_SOURCE_DIR} describe --always --dirty
  OUTPUT_VARIABLE ACINUS_GIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT ACINUS_GIT)
  set(ACINUS_GIT "unknown")
endif()
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
set(ACINUS_FLAGS "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}}")
configure_file(${CMAKE_SOURCE_DIR}/cmake/version.hpp.in ${CMAKE_BINARY_DIR}/generated/acinus_version.hpp)
add_library(acinus_version INTERFACE)
target_include_directories(acinus_version INTERFACE $<BUILD_INTERFACE:${CMAKE_BINARY_DIR}/generated>)
# A new commit makes the next build read the hash again.
if(EXISTS ${CMAKE_SOURCE_DIR}/.git/logs/HEAD)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/.git/logs/HEAD)
endif()
