# What Debian's policy wants of a package beside what is installed anywhere: run by cpack on the files before it packs them.
cmake_policy(VERSION 3.22)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(package ${CPACK_COMPONENTS_ALL})
  set(usr ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${package}/usr)
  set(doc ${usr}/share/doc/${package})
  file(MAKE_DIRECTORY ${doc})
  file(READ ${CMAKE_CURRENT_LIST_DIR}/../LICENSE license)
  string(REGEX REPLACE "\n\n" "\n.\n" license "${license}")
  string(REGEX REPLACE "\n([^\n])" "\n \\1" license "${license}")
  file(WRITE ${doc}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: sgtools

Files: *
Copyright: 2026 the sgtools authors
License: BSD-2-clause
 ${license}
Files: sg-report
Comment: contains D3 (https://d3js.org), of Debian's libjs-d3; its licence stands in every page that sg-report writes.
Copyright: 2013 Michael Bostock and others
License: BSD-3-clause
 On Debian systems, see /usr/share/doc/libjs-d3/copyright.
")
  file(REMOVE ${doc}/LICENSE)
  file(WRITE ${doc}/changelog "sgtools (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * See CHANGELOG.md of the sources.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
  file(GLOB pages ${usr}/share/man/man*/*.[157])
  execute_process(COMMAND gzip -9nf ${doc}/changelog ${pages} COMMAND_ERROR_IS_FATAL ANY)
  # Where zsh of Debian looks for completions of packages.
  if(EXISTS ${usr}/share/zsh/site-functions)
    file(RENAME ${usr}/share/zsh/site-functions ${usr}/share/zsh/vendor-completions)
  endif()
  # Where pkg-config of Debian looks for what is of one architecture: one folder further down.
  if(EXISTS ${usr}/lib/pkgconfig)
    execute_process(COMMAND dpkg-architecture -qDEB_HOST_MULTIARCH OUTPUT_VARIABLE architecture OUTPUT_STRIP_TRAILING_WHITESPACE
      COMMAND_ERROR_IS_FATAL ANY)
    file(MAKE_DIRECTORY ${usr}/lib/${architecture})
    file(RENAME ${usr}/lib/pkgconfig ${usr}/lib/${architecture}/pkgconfig)
    file(READ ${usr}/lib/${architecture}/pkgconfig/sgtools.pc pc)
    string(REPLACE "{pcfiledir}/" "{pcfiledir}/../" pc "${pc}")
    file(WRITE ${usr}/lib/${architecture}/pkgconfig/sgtools.pc "${pc}")
  endif()
  file(GLOB_RECURSE libraries ${usr}/lib/*.a)
  foreach(library ${libraries})
    execute_process(COMMAND strip --strip-debug --remove-section=.comment --remove-section=.note ${library}
      COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
endforeach()
