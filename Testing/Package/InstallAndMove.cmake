# cmake -DBUILD=... -DSTAGE=... -DPREFIX=... -DIMAGE_PLUGIN=... -P InstallAndMove.cmake
# Installs BUILD, moves the tree to PREFIX and checks that what lies there only leans on itself.
file(REMOVE_RECURSE "${STAGE}/first" "${PREFIX}" "${STAGE}/Cxx")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${STAGE}/first"
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(RENAME "${STAGE}/first" "${PREFIX}")

file(GLOB_RECURSE texts "${PREFIX}/*.cmake" "${PREFIX}/*.py" "${PREFIX}/*.h")
foreach (text IN LISTS texts)
  file(READ "${text}" content)
  foreach (path IN ITEMS "${STAGE}" "${BUILD}")
    string(FIND "${content}" "${path}" place)
    if (NOT place EQUAL -1)
      message(FATAL_ERROR "${text} names ${path}")
    endif ()
  endforeach ()
endforeach ()

file(GLOB_RECURSE binaries "${PREFIX}/*.so" "${PREFIX}/bin/*")
foreach (binary IN LISTS binaries)
  execute_process(COMMAND ldd "${binary}" OUTPUT_VARIABLE needed COMMAND_ERROR_IS_FATAL ANY)
  if (needed MATCHES "(libvtkMeasuredBRDF[^\n]*)" AND NOT CMAKE_MATCH_1 MATCHES "${PREFIX}")
    message(FATAL_ERROR "${binary} finds ${CMAKE_MATCH_1}, not the library in ${PREFIX}")
  endif ()
  # Where there is a plugin for images, nothing else loads OpenImageIO and all that it brings.
  get_filename_component(name "${binary}" NAME)
  if (IMAGE_PLUGIN AND needed MATCHES "libOpenImageIO" AND NOT name STREQUAL IMAGE_PLUGIN)
    message(FATAL_ERROR "${binary} loads OpenImageIO when it starts")
  endif ()
endforeach ()

# Whose work the library holds is said beside it.
foreach (name IN ITEMS LICENSE NOTICE)
  file(GLOB_RECURSE found "${PREFIX}/${name}")
  if (NOT found)
    message(FATAL_ERROR "${name} is not installed")
  endif ()
endforeach ()
