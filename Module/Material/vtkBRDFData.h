// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @struct  vtkBRDFData
 * @brief   a material as plain data: its model's name and its parameters
 *
 * Files store materials in this form, and programs show it. vtkBRDFModels makes it of a material
 * and back; a model lists its parameters in vtkBRDF::ExchangeData.
 */

#ifndef vtkBRDFData_h
#define vtkBRDFData_h

#include <map>    // for parameters
#include <string> // for names
#include <vector> // for arrays

struct vtkBRDFData
{
  struct Array
  {
    std::vector<int> Shape; // slowest axis first
    int Channels = 1;       // 1 or 3, interleaved
    std::vector<float> Values;
  };

  std::string Model; // vtkBRDF::GetModelName
  std::string Name;
  std::string Source;
  std::map<std::string, std::string> Options;
  std::map<std::string, std::vector<double>> Numbers;
  std::map<std::string, Array> Arrays;
  std::vector<vtkBRDFData> Terms;
};

#endif
