// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPictureDifference.h"

#include "MagmaColors.h"
#include "PictureErrors.h"
#include "PicturePair.h"
#include "Setters.h"

#include "vtkImageData.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <exception>
#include <limits>

vtkStandardNewMacro(vtkPictureDifference);

namespace
{
//------------------------------------------------------------------------------
// Null where there is no such metric.
const measuredbrdf::PictureMetric* Find(int metric)
{
  const auto& metrics = measuredbrdf::GetPictureMetrics();
  return metric >= 0 && metric < static_cast<int>(metrics.size())
           ? &metrics[static_cast<std::size_t>(metric)]
           : nullptr;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> MakeImage(int width, int height, int type, int components)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(type, components);
  return image;
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
    this->Map = MakeImage(pair.Width, pair.Height, VTK_FLOAT, 1);
    std::transform(error.Map.begin(), error.Map.end(),
      static_cast<float*>(this->Map->GetScalarPointer()),
      [](double value) { return static_cast<float>(value); });
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
  const int* size = this->Map->GetDimensions();
  const vtkSmartPointer<vtkImageData> image = MakeImage(size[0], size[1], VTK_UNSIGNED_CHAR, 3);
  const auto* errors = static_cast<const float*>(this->Map->GetScalarPointer());
  auto* bytes = static_cast<unsigned char*>(image->GetScalarPointer());
  const double brightest = Find(this->MapMetric)->Brightest;
  for (vtkIdType k = 0; k < this->Map->GetNumberOfPoints(); ++k)
  {
    const auto color = measuredbrdf::GetMagmaColor(errors[k] / brightest);
    std::copy(color.begin(), color.end(), bytes + 3 * k);
  }
  image->Register(nullptr);
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
