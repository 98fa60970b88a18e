// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// Loaded before a program's own libraries: closing a file that is written under a name of the time
// being fails, as it does where a quota or a network file system tells of it no earlier.
#include <dlfcn.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

extern "C" int fclose(std::FILE* file)
{
  static const auto next = reinterpret_cast<int (*)(std::FILE*)>(dlsym(RTLD_NEXT, "fclose"));
  char link[64];
  char name[4096];
  std::snprintf(link, sizeof(link), "/proc/self/fd/%d", fileno(file));
  const ssize_t length = readlink(link, name, sizeof(name) - 1);
  name[length > 0 ? length : 0] = '\0';
  const int result = next(file);
  if (std::strstr(name, ".part"))
  {
    errno = EDQUOT;
    return -1;
  }
  return result;
}
