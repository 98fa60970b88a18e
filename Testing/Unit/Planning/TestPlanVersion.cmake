# The version of plans kept on disk follows the sources: another text, or the same text under another
# name, is another version, and the same sources give the same one.
function (get_version result)
  execute_process(COMMAND "${CMAKE_COMMAND}"
    "-DSOURCES=${FOLDER}/a.h;${FOLDER}/b.cxx" "-DOUTPUT=${FOLDER}/version.h" -P "${SCRIPT}"
    RESULT_VARIABLE status)
  if (status)
    message(FATAL_ERROR "the script failed: ${status}")
  endif ()
  file(READ "${FOLDER}/version.h" text)
  if (NOT text MATCHES "^#define MEASUREDBRDF_PLAN_VERSION \"[0-9a-f]+\"\n$")
    message(FATAL_ERROR "found: ${text}")
  endif ()
  set("${result}" "${text}" PARENT_SCOPE)
endfunction ()

file(WRITE "${FOLDER}/a.h" "int a;\n")
file(WRITE "${FOLDER}/b.cxx" "int b;\n")
get_version(first)
get_version(same)
file(WRITE "${FOLDER}/b.cxx" "int c;\n")
get_version(changed)
file(WRITE "${FOLDER}/a.h" "int c;\n")
file(WRITE "${FOLDER}/b.cxx" "int a;\n")
get_version(exchanged)
if (NOT first STREQUAL same OR first STREQUAL changed OR changed STREQUAL exchanged OR
    first STREQUAL exchanged)
  message(FATAL_ERROR "versions: ${first}${same}${changed}${exchanged}")
endif ()
