# The libraries that the module is made with, beside VTK.
find_package(OpenImageIO REQUIRED)
# Debian 13's OpenImageIO names OpenCV's include folder, which its packages do not bring.
get_target_property(oiio_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
foreach (folder IN LISTS oiio_includes)
  if (IS_ABSOLUTE "${folder}" AND NOT EXISTS "${folder}")
    list(REMOVE_ITEM oiio_includes "${folder}")
  endif ()
endforeach ()
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
  INTERFACE_INCLUDE_DIRECTORIES "${oiio_includes}")
find_package(OpenEXR REQUIRED)
find_package(glm REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(Ceres REQUIRED)
