// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Evaluation.h"

#include "Display.h"
#include "Measuring.h"
#include "Picture.h"
#include "ReferencePicture.h"
#include "Scenes.h"
#include "Tool.h"

#include "vtkCamera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace
{
constexpr int SettleTime = 250; // ms
const char* const JobKey = "reference";

//------------------------------------------------------------------------------
double GetMean(const std::vector<double>& rgb)
{
  return std::accumulate(rgb.begin(), rgb.end(), 0.0) /
         double(std::max<std::size_t>(rgb.size(), 1));
}

//------------------------------------------------------------------------------
// Gives pixels beside covered ones their color, not their alpha: edges do not become dark where the
// picture is stretched.
void Dilate(tool::Picture& picture)
{
  const tool::Picture covered = picture;
  for (int y = 0; y < picture.Height; ++y)
  {
    for (int x = 0; x < picture.Width; ++x)
    {
      for (int k = 0; k < 9 && covered.At(x, y)[3] == 0.0f; ++k)
      {
        const int i = x + k % 3 - 1;
        const int j = y + k / 3 - 1;
        if (i >= 0 && j >= 0 && i < picture.Width && j < picture.Height &&
            covered.At(i, j)[3] > 0.0f)
        {
          picture.At(x, y) = glm::vec4(glm::vec3(covered.At(i, j)), 0.0f);
          break;
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
// Mean |x - r| / mean r; negative where there is no light to compare with.
double GetRelativeL1(const std::vector<double>& rgb, const std::vector<double>& reference)
{
  const double mean = GetMean(reference);
  double sum = 0.0;
  for (std::size_t k = 0; k < rgb.size(); ++k)
  {
    sum += std::abs(rgb[k] - reference[k]);
  }
  return mean > 0.0 ? sum / double(rgb.size()) / mean : -1.0;
}
}

namespace explorer
{
//------------------------------------------------------------------------------
Evaluation::Evaluation(
  Session* session, Jobs* jobs, std::array<Side*, 2> sides, vtkCamera* camera, QObject* parent)
  : QObject(parent)
  , Model(session)
  , Background(jobs)
  , Sides(sides)
  , Camera(camera)
{
  this->Timer.setSingleShot(true);
  this->Timer.setInterval(SettleTime);
  connect(&this->Timer, &QTimer::timeout, this, &Evaluation::Settle);
  for (const auto signal : { &Session::materialChanged, &Session::environmentChanged,
         &Session::rotationChanged, &Session::meshChanged, &Session::cameraChanged,
         &Session::cameraReplaced, &Session::referenceHeightChanged })
  {
    connect(session, signal, this, &Evaluation::Restart);
  }
  connect(session, &Session::lightChanged, this,
    [this]()
    {
      if (this->Model->IsDirectional())
      {
        this->RestartLight();
      }
    });
  for (Side* side : this->Sides)
  {
    connect(side, &Side::changed, this, &Evaluation::RestartSides);
  }
}

//------------------------------------------------------------------------------
void Evaluation::SetAspect(double aspect)
{
  if (aspect > 0.0 && aspect != this->Aspect)
  {
    this->Aspect = aspect;
    this->Restart();
  }
}

//------------------------------------------------------------------------------
void Evaluation::Restart()
{
  this->Visible.reset();
  this->RestartLight();
}

//------------------------------------------------------------------------------
// The surface stays.
void Evaluation::RestartLight()
{
  this->Background->Stop(JobKey);
  this->Reference.reset();
  this->Radiance.clear();
  this->Complete = false;
  this->RestartSides();
}

//------------------------------------------------------------------------------
void Evaluation::RestartSides()
{
  this->Pictures = {};
  this->Figures = {};
  this->Failed = false;
  this->Timer.start();
  Q_EMIT this->changed();
}

//------------------------------------------------------------------------------
void Evaluation::Settle()
{
  if (!this->Model->GetMaterial().BRDF || !this->Model->IsLit() || !this->Model->GetMesh() ||
      this->Failed)
  {
    return;
  }
  try
  {
    if (!this->Visible)
    {
      const int height = this->Model->GetState().ReferenceHeight;
      this->Size = { std::max(1, static_cast<int>(std::lround(height * this->Aspect))), height };
      this->Visible = std::make_shared<const tool::Surface>(tool::FindSurface(
        this->Model->GetMesh(), this->Camera, this->Size, std::numeric_limits<int>::max()));
    }
    this->Capture();
    // Plans and methods first: they take less time, and show more.
    if (!this->Complete && !this->Background->IsRunning(JobKey) && this->Sides[0]->IsReady() &&
        this->Sides[1]->IsReady())
    {
      this->StartReference();
    }
  }
  catch (const std::exception&)
  {
    this->Failed = true; // nothing of the mesh is in view
  }
  this->Measure();
  if (!this->IsSettled())
  {
    this->Timer.start(); // a plan or a method is being made
  }
  Q_EMIT this->changed();
}

//------------------------------------------------------------------------------
void Evaluation::Capture()
{
  for (std::size_t k = 0; k < 2; ++k)
  {
    if (this->Figures[k].IsMeasured || !this->Sides[k]->IsReady())
    {
      continue;
    }
    if (!this->Sides[k]->IsReference())
    {
      this->Pictures[k] = std::make_shared<const tool::Picture>(
        this->Sides[k]->Capture(this->Camera, this->Size, this->Figures[k].Frame));
    }
    this->Figures[k].IsMeasured = true;
  }
}

//------------------------------------------------------------------------------
void Evaluation::StartReference()
{
  const tool::Material material = MakeSnapshot(this->Model->GetMaterial());
  const bool isDirectional = this->Model->IsDirectional();
  const LightState light = this->Model->GetState().Light;
  const auto environment = vtkSmartPointer<vtkEnvironment>::Take(
    isDirectional ? nullptr : this->Model->GetEnvironment()->NewSnapshot());
  this->Background->Start(
    JobKey, tr("exact picture"),
    [this, brdf = material.BRDF, environment, isDirectional, light, surface = this->Visible,
      size = this->Size](const Jobs::Post& post)
    {
      const auto take = [this, &post](const std::vector<double>& radiance, bool complete)
      { post([this, radiance, complete]() { this->TakeReference(radiance, complete); }); };
      take(isDirectional
             ? DrawDirectional(brdf, *surface, light)
             : tool::DrawReference(brdf, environment, *surface, size,
                 [&take](const std::vector<double>& radiance) { take(radiance, false); })
                 .Radiance,
        true);
    },
    [this](const QString& text)
    {
      this->Failed = true;
      this->Model->Say(text, true);
    });
}

//------------------------------------------------------------------------------
void Evaluation::TakeReference(const std::vector<double>& radiance, bool complete)
{
  this->Radiance = radiance;
  this->Complete = complete;
  tool::Picture picture = tool::Grid(*this->Visible, this->Size).Draw(radiance);
  Dilate(picture);
  this->Reference = std::make_shared<const tool::Picture>(std::move(picture));
  this->Measure();
  Q_EMIT this->changed();
}

//------------------------------------------------------------------------------
std::shared_ptr<const tool::Picture> Evaluation::GetPicture(int side) const
{
  return this->Sides[side]->IsReference() ? this->Reference : this->Pictures[side];
}

//------------------------------------------------------------------------------
std::vector<double> Evaluation::GetRadiance(int side) const
{
  const auto picture = this->GetPicture(side);
  return picture && this->Visible ? tool::Pick(*picture, *this->Visible) : std::vector<double>();
}

//------------------------------------------------------------------------------
void Evaluation::Measure()
{
  for (int k = 0; k < 2 && this->Complete; ++k)
  {
    const std::vector<double> radiance = this->GetRadiance(k);
    if (radiance.size() == this->Radiance.size())
    {
      this->Figures[k].Error =
        this->Sides[k]->IsReference() ? 0.0 : GetRelativeL1(radiance, this->Radiance);
    }
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> Evaluation::MakeDifference(double& mean) const
{
  const std::vector<double> a = this->GetRadiance(0);
  const std::vector<double> b = this->GetRadiance(1);
  const double scale = GetMean(this->Complete ? this->Radiance : b);
  mean = -1.0;
  if (a.empty() || b.empty() || !(scale > 0.0))
  {
    return nullptr;
  }
  const auto colors = tool::MakeErrorColors();
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(this->Size.Width, this->Size.Height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  auto* pixels = static_cast<std::array<unsigned char, 4>*>(image->GetScalarPointer());
  constexpr std::array<unsigned char, 4> gray = { 40, 41, 44, 255 }; // where there is no mesh
  std::fill_n(pixels, image->GetNumberOfPoints(), gray);
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); k += 3)
  {
    const double share =
      (std::abs(a[k] - b[k]) + std::abs(a[k + 1] - b[k + 1]) + std::abs(a[k + 2] - b[k + 2])) /
      (3.0 * scale);
    sum += share;
    const double logarithm = std::log10(std::max(share, 1e-12));
    const unsigned char* rgb =
      colors->MapValue(std::clamp(logarithm, tool::LowestError, tool::HighestError));
    std::copy_n(rgb, 4, pixels[this->Visible->Pixels[k / 3]].begin());
  }
  mean = sum / double(a.size() / 3);
  return image;
}
} // namespace explorer
