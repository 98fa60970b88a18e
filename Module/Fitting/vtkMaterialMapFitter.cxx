// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMaterialMapFitter.h"

#include "MaterialMapFit.h"
#include "PhotographPasses.h"
#include "Printable.h"
#include "Setters.h"
#include "vtkBRDF.h"
#include "vtkCommand.h"
#include "vtkImageData.h"
#include "vtkMaterialMap.h"
#include "vtkObjectFactory.h"
#include "vtkPhotographSet.h"

#include <algorithm>

using namespace measuredbrdf;

vtkStandardNewMacro(vtkMaterialMapFitter);

namespace
{
constexpr int MostComponents = 4; // of a weight image

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> NewImage(int width, int height, int components)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_FLOAT, components);
  return image;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkMaterialMap> MakeMap(const MapFitResult& result)
{
  auto map = vtkSmartPointer<vtkMaterialMap>::New();
  map->SetModeToTextures();
  const int materials = static_cast<int>(result.Materials.size());
  for (const MapMaterial& material : result.Materials)
  {
    map->AddMaterial(material.Material.BRDF, material.Material.Name);
  }
  for (int first = 0; first < materials; first += MostComponents)
  {
    const int components = std::min(MostComponents, materials - first);
    const auto image = NewImage(result.Width, result.Height, components);
    auto* values = static_cast<float*>(image->GetScalarPointer());
    for (std::size_t texel = 0; texel < result.Errors.size(); ++texel)
    {
      const float* weights = &result.Weights[texel * static_cast<std::size_t>(materials)];
      values = std::copy_n(weights + first, components, values);
    }
    map->AddWeightImage(image);
  }
  return map;
}
}

//------------------------------------------------------------------------------
struct vtkMaterialMapFitter::Results : MapFitResult
{
  Results() { this->Converged = false; } // before the first Fit

  vtkIdType Count(PixelState state) const
  {
    return static_cast<vtkIdType>(this->PixelCounts[static_cast<std::size_t>(state)]);
  }

  // Of a material; zeros where there is none of that number.
  MapMaterial Get(int material) const
  {
    const bool exists =
      material >= 0 && static_cast<std::size_t>(material) < this->Materials.size();
    return exists ? this->Materials[static_cast<std::size_t>(material)] : MapMaterial();
  }
};

//------------------------------------------------------------------------------
vtkMaterialMapFitter::vtkMaterialMapFitter()
  : Found(new Results)
{
}

//------------------------------------------------------------------------------
vtkMaterialMapFitter::~vtkMaterialMapFitter() = default;

//------------------------------------------------------------------------------
void vtkMaterialMapFitter::SetPhotographs(vtkPhotographSet* photographs)
{
  measuredbrdfAssignMacro(Photographs, photographs);
}

//------------------------------------------------------------------------------
vtkPhotographSet* vtkMaterialMapFitter::GetPhotographs() { return this->Photographs; }
vtkMaterialMap* vtkMaterialMapFitter::GetOutput() { return this->Output; }
vtkImageData* vtkMaterialMapFitter::GetErrorImage() { return this->ErrorImage; }

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkMaterialMapFitter, Method, int, LIBRARY, TABLES);
measuredbrdfSetInRangeMacro(vtkMaterialMapFitter, MaximumNumberOfMaterials, int, 1, 32);
measuredbrdfSetClampedMacro(vtkMaterialMapFitter, Tolerance, double, 0.0, 1.0);
measuredbrdfSetClampedMacro(vtkMaterialMapFitter, Compactness, double, 0.0, 1.0);
measuredbrdfSetClampedMacro(vtkMaterialMapFitter, Smoothness, double, 1e-8, 1e4);
measuredbrdfSetClampedMacro(vtkMaterialMapFitter, NumberOfSampleTexels, int, 64, 1 << 20);
measuredbrdfSetClampedMacro(vtkMaterialMapFitter, MemoryLimit, int, 1, 1 << 20);

