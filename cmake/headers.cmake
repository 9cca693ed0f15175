# Installs the headers that users of the library include, and those that these include, as sgtools/lib/graph/graph.h.
# Everything else is the library's own affair. Runs when cmake --install does; SOURCE and INCLUDE say from and to where.
cmake_policy(VERSION 3.22)
set(public_headers
  formats/convert.h formats/formats.h formats/order_file.h formats/reorder.h formats/tum.h formats/write.h
  lib/elim/*.h
  lib/factor/initialize.h lib/factor/linearize.h
  lib/geometry/*.h
  lib/graph/*.h
  lib/order/order.h
  lib/prune/*.h
  lib/score/*.h
  lib/solve/batch.h lib/solve/isam2.h lib/solve/isam2_replay.h
  lib/trees/*.h
  lib/world/*.h)

foreach(pattern ${public_headers})
  file(GLOB found RELATIVE ${SOURCE} ${SOURCE}/${pattern})
  if(NOT found)
    message(FATAL_ERROR "cmake/headers.cmake: there is no ${pattern}")
  endif()
  list(APPEND pending ${found})
endforeach()
while(pending)
  list(POP_FRONT pending header)
  if(NOT header IN_LIST headers)
    list(APPEND headers ${header})
    file(STRINGS ${SOURCE}/${header} included REGEX "^#include \"")
    list(TRANSFORM included REPLACE "^#include \"([^\"]+)\".*" "\\1")
    list(APPEND pending ${included})
  endif()
endwhile()
foreach(header ${headers})
  get_filename_component(folder ${header} DIRECTORY)
  file(INSTALL ${SOURCE}/${header} DESTINATION ${INCLUDE}/${folder})
endforeach()
