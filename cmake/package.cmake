# Debian packages of what install.cmake installs: sgtools (commands, man pages, completions), libsgtools-dev (the library
# for those who build on it) and, where it is built, python3-sgtools. `make deb` makes them; their maintainer is that of
# Debian's own tools, DEBFULLNAME and DEBEMAIL.
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

if(SGTOOLS_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python3-sgtools)
  set(CPACK_DEBIAN_PYTHON3-SGTOOLS_PACKAGE_NAME python3-sgtools)
  set(CPACK_DEBIAN_PYTHON3-SGTOOLS_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON3-SGTOOLS_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON3-SGTOOLS_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/prerm)
  math(EXPR next "${Python_VERSION_MINOR} + 1")  # the module is of one minor version
  set(CPACK_DEBIAN_PYTHON3-SGTOOLS_PACKAGE_DEPENDS
    "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_COMPONENT_PYTHON3-SGTOOLS_DESCRIPTION "The library of sgtools in Python, with numpy in and out:
graphs from files or from arrays; their orders, elimination complexity and
Bayes tree; pruning, solving, scoring and covariances.")
endif()
include(CPack)
