// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SpectralChannels.h"

#include "NumberText.h"
#include "Printable.h"
#include "SpectralColor.h"

namespace measuredbrdf
{
namespace
{
constexpr std::size_t ListedNames = 8;

bool IsVisible(double wavelength)
{
  return wavelength > FirstVisible - 0.5 && wavelength < LastVisible + 0.5;
}

std::string List(const std::vector<double>& wavelengths)
{
  std::string names;
  for (std::size_t k = 0; k < wavelengths.size() && k < ListedNames; ++k)
  {
    names += (k > 0 ? ", " : "") + GetWavelengthName(wavelengths[k]);
  }
  return names + (wavelengths.size() > ListedNames ? ", ..." : "");
}
}

//------------------------------------------------------------------------------
std::string GetWavelengthName(double nanometers) { return NumberText(nanometers) + "nm"; }

//------------------------------------------------------------------------------
std::string SpectralChannels::Choose(
  const std::vector<double>& wavelengths, const std::string& name)
{
  this->Chosen.clear();
  std::vector<double> chosen;
  for (std::size_t k = 0; k < wavelengths.size(); ++k)
  {
    if (name.empty() ? IsVisible(wavelengths[k]) : GetWavelengthName(wavelengths[k]) == name)
    {
      this->Chosen.push_back(k);
      chosen.push_back(wavelengths[k]);
    }
  }
  if (!name.empty() && chosen.empty())
  {
    return "there is no wavelength " + Quote(name) + ", only " + List(wavelengths);
  }
  if (name.empty() && chosen.size() > 1)
  {
    this->Weights = GetSpectralWeights(chosen);
    this->Note = std::to_string(chosen.size()) + " of " + std::to_string(wavelengths.size()) +
                 " wavelengths, " + GetWavelengthName(chosen.front()) + " to " +
                 GetWavelengthName(chosen.back()) +
                 ": summed over the CIE 1931 color-matching functions under D65.";
    return "";
  }
  this->Chosen.assign(1, name.empty() ? 0 : this->Chosen.front());
  this->Weights = { { 1.0, 1.0, 1.0 } };
  const double wavelength = wavelengths[this->Chosen.front()];
  this->Note = "Gray, of the wavelength " + GetWavelengthName(wavelength) +
               (name.empty() && wavelengths.size() > 1
                   ? "; FILE#" + GetWavelengthName(wavelengths.back()) + " picks another one."
                   : ".");
  return "";
}
} // namespace measuredbrdf
