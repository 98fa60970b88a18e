# Compiles files that read the same headers together, since reading those takes most of the time. In a group, names in
# anonymous namespaces must differ, also from those of functions that other files of the group take from headers: the
# nearer one is called, whatever its arguments. Call these functions in the target's own CMakeLists.txt.
option(MEASUREDBRDF_COMPILE_IN_GROUPS "Compile files that belong together at once" ON)
mark_as_advanced(MEASUREDBRDF_COMPILE_IN_GROUPS)

# A group is a folder, or those of its files whose names begin alike where there are many. A file's group depends on its
# own name, so a new file moves no other, but where its folder crosses one of these limits.
function (measuredbrdf_compile_in_groups target)
  if (NOT MEASUREDBRDF_COMPILE_IN_GROUPS)
    return ()
  endif ()
  get_target_property(sources "${target}" SOURCES)
  foreach (source IN LISTS sources)
    if (source MATCHES "\\.cxx$")
      get_filename_component(folder "${source}" DIRECTORY)
      if (IS_ABSOLUTE "${folder}")
        set(folder "generated")
      endif ()
      string(MAKE_C_IDENTIFIER "${folder}" folder)
      list(APPEND folders "${folder}")
      list(APPEND files_${folder} "${source}")
    endif ()
  endforeach ()
  list(REMOVE_DUPLICATES folders)
  foreach (folder IN LISTS folders)
    list(LENGTH files_${folder} count)
    foreach (source IN LISTS files_${folder})
      get_filename_component(name "${source}" NAME)
      string(REGEX REPLACE "^vtk(Measured)?(BRDF)?" "" name "${name}")
      string(TOUPPER "${name}" name)
      set(range "A_Z")
      if (count GREATER 20)
        set(range "S_Z")
        if (name MATCHES "^[A-E]")
          set(range "A_E")
        elseif (name MATCHES "^[F-L]")
          set(range "F_L")
        elseif (name MATCHES "^[M-R]")
          set(range "M_R")
        endif ()
      elseif (count GREATER 10)
        set(range "M_Z")
        if (name MATCHES "^[A-L]")
          set(range "A_L")
        endif ()
      endif ()
      set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${folder}_${range}")
    endforeach ()
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

# Headers that most files of a target read, or OWNER, another target that has done so with the same compiler options and
# definitions or fewer: read once and kept, they save each group of files one to three seconds.
function (measuredbrdf_precompile_headers target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "OWNER" "")
  if (NOT MEASUREDBRDF_COMPILE_IN_GROUPS OR NOT MEASUREDBRDF_IS_PACKAGE) # VTK's own build has options of its own
    return ()
  endif ()
  if (arg_OWNER)
    target_precompile_headers("${target}" REUSE_FROM "${arg_OWNER}")
  else ()
    target_precompile_headers("${target}" PRIVATE ${arg_UNPARSED_ARGUMENTS})
  endif ()
endfunction ()
set(measuredbrdf_common_headers <algorithm> <array> <cmath> <functional> <iostream> <map> <memory> <mutex> <numeric>
  <random> <set> <sstream> <string> <utility> <vector> <glm/glm.hpp> <vtkDoubleArray.h> <vtkFloatArray.h> <vtkImageData.h>
  <vtkMath.h> <vtkNew.h> <vtkObjectFactory.h> <vtkPointData.h> <vtkPolyData.h> <vtkSmartPointer.h>)
