# Two components. sgtools: commands (cmd), man pages, completions, the licence. libsgtools-dev: the library with its public
# headers, for CMake find_package(sgtools) and sgtools::sgtools, for others pkg-config sgtools.
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/sgtools)

foreach(section 1 5 7)
  file(GLOB pages CONFIGURE_DEPENDS man/*.${section})
  install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man${section})
endforeach()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# Of both shells: bash looks by the command's name.
if(SGTOOLS_COMMANDS)
  get_property(targets GLOBAL PROPERTY SGTOOLS_COMMAND_TARGETS)
  foreach(target ${targets})
    get_target_property(name ${target} OUTPUT_NAME)
    list(APPEND names ${name})
  endforeach()
  string(REPLACE ";" " " commands "${names}")
  configure_file(cmd/completion/sgtools.bash sgtools.bash @ONLY)
  foreach(command ${names})
    install(FILES ${PROJECT_BINARY_DIR}/sgtools.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
      RENAME ${command})
  endforeach()
  install(FILES cmd/completion/_sgtools DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
endif()

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME libsgtools-dev)
install(TARGETS sgtools EXPORT sgtools ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(CODE "set(SOURCE \"${PROJECT_SOURCE_DIR}\")
set(INCLUDE \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/sgtools\")")
install(SCRIPT cmake/headers.cmake)

install(EXPORT sgtools NAMESPACE sgtools:: DESTINATION ${package} FILE sgtoolsTargets.cmake)
configure_package_config_file(cmake/sgtoolsConfig.cmake.in sgtoolsConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(sgtoolsConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/sgtoolsConfig.cmake ${PROJECT_BINARY_DIR}/sgtoolsConfigVersion.cmake
  cmake/FindSuiteSparse.cmake cmake/FindMetis.cmake cmake/FindScotch.cmake DESTINATION ${package})

# The libraries that have no .pc file of their own, as -lNAME.
foreach(library ${SuiteSparse_LIBRARIES} ${Metis_LIBRARY} ${Scotch_LIBRARY} ${Scotch_error_LIBRARY})
  get_filename_component(name ${library} NAME_WE)
  string(REGEX REPLACE "^lib" " -l" name ${name})
  string(APPEND pc_libraries ${name})
endforeach()
file(RELATIVE_PATH pc_up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(cmake/sgtools.pc.in sgtools.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/sgtools.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
