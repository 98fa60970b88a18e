// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// MakeFuzzSeeds TARGET FOLDER: writes the target's seeds, one file each.
#include "FuzzSeeds.h"

#include <cstdio>
#include <fstream>

int main(int argc, char* argv[])
{
  const std::vector<std::string> seeds =
    argc == 3 ? fuzz::MakeSeeds(argv[1]) : std::vector<std::string>();
  if (seeds.empty())
  {
    std::fprintf(stderr, "usage: MakeFuzzSeeds TARGET FOLDER\n");
    return 2;
  }
  for (std::size_t k = 0; k < seeds.size(); ++k)
  {
    std::ofstream file(std::string(argv[2]) + "/seed-" + std::to_string(k), std::ios::binary);
    file.write(seeds[k].data(), static_cast<std::streamsize>(seeds[k].size()));
    if (!file.flush())
    {
      std::fprintf(stderr, "MakeFuzzSeeds: cannot write to %s\n", argv[2]);
      return 1;
    }
  }
  return 0;
}