//------------------------------------------------------------------------------
void vtkMaterialMapFitter::SetTableDimensions(int phiD, int thetaD, int thetaH)
{
  constexpr int least = 4, most = 90;
  const int given[3] = { phiD, thetaD, thetaH };
  int taken[3];
  std::transform(
    given, given + 3, taken, [&](int value) { return std::clamp(value, least, most); });
  if (!std::equal(given, given + 3, taken))
  {
    vtkWarningMacro("SetTableDimensions: " << phiD << ", " << thetaD << ", " << thetaH
                                           << " are not all from " << least << " to " << most
                                           << "; " << taken[0] << ", " << taken[1] << ", "
                                           << taken[2] << " are taken.");
  }
  if (!std::equal(taken, taken + 3, this->TableDimensions))
  {
    std::copy_n(taken, 3, this->TableDimensions);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkMaterialMapFitter::AddMaterial(vtkBRDF* brdf, const std::string& name)
{
  if (!brdf || this->GetNumberOfLibraryMaterials() >= MaximumLibrarySize)
  {
    vtkErrorMacro("AddMaterial: " << (brdf ? "there are " + std::to_string(MaximumLibrarySize) +
                                               " materials, the most"
                                           : std::string("found null, expected a material"))
                                  << ".");
    return;
  }
  this->Library.push_back({ brdf, name });
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkMaterialMapFitter::RemoveAllMaterials()
{
  this->Library.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkMaterialMapFitter::Fit()
{
  if (!this->Photographs || this->Photographs->GetNumberOfPhotographs() == 0)
  {
    vtkErrorMacro("Fit: no photographs.");
    return false;
  }
  if (this->Method == LIBRARY && this->Library.empty())
  {
    vtkErrorMacro("Fit: no material in the library.");
    return false;
  }
  this->Abort = false;
  MapFitOptions options;
  options.FindsTables = this->Method == TABLES;
  for (const auto& [brdf, name] : this->Library)
  {
    options.Library.push_back({ brdf, name });
  }
  options.Most = this->MaximumNumberOfMaterials;
  options.Tolerance = this->Tolerance;
  options.Compactness = this->Compactness;
  options.Smoothness = this->Smoothness;
  std::copy_n(this->TableDimensions, 3, options.TableDimensions.begin());
  options.SampleTexels = this->NumberOfSampleTexels;
  options.MemoryBytes = static_cast<std::size_t>(this->MemoryLimit) << 20;
  options.Seed = this->Seed;
  options.Proceed = [this](double share)
  {
    this->InvokeEvent(vtkCommand::ProgressEvent, &share);
    return !this->Abort;
  };
  MapFitResult result = FitMaterialMap(this->Photographs, options);
  if (result.Stopped)
  {
    return false;
  }
  if (!result.Problem.empty())
  {
    vtkErrorMacro("Fit: " << ToPrintable(result.Problem) << ".");
    return false;
  }
  this->Output = MakeMap(result);
  this->ErrorImage = NewImage(result.Width, result.Height, 1);
  std::copy(result.Errors.begin(), result.Errors.end(),
    static_cast<float*>(this->ErrorImage->GetScalarPointer()));
  this->WorstTexel[0] = static_cast<int>(result.WorstTexel) % result.Width;
  this->WorstTexel[1] = static_cast<int>(result.WorstTexel) / result.Width;
  result.Weights.clear(); // they are in the images
  result.Errors.clear();
  static_cast<MapFitResult&>(*this->Found) = std::move(result);
  return true;
}

//------------------------------------------------------------------------------
double vtkMaterialMapFitter::GetMeanError() { return this->Found->MeanError; }
double vtkMaterialMapFitter::GetError95() { return this->Found->Error95; }
double vtkMaterialMapFitter::GetWorstError() { return this->Found->WorstError; }
double vtkMaterialMapFitter::GetFactorizationError() { return this->Found->FactorError; }
double vtkMaterialMapFitter::GetSeenShare() { return this->Found->SeenShare; }
int vtkMaterialMapFitter::GetNumberOfIterations() { return this->Found->Iterations; }
bool vtkMaterialMapFitter::GetConverged() { return this->Found->Converged; }
int vtkMaterialMapFitter::GetNumberOfPasses() { return this->Found->Passes; }

//------------------------------------------------------------------------------
vtkIdType vtkMaterialMapFitter::GetNumberOfSaturatedPixels()
{
  return this->Found->Count(PixelState::Saturated);
}

//------------------------------------------------------------------------------
vtkIdType vtkMaterialMapFitter::GetNumberOfBlackPixels()
{
  return this->Found->Count(PixelState::Black);
}

//------------------------------------------------------------------------------
vtkIdType vtkMaterialMapFitter::GetNumberOfInvalidPixels()
{
  return this->Found->Count(PixelState::Invalid);
}

//------------------------------------------------------------------------------
vtkIdType vtkMaterialMapFitter::GetNumberOfTexelsWithoutData()
{
  return static_cast<vtkIdType>(this->Found->TexelsWithoutData);
}

//------------------------------------------------------------------------------
double vtkMaterialMapFitter::GetCoverage(int material)
{
  return this->Found->Get(material).Coverage;
}

//------------------------------------------------------------------------------
double vtkMaterialMapFitter::GetLargestWeight(int material)
{
  return this->Found->Get(material).LargestWeight;
}

//------------------------------------------------------------------------------
double vtkMaterialMapFitter::GetUncertainty(int material)
{
  return this->Found->Get(material).Uncertainty;
}

//------------------------------------------------------------------------------
int vtkMaterialMapFitter::GetNumberOfFindings()
{
  return static_cast<int>(this->Found->Findings.size());
}

//------------------------------------------------------------------------------
std::string vtkMaterialMapFitter::GetFinding(int index)
{
  return index >= 0 && index < this->GetNumberOfFindings()
           ? this->Found->Findings[static_cast<std::size_t>(index)]
           : std::string();
}

//------------------------------------------------------------------------------
void vtkMaterialMapFitter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Photographs: " << this->Photographs.Get() << "\n";
  os << indent << "Output: " << this->Output.Get() << "\n";
  os << indent << "ErrorImage: " << this->ErrorImage.Get() << "\n";
  os << indent << "Method: " << (this->Method == LIBRARY ? "LIBRARY" : "TABLES") << "\n";
  os << indent << "NumberOfLibraryMaterials: " << this->Library.size() << "\n";
  os << indent << "MaximumNumberOfMaterials: " << this->MaximumNumberOfMaterials << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "Compactness: " << this->Compactness << "\n";
  os << indent << "Smoothness: " << this->Smoothness << "\n";
  os << indent << "TableDimensions: " << this->TableDimensions[0] << " " << this->TableDimensions[1]
     << " " << this->TableDimensions[2] << "\n";
  os << indent << "NumberOfSampleTexels: " << this->NumberOfSampleTexels << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Abort: " << (this->Abort ? "On" : "Off") << "\n";
  os << indent << "MeanError: " << this->GetMeanError() << "\n";
  os << indent << "Error95: " << this->GetError95() << "\n";
  os << indent << "WorstError: " << this->GetWorstError() << "\n";
  os << indent << "WorstTexel: " << this->WorstTexel[0] << " " << this->WorstTexel[1] << "\n";
  os << indent << "NumberOfSaturatedPixels: " << this->GetNumberOfSaturatedPixels() << "\n";
  os << indent << "NumberOfBlackPixels: " << this->GetNumberOfBlackPixels() << "\n";
  os << indent << "NumberOfInvalidPixels: " << this->GetNumberOfInvalidPixels() << "\n";
  os << indent << "NumberOfTexelsWithoutData: " << this->GetNumberOfTexelsWithoutData() << "\n";
  os << indent << "FactorizationError: " << this->GetFactorizationError() << "\n";
  os << indent << "SeenShare: " << this->GetSeenShare() << "\n";
  os << indent << "NumberOfIterations: " << this->GetNumberOfIterations() << "\n";
  os << indent << "Converged: " << (this->GetConverged() ? "On" : "Off") << "\n";
  os << indent << "NumberOfPasses: " << this->GetNumberOfPasses() << "\n";
  os << indent << "NumberOfFindings: " << this->GetNumberOfFindings() << "\n";
}
