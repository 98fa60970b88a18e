# The libraries that the module is made with, beside VTK.
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
# VTK's own build has a FindEigen3 with another target, and a target `eigen` of its own, at sight of
# which Eigen's configuration defines nothing.
find_package(Eigen3 CONFIG REQUIRED)
if (NOT TARGET Eigen3::Eigen)
  include("${Eigen3_DIR}/Eigen3Targets.cmake")
endif ()
find_package(Ceres REQUIRED) # which looks for Eigen, too
find_package(OpenEXR REQUIRED)
find_path(MEASUREDBRDF_XXHASH_INCLUDE xxhash.h) # which is all that is needed of it
mark_as_advanced(MEASUREDBRDF_XXHASH_INCLUDE)
if (NOT MEASUREDBRDF_XXHASH_INCLUDE)
  message(FATAL_ERROR "xxHash was not found. Install it (Debian: libxxhash-dev).")
endif ()

# One more is optional. OFF: images are read by libraries of VTK's, which say what they cannot read.
option(MEASUREDBRDF_WITH_OPENIMAGEIO "Read images of more formats by OpenImageIO" ON)
macro (measuredbrdf_find_optional package debian_package)
  string(TOUPPER "MEASUREDBRDF_WITH_${package}" option)
  if (${option})
    find_package(${package})
    if (NOT ${package}_FOUND)
      message(FATAL_ERROR "${package} was not found. Install it (Debian: ${debian_package}), or do "
        "without what needs it: -D${option}=OFF.")
    endif ()
  endif ()
endmacro ()
measuredbrdf_find_optional(OpenImageIO "libopenimageio-dev openimageio-tools")
if (NOT MEASUREDBRDF_WITH_OPENIMAGEIO OR BUILD_TESTING) # tests read the same files both ways
  if (NOT _vtk_build_module)
    find_package(VTK REQUIRED COMPONENTS IOImage png tiff)
  endif ()
  find_package(OpenImageIO QUIET) # tests write images with it
endif ()

# One is optional for the command line tool.
if (MEASUREDBRDF_BUILD_TOOL)
  option(MEASUREDBRDF_WITH_CURL "Download materials and environments (needs libcurl)" ON)
  measuredbrdf_find_optional(CURL libcurl4-openssl-dev)
  if (MEASUREDBRDF_WITH_CURL)
    find_package(OpenSSL) # for SHA-256
    if (NOT OpenSSL_FOUND)
      message(FATAL_ERROR "OpenSSL was not found. Install it (Debian: libssl-dev) or configure with "
        "-DMEASUREDBRDF_WITH_CURL=OFF.")
    endif ()
  endif ()
endif ()

if (TARGET OpenImageIO::OpenImageIO)
  # Debian 13's OpenImageIO names OpenCV's include folder, which its packages do not bring.
  get_target_property(oiio_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
  foreach (folder IN LISTS oiio_includes)
    if (IS_ABSOLUTE "${folder}" AND NOT EXISTS "${folder}")
      list(REMOVE_ITEM oiio_includes "${folder}")
    endif ()
  endforeach ()
  set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${oiio_includes}")
endif ()

# The explorer is a program of its own beside the tool: without VTK's Qt widget it is left out.
option(MEASUREDBRDF_WITH_QT "Build the explorer, measured-brdf explore (needs VTK's Qt widget)" ON)
set(MEASUREDBRDF_HAS_EXPLORER OFF)
if (MEASUREDBRDF_BUILD_TOOL)
  if (NOT MEASUREDBRDF_WITH_QT)
    set(measuredbrdf_explorer_missing "MEASUREDBRDF_WITH_QT is off")
  elseif (NOT VTK_GUISupportQt_FOUND)
    set(measuredbrdf_explorer_missing "VTK's Qt widget was not found (Debian: libvtk9-qt-dev)")
  else ()
    find_package(Qt${VTK_QT_VERSION} QUIET COMPONENTS Widgets)
    if (Qt${VTK_QT_VERSION}_FOUND)
      set(MEASUREDBRDF_HAS_EXPLORER ON)
    else ()
      set(measuredbrdf_explorer_missing "Qt ${VTK_QT_VERSION} was not found (Debian: qtbase5-dev or qt6-base-dev)")
    endif ()
  endif ()
  if (NOT MEASUREDBRDF_HAS_EXPLORER)
    message(STATUS "Without Qt: the explorer is not built, ${measuredbrdf_explorer_missing}.")
  endif ()
endif ()
