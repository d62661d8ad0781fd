# One INTERFACE target carries the compile rules of the whole project.
add_library(acinus_flags INTERFACE)
add_library(acinus::flags ALIAS acinus_flags)
target_compile_features(acinus_flags INTERFACE cxx_std_20)
target_include_directories(acinus_flags INTERFACE $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}>)
# A Python module is a shared library, as is a program under SMPI. Hidden, so that its functions are called and inlined as in
# the program.
if(ACINUS_BINDINGS OR ACINUS_SMPI)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  set(CMAKE_CXX_VISIBILITY_PRESET hidden)
  set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
endif()
# No contraction and no fast-math: the same bits on every instruction set and thread count.
# errno and trapping are given up so that sqrt and selects vectorise; neither changes a result.
target_compile_options(acinus_flags INTERFACE
  -ffp-contract=off -fno-math-errno -fno-trapping-math "$<BUILD_INTERFACE:-Wall;-Wextra;-Wshadow;-Wpedantic>" -Wno-psabi
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>>)  # gcc 12 sees impossible overlaps in std::string concatenation
if(ACINUS_WERROR)
  # gcc 12 sees copies of short texts run beyond their ends: told, but no error.
  target_compile_options(acinus_flags INTERFACE -Werror -Wno-error=array-bounds)
endif()
if(ACINUS_ASSERTS)
  target_compile_definitions(acinus_flags INTERFACE ACINUS_ENABLE_ASSERTS)
endif()
if(ACINUS_HARDEN AND NOT ACINUS_SANITIZE AND NOT ACINUS_SANITIZE_THREADS)
  # Sizes of copies are known to an optimising compiler only. None of this changes a number.
  target_compile_options(acinus_flags INTERFACE
    $<BUILD_INTERFACE:-fstack-protector-strong> "$<BUILD_INTERFACE:$<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=3>>")
  target_link_options(acinus_flags INTERFACE $<BUILD_INTERFACE:LINKER:-z,relro,-z,now>)
endif()
if(ACINUS_SANITIZE)
  target_compile_options(acinus_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer)
  target_link_options(acinus_flags INTERFACE -fsanitize=address,undefined)
endif()
if(ACINUS_FUZZ)
  target_compile_options(acinus_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
if(ACINUS_SANITIZE_THREADS)
  target_compile_options(acinus_flags INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
  target_link_options(acinus_flags INTERFACE -fsanitize=thread)
endif()
