# Debian packages of what install.cmake installs: sgtools (commands, man pages, completions) and libsgtools-dev (the library
# for those who build on it). `make deb` makes them; their maintainer is that of Debian's own tools, DEBFULLNAME and
# DEBEMAIL.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "the sgtools authors")
set(name $ENV{DEBFULLNAME})
set(address $ENV{DEBEMAIL})
if(NOT address)
  set(name "the sgtools authors")
  set(address sgtools@lists.invalid)
endif()
set(CPACK_PACKAGE_CONTACT "${name} <${address}>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL sgtools libsgtools-dev)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian.cmake)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

set(CPACK_DEBIAN_SGTOOLS_PACKAGE_NAME sgtools)
set(CPACK_DEBIAN_SGTOOLS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_SGTOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_SGTOOLS_DESCRIPTION "Small Unix commands that say what a SLAM graph costs to solve (its elimination
complexity), what could be left out, and what that would buy: generate, prune,
reorder, score, solve, check, convert and draw graphs of g2o, TORO and iSAM.")

set(CPACK_DEBIAN_LIBSGTOOLS-DEV_PACKAGE_NAME libsgtools-dev)
set(CPACK_DEBIAN_LIBSGTOOLS-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBSGTOOLS-DEV_PACKAGE_DEPENDS
  "libboost-dev, libboost-iostreams-dev, libeigen3-dev, libmetis-dev, libscotch-dev, libsuitesparse-dev, libtbb-dev")
set(CPACK_COMPONENT_LIBSGTOOLS-DEV_DESCRIPTION "What the commands of sgtools do, as a C++ library: reading graphs, elimination
trees and their costs, orderings, solvers, pruning. It is static, with its
headers, for CMake's find_package(sgtools) and for pkg-config.")
include(CPack)
