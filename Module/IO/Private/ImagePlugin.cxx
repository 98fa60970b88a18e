// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFile.h"

#include "FileBytes.h"

#include <vtksys/DynamicLoader.hxx>
#include <vtksys/SystemTools.hxx>

#if !defined(_WIN32)
#include <dlfcn.h>
#endif

namespace measuredbrdf
{
namespace
{
struct Plugin
{
  DecodeImageInPlugin* Read = nullptr;
  std::string Error; // why Read is null
};

//------------------------------------------------------------------------------
// The folder of the library that holds this code, with a slash; empty where it is not known.
std::string GetOwnFolder()
{
#if !defined(_WIN32)
  Dl_info info;
  if (::dladdr(reinterpret_cast<void*>(&DecodeImage), &info) != 0 && info.dli_fname)
  {
    const std::string path = info.dli_fname;
    return path.substr(0, path.rfind('/') + 1);
  }
#endif
  return "";
}

//------------------------------------------------------------------------------
Plugin LoadPlugin()
{
  using vtksys::DynamicLoader;
  const std::string file = MEASUREDBRDF_IMAGE_PLUGIN;
  const std::string path = vtksys::SystemTools::FileIsFullPath(file) ? file : GetOwnFolder() + file;
  Plugin plugin;
  const DynamicLoader::LibraryHandle library = DynamicLoader::OpenLibrary(path);
  if (library)
  {
    plugin.Read = reinterpret_cast<DecodeImageInPlugin*>(
      DynamicLoader::GetSymbolAddress(library, DecodeImageSymbol));
  }
  if (!plugin.Read)
  {
    const char* reason = DynamicLoader::LastError();
    plugin.Error = "images are read by the library " + path +
                   ", which cannot be loaded: " + (reason ? reason : "no reason was given");
  }
  return plugin;
}
}

//------------------------------------------------------------------------------
DecodedImage DecodeImage(const ImageSource& source)
{
  static const Plugin plugin = LoadPlugin(); // it stays loaded
  if (!plugin.Read)
  {
    throw FileError(source.Path + ": " + plugin.Error);
  }
  DecodedImage image;
  std::string error;
  if (!plugin.Read(source, image, error))
  {
    throw FileError(error);
  }
  return image;
}
} // namespace measuredbrdf
