// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPictureDifference.h"

#include "PictureErrors.h"
#include "Setters.h"

#include "vtkColorTransferFunction.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <exception>
#include <iterator>
#include <limits>

vtkStandardNewMacro(vtkPictureDifference);

namespace
{
// Magma (van der Walt and Smith 2015), which FLIP's error maps have: black, purple, orange, pale
// yellow, in sRGB. Linear between 18 of the 256 published colors: at most 3 of 255 off.
constexpr unsigned char Magma[][3] = { { 0, 0, 4 }, { 9, 7, 32 }, { 26, 16, 66 }, { 49, 17, 101 },
  { 74, 16, 121 }, { 98, 25, 128 }, { 121, 34, 130 }, { 145, 43, 129 }, { 170, 51, 125 },
  { 194, 59, 117 }, { 217, 70, 107 }, { 236, 88, 96 }, { 247, 114, 92 }, { 252, 142, 100 },
  { 254, 170, 116 }, { 254, 198, 138 }, { 253, 226, 163 }, { 252, 253, 191 } };

//------------------------------------------------------------------------------
// Null where there is no such metric.
const measuredbrdf::PictureMetric* Find(int metric)
{
  const auto& metrics = measuredbrdf::GetPictureMetrics();
  return metric >= 0 && metric < static_cast<int>(metrics.size())
           ? &metrics[static_cast<std::size_t>(metric)]
           : nullptr;
}
}

//------------------------------------------------------------------------------
vtkPictureDifference::vtkPictureDifference() = default;
vtkPictureDifference::~vtkPictureDifference() = default;

//------------------------------------------------------------------------------
std::string vtkPictureDifference::GetMetricName(int metric)
{
  return Find(metric) ? Find(metric)->Name : "";
}

//------------------------------------------------------------------------------
bool vtkPictureDifference::IsSimilarity(int metric)
{
  return Find(metric) && Find(metric)->IsSimilarity;
}

//------------------------------------------------------------------------------
double vtkPictureDifference::GetDefaultThreshold(int metric)
{
  return Find(metric) ? Find(metric)->DefaultThreshold : 0.0;
}

//------------------------------------------------------------------------------
int vtkPictureDifference::FindMetric(const std::string& name)
{
  for (int metric = 0; Find(metric); ++metric)
  {
    if (name == Find(metric)->Name)
    {
      return metric;
    }
  }
  return -1;
}

//------------------------------------------------------------------------------
measuredbrdfSetInRangeMacro(vtkPictureDifference, Metric, int, 0, NUMBER_OF_METRICS - 1);
measuredbrdfSetInRangeMacro(
  vtkPictureDifference, Border, int, 0, std::numeric_limits<int>::max() / 2);

//------------------------------------------------------------------------------
void vtkPictureDifference::SetMask(vtkImageData* mask) { measuredbrdfAssignMacro(Mask, mask); }

//------------------------------------------------------------------------------
vtkImageData* vtkPictureDifference::GetMask() { return this->Mask; }

//------------------------------------------------------------------------------
vtkImageData* vtkPictureDifference::GetMap() { return this->Map; }

//------------------------------------------------------------------------------
bool vtkPictureDifference::Compare(vtkImageData* picture, vtkImageData* reference)
{
  this->ErrorMessage.clear();
  try
  {
    const measuredbrdf::PicturePair pair = measuredbrdf::MakePicturePair(
      picture, reference, { this->Border, this->Mask, this->IgnoreAlpha });
    const measuredbrdf::PictureError error =
      measuredbrdf::ComputePictureError(*Find(this->Metric), pair);
    this->Map = vtkSmartPointer<vtkImageData>::New();
    this->Map->SetDimensions(pair.Width, pair.Height, 1);
    this->Map->AllocateScalars(VTK_FLOAT, 1);
    Eigen::Map<Eigen::ArrayXf>(static_cast<float*>(this->Map->GetScalarPointer()),
      error.Map.size()) = error.Map.cast<float>();
    this->MapMetric = this->Metric;
    this->Value = error.Value;
    return true;
  }
  catch (const std::exception& e) // out of memory, too
  {
    this->ErrorMessage = e.what();
  }
  vtkErrorMacro(<< this->ErrorMessage);
  return false;
}

//------------------------------------------------------------------------------
bool vtkPictureDifference::IsWithin(double threshold)
{
  return IsSimilarity(this->MapMetric) ? this->Value >= threshold : this->Value <= threshold;
}

//------------------------------------------------------------------------------
vtkImageData* vtkPictureDifference::NewHeatMap()
{
  if (!this->Map)
  {
    return nullptr;
  }
  vtkNew<vtkColorTransferFunction> magma;
  const double step = Find(this->MapMetric)->Brightest / (std::size(Magma) - 1.0);
  for (const auto& color : Magma)
  {
    magma->AddRGBPoint(
      step * magma->GetSize(), color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
  }
  vtkImageData* image = vtkImageData::New();
  image->SetDimensions(this->Map->GetDimensions());
  image->GetPointData()->SetScalars(vtkSmartPointer<vtkUnsignedCharArray>::Take(magma->MapScalars(
    this->Map->GetPointData()->GetScalars(), VTK_COLOR_MODE_MAP_SCALARS, 0, VTK_RGB)));
  return image;
}

//------------------------------------------------------------------------------
void vtkPictureDifference::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Metric: " << GetMetricName(this->Metric) << "\n";
  os << indent << "Border: " << this->Border << "\n";
  os << indent << "Mask: " << this->Mask.Get() << "\n";
  os << indent << "IgnoreAlpha: " << this->IgnoreAlpha << "\n";
  os << indent << "Value: " << this->Value << "\n";
  os << indent << "Map: " << this->Map.Get() << "\n";
  os << indent << "ErrorMessage: " << this->ErrorMessage << "\n";
}
