# acinus_exact_library(name SOURCES...): objects that use CGAL. Its exact predicates change the rounding mode, so these
# files (and no others) are compiled with -frounding-math and keep trapping semantics: either would slow the kernels.
function(acinus_exact_library name)
  add_library(${name} OBJECT ${ARGN})
  target_link_libraries(${name} PRIVATE acinus_flags Eigen3::Eigen fmt::fmt CGAL::CGAL)
  target_compile_options(${name} PRIVATE -ftrapping-math)
  acinus_unity(${name})
endfunction()
