# Commands, man pages, the library with its headers, and a CMake package: find_package(sgtools), sgtools::sgtools.
include(CMakePackageConfigHelpers)

install(TARGETS ${commands} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS sgtools EXPORT sgtools ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY lib formats DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sgtools FILES_MATCHING PATTERN "*.h")
foreach(section 1 5 7)
  file(GLOB pages CONFIGURE_DEPENDS man/*.${section})
  install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man${section})
endforeach()
install(EXPORT sgtools NAMESPACE sgtools:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/sgtools
        FILE sgtoolsTargets.cmake)
configure_package_config_file(cmake/sgtoolsConfig.cmake.in ${CMAKE_BINARY_DIR}/sgtoolsConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/sgtools)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/sgtoolsConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/sgtoolsConfig.cmake ${CMAKE_BINARY_DIR}/sgtoolsConfigVersion.cmake
  cmake/FindSuiteSparse.cmake cmake/FindMetis.cmake cmake/FindScotch.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/sgtools)
