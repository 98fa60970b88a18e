# Compiles files that read the same headers together, since reading those takes most of the time. In a group, names in
# anonymous namespaces must differ, also from those of functions that other files of the group take from headers: the
# nearer one is called, whatever its arguments. Call these functions in the target's own CMakeLists.txt.
option(MEASUREDBRDF_COMPILE_IN_GROUPS "Compile files that belong together at once" ON)
mark_as_advanced(MEASUREDBRDF_COMPILE_IN_GROUPS)

# Files of one folder whose names begin alike. A file's group depends on its own name alone, so a new file moves no
# other.
function (measuredbrdf_compile_in_groups target)
  if (NOT MEASUREDBRDF_COMPILE_IN_GROUPS)
    return ()
  endif ()
  get_target_property(sources "${target}" SOURCES)
  foreach (source IN LISTS sources)
    get_filename_component(folder "${source}" DIRECTORY)
    get_filename_component(name "${source}" NAME)
    string(REGEX REPLACE "^vtk(Measured)?(BRDF)?" "" name "${name}")
    string(TOUPPER "${name}" name)
    if (NOT source MATCHES "\\.cxx$")
      continue ()
    elseif (name MATCHES "^[A-E]")
      set(range "A_E")
    elseif (name MATCHES "^[F-L]")
      set(range "F_L")
    elseif (name MATCHES "^[M-R]")
      set(range "M_R")
    else ()
      set(range "S_Z")
    endif ()
    if (IS_ABSOLUTE "${folder}")
      set(folder "generated")
    endif ()
    string(MAKE_C_IDENTIFIER "${folder}_${range}" group)
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${group}")
  endforeach ()
  set_target_properties("${target}" PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction ()

# Up to sixteen files that follow one another in the target's list: for targets whose names differ throughout.
function (measuredbrdf_compile_together target)
  if (MEASUREDBRDF_COMPILE_IN_GROUPS)
    set_target_properties("${target}" PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE BATCH UNITY_BUILD_BATCH_SIZE 16)
    # Classes of tests derive from what is in anonymous namespaces, which a group's file includes.
    target_compile_options("${target}" PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif ()
endfunction ()
