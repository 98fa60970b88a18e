# Image regression tests with `measured-brdf diff`, for the users of the installed package.

#[[
measuredbrdf_add_image_test(NAME name BASELINE file PICTURE file COMMAND program [argument...]
  [ALTERNATIVES] [DIFF_OPTIONS option...])

Adds three tests. `name.clean` removes PICTURE, so that none of an earlier run is compared. `name`
runs the command, which writes PICTURE. `name.diff` compares PICTURE with BASELINE; it is only run
where `name` has passed.

Relative paths: PICTURE is in the current binary folder, where the tests run, BASELINE in the
current source folder. ALTERNATIVES: BASELINE_1.png, BASELINE_2.png and so on may serve, too, as far
as there are files. DIFF_OPTIONS are those of `measured-brdf diff`: --metric flip --threshold 0.01.
]]
function (measuredbrdf_add_image_test)
  cmake_parse_arguments(PARSE_ARGV 0 test "ALTERNATIVES" "NAME;BASELINE;PICTURE"
    "COMMAND;DIFF_OPTIONS")
  foreach (argument IN ITEMS NAME BASELINE PICTURE COMMAND)
    if (NOT test_${argument})
      message(FATAL_ERROR "measuredbrdf_add_image_test: ${argument} is missing")
    endif ()
  endforeach ()
  if (test_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR
      "measuredbrdf_add_image_test: unknown arguments: ${test_UNPARSED_ARGUMENTS}")
  endif ()
  if (NOT vtkMeasuredBRDF_TOOL)
    message(FATAL_ERROR "measuredbrdf_add_image_test: this vtkMeasuredBRDF has no command line "
      "tool (MEASUREDBRDF_BUILD_TOOL)")
  endif ()
  get_filename_component(baseline "${test_BASELINE}" ABSOLUTE)
  get_filename_component(picture "${test_PICTURE}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_BINARY_DIR}")
  set(options ${test_DIFF_OPTIONS})
  if (test_ALTERNATIVES)
    list(APPEND options --alternatives)
  endif ()
  add_test(NAME "${test_NAME}" COMMAND ${test_COMMAND}
    WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
  add_test(NAME "${test_NAME}.diff"
    COMMAND "${vtkMeasuredBRDF_TOOL}" diff --dart "${picture}" "${baseline}" ${options}
    WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
  add_test(NAME "${test_NAME}.clean" COMMAND "${CMAKE_COMMAND}" -E rm -f "${picture}")
  set_tests_properties("${test_NAME}.clean" PROPERTIES FIXTURES_SETUP "${test_NAME}.clean")
  set_tests_properties("${test_NAME}" PROPERTIES
    FIXTURES_REQUIRED "${test_NAME}.clean"
    FIXTURES_SETUP "${test_NAME}.picture")
  set_tests_properties("${test_NAME}.diff" PROPERTIES FIXTURES_REQUIRED "${test_NAME}.picture")
endfunction ()
