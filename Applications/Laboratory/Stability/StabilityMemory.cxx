// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "StabilityMemory.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <malloc.h>

namespace
{
// OpenGL's names are small numbers, and drivers give those that are free again.
constexpr unsigned int LargestName = 1 << 14;

//------------------------------------------------------------------------------
// VTK's own loader of OpenGL has another name in each of its versions, so the library is asked.
void* FindOpenGLFunction(const char* name)
{
  for (const char* library : { "libOpenGL.so.0", "libGL.so.1" })
  {
    void* handle = dlopen(library, RTLD_LAZY | RTLD_LOCAL); // kept: it stays loaded anyway
    void* function = handle ? dlsym(handle, name) : nullptr;
    if (function)
    {
      return function;
    }
  }
  return nullptr;
}
}

namespace tool::stability
{
//------------------------------------------------------------------------------
double GetHeapInUse()
{
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd) * 1e-6;
#else
  return 0.0;
#endif
}

//------------------------------------------------------------------------------
void HeapGrowth::Add() { this->InUse.push_back(GetHeapInUse()); }

//------------------------------------------------------------------------------
double HeapGrowth::Get() const
{
  const std::size_t repetitions = this->InUse.empty() ? 0 : this->InUse.size() - 1;
  const std::size_t parts = std::min<std::size_t>(repetitions, 5);
  std::vector<double> growths;
  for (std::size_t k = 0; k < parts; ++k)
  {
    growths.push_back(
      this->InUse[(k + 1) * repetitions / parts] - this->InUse[k * repetitions / parts]);
  }
  if (growths.empty())
  {
    return 0.0;
  }
  const auto median = growths.begin() + static_cast<std::ptrdiff_t>(parts / 2);
  std::nth_element(growths.begin(), median, growths.end());
  return *median * static_cast<double>(parts);
}

//------------------------------------------------------------------------------
int CountOpenGLObjects()
{
  int count = 0;
  for (const char* name : { "glIsTexture", "glIsBuffer", "glIsFramebuffer", "glIsRenderbuffer",
         "glIsVertexArray", "glIsProgram", "glIsShader" })
  {
    const auto is = reinterpret_cast<unsigned char (*)(unsigned int)>(FindOpenGLFunction(name));
    if (!is)
    {
      return -1;
    }
    for (unsigned int k = 1; k <= LargestName; ++k)
    {
      count += is(k) != 0;
    }
  }
  return count;
}
} // namespace tool::stability
