# `cmake --install`: programs, shipped scenes, the Python reader, and core to calibration as a CMake package
# (find_package(acinus), targets acinus::core .. acinus::calibration). `./acinus.sh deb` makes a Debian package by cpack.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/acinus)

install(TARGETS acinus RUNTIME)
if(ACINUS_BENCH)
  install(TARGETS acinus-bench RUNTIME)
endif()
install(FILES ${CMAKE_BINARY_DIR}/acinus.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(DIRECTORY runs/scenes runs/studies runs/laws DESTINATION ${CMAKE_INSTALL_DATADIR}/acinus)
install(FILES LICENSE CITATION.cff README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)  # the name that Debian expects
install(DIRECTORY docs/examples DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN examples EXCLUDE PATTERN status.md EXCLUDE)
# Where Debian's Python looks; elsewhere this folder goes into PYTHONPATH.
install(DIRECTORY python/acinus DESTINATION lib/python3/dist-packages FILES_MATCHING PATTERN "*.py" PATTERN "py.typed")

set(installed core geometry solve substances io contact imaging dcm cbm coupling calibration)
foreach(library ${installed})
  set_target_properties(acinus_${library} PROPERTIES EXPORT_NAME ${library})
  install(DIRECTORY ${library} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/acinus FILES_MATCHING PATTERN "*.hpp")
endforeach()
set_target_properties(acinus_flags PROPERTIES EXPORT_NAME flags)
list(TRANSFORM installed PREPEND acinus_)
install(TARGETS ${installed} acinus_flags acinus_version
  EXPORT acinus_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/acinus)
install(EXPORT acinus_targets NAMESPACE acinus:: FILE acinus_targets.cmake DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/acinus-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/acinus-config.cmake ${CMAKE_BINARY_DIR}/acinus-config-version.cmake DESTINATION ${package_folder})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The acinus developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Simulator of living tissue: deformable cells and spheres in one simulation")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "openmpi-bin, python3-h5py, python3-numpy, python3-pil")  # several processes, the reader
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
# For those who build against the library, all that cmake/acinus-config.cmake looks for and the link line names:
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, cmake, pkgconf, libblosc-dev, libeigen3-dev, libfmt-dev, libgmp-dev, libhdf5-dev, libmpfr-dev, libnifti-dev, libopenmpi-dev, libpugixml-dev, libtiff-dev, libtrilinos-zoltan-dev, libxxhash-dev, libzstd-dev, nlohmann-json3-dev, zlib1g-dev")
set(CPACK_STRIP_FILES ON)
include(CPack)
