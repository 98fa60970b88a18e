// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Picture.h"

#include "Files.h"
#include "Tool.h"

#include "vtkEnvironment.h"
#include "vtkImageData.h"
#include "vtkImageShrink3D.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkStdString.h"
#include "vtkTextProperty.h"
#include "vtkTextRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace tool
{
//------------------------------------------------------------------------------
void Picture::Blend(int x, int y, const RGB& rgb, double alpha)
{
  if (x < 0 || y < 0 || x >= this->Width || y >= this->Height)
  {
    return;
  }
  glm::vec4& pixel = this->At(x, y);
  pixel = glm::mix(glm::dvec4(pixel), glm::dvec4(rgb, 1.0), alpha);
}

//------------------------------------------------------------------------------
double RollOff(double linear)
{
  constexpr double knee = 0.7;
  if (linear <= knee)
  {
    return std::max(0.0, linear);
  }
  return knee + (1.0 - knee) * (1.0 - std::exp(-(linear - knee) / (1.0 - knee)));
}

//------------------------------------------------------------------------------
double EncodeGamma(double linear) { return std::pow(linear, 1.0 / 2.2); }

//------------------------------------------------------------------------------
Picture Downsample(const Picture& picture, int factor)
{
  Picture result(picture.Width / factor, picture.Height / factor);
  for (int y = 0; y < result.Height; ++y)
  {
    for (int x = 0; x < result.Width; ++x)
    {
      glm::dvec4 sum(0.0);
      for (int k = 0; k < factor * factor; ++k)
      {
        sum += picture.At(x * factor + k % factor, y * factor + k / factor);
      }
      result.At(x, y) = sum / static_cast<double>(factor * factor);
    }
  }
  return result;
}

//------------------------------------------------------------------------------
void WritePNG(const std::string& path, const Picture& picture, double (*encode)(double))
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(picture.Width, picture.Height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* bytes = static_cast<unsigned char*>(image->GetScalarPointer());
  for (std::size_t k = 0; k < picture.Pixels.size() / 4; ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double value = std::clamp<double>(picture.Pixels[4 * k + c], 0.0, 1.0);
      bytes[3 * k + c] = static_cast<unsigned char>(std::lround(255.0 * encode(value)));
    }
  }
  WritePNG(path, image);
}

//------------------------------------------------------------------------------
void WritePNG(const std::string& path, vtkImageData* image)
{
  vtkNew<vtkPNGWriter> writer;
  writer->WriteToMemoryOn();
  writer->SetInputData(image);
  writer->Write();
  const std::string errors = TakeErrorText();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  if (writer->GetErrorCode() != 0 || !errors.empty() || !bytes)
  {
    throw Error(path + ": cannot be written: " + (errors.empty() ? "no PNG was made" : errors));
  }
  WriteWhole(path, { reinterpret_cast<const char*>(bytes->GetPointer(0)),
                     static_cast<std::size_t>(bytes->GetNumberOfValues()) });
}

//------------------------------------------------------------------------------
void WriteEXR(const std::string& path, const Picture& picture)
{
  // EXR has its first row at the top.
  const std::size_t row = 4 * static_cast<std::size_t>(picture.Width);
  std::vector<float> pixels;
  pixels.reserve(picture.Pixels.size());
  for (int y = picture.Height - 1; y >= 0; --y)
  {
    const float* first = &picture.At(0, y).x;
    pixels.insert(pixels.end(), first, first + row);
  }
  std::string bytes;
  try
  {
    Imf::Header header(picture.Width, picture.Height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    const char* const names[] = { "R", "G", "B", "A" };
    for (std::size_t c = 0; c < 4; ++c)
    {
      header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
      buffer.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&pixels[c]),
                                4 * sizeof(float), row * sizeof(float)));
    }
    Imf::StdOSStream stream; // in memory: files are written in one way, which reports all errors
    {
      Imf::OutputFile output(stream, header);
      output.setFrameBuffer(buffer);
      output.writePixels(picture.Height);
    }
    bytes = stream.str();
  }
  catch (const std::exception& e)
  {
    throw Error(path + ": cannot be written: " + e.what());
  }
  WriteWhole(path, bytes);
}

//------------------------------------------------------------------------------
RGB Backdrop::Look(const glm::dvec3& direction) const
{
  RGB rgb;
  this->Environment->GetRadiance(&direction.x, &rgb.x);
  return this->Factor * rgb;
}

//------------------------------------------------------------------------------
Picture Backdrop::Draw(int width, int height) const
{
  Picture picture(width, height);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      glm::dvec3 direction;
      vtkEnvironment::GetDirection((x + 0.5) / width, (y + 0.5) / height, &direction.x);
      picture.At(x, y) = glm::dvec4(this->Look(direction), 1.0);
    }
  }
  return picture;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkEnvironment> Shrink(vtkEnvironment* environment, int width, int height)
{
  const auto whole = vtkSmartPointer<vtkImageData>::Take(environment->NewImageData());
  vtkNew<vtkImageShrink3D> mean;
  mean->SetInputData(whole);
  mean->SetShrinkFactors(std::max(1, environment->GetWidth() / width),
    std::max(1, environment->GetHeight() / height), 1);
  mean->MeanOn();
  mean->Update();
  auto small = vtkSmartPointer<vtkEnvironment>::New();
  small->SetImage(mean->GetOutput());
  return small;
}

//------------------------------------------------------------------------------
Backdrop MakeQuietBackdrop(vtkEnvironment* environment)
{
  constexpr double dim = 0.42;
  const double angle = vtkMath::RadiansFromDegrees(11.0); // where the kernel has fallen to a half
  const double sharpness = std::log(2.0) / (1.0 - std::cos(angle));
  const vtkSmartPointer<vtkEnvironment> coarse = Shrink(environment, 64, 32);
  const int width = coarse->GetWidth();
  const int height = coarse->GetHeight();
  std::vector<glm::dvec3> directions(width * height);
  std::vector<glm::dvec4> light(directions.size()); // times solid angle, which is the last one
  for (int k = 0; k < width * height; ++k)
  {
    glm::dvec3 rgb;
    coarse->GetTexelDirection(k % width, k / width, &directions[k].x);
    coarse->GetPixel(k % width, k / width, &rgb.x);
    light[k] = coarse->GetTexelSolidAngle(k / width) * glm::dvec4(rgb, 1.0);
  }
  std::vector<float> blurred;
  for (const glm::dvec3& d : directions)
  {
    glm::dvec4 sum(0.0);
    for (std::size_t k = 0; k < light.size(); ++k)
    {
      sum += std::exp(sharpness * (glm::dot(d, directions[k]) - 1.0)) * light[k];
    }
    blurred.insert(
      blurred.end(), { static_cast<float>(sum.x / sum.w), static_cast<float>(sum.y / sum.w),
                       static_cast<float>(sum.z / sum.w) });
  }
  coarse->SetPixels(width, height, std::move(blurred));
  return { coarse, dim };
}

namespace
{
// Pixels per inch at which a font size is a number of pixels.
constexpr int DPI = 72;

//------------------------------------------------------------------------------
vtkTextRenderer* PrepareText(vtkTextProperty* property, int size, bool bold)
{
  property->SetFontFamilyToArial();
  property->SetFontSize(size);
  property->SetBold(bold);
  property->SetColor(1.0, 1.0, 1.0);
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  if (!renderer)
  {
    throw tool::Error("this VTK has no font renderer");
  }
  return renderer;
}
}

//------------------------------------------------------------------------------
int MeasureText(const std::string& text, int size, bool bold)
{
  vtkNew<vtkTextProperty> property;
  int box[4] = { 0, 0, 0, 0 };
  PrepareText(property, size, bold)->GetBoundingBox(property, text, box, DPI);
  return box[1] - box[0] + 1;
}

//------------------------------------------------------------------------------
void DrawText(
  Picture& picture, int x, int y, const std::string& text, int size, bool bold, const RGB& color)
{
  vtkNew<vtkTextProperty> property;
  vtkNew<vtkImageData> image;
  int used[2] = { 0, 0 };
  if (!text.empty() &&
      !PrepareText(property, size, bold)->RenderString(property, text, image, used, DPI))
  {
    throw Error("text can't be drawn: " + TakeErrorText());
  }
  int extent[6];
  image->GetExtent(extent);
  for (int v = 0; v < used[1] && extent[2] + v <= extent[3]; ++v)
  {
    for (int u = 0; u < used[0] && extent[0] + u <= extent[1]; ++u)
    {
      const double alpha =
        image->GetScalarComponentAsDouble(extent[0] + u, extent[2] + v, 0, 3) / 255.0;
      picture.Blend(x + u, y + v, color, alpha);
    }
  }
}

//------------------------------------------------------------------------------
std::string Fit(const std::string& text, int size, bool bold, int width)
{
  if (MeasureText(text, size, bold) <= width)
  {
    return text;
  }
  std::string shorter = text;
  while (!shorter.empty() && MeasureText(shorter + "...", size, bold) > width)
  {
    shorter.pop_back();
  }
  return shorter + "...";
}

//------------------------------------------------------------------------------
std::vector<std::string> Wrap(const std::string& text, int size, int width, int lines)
{
  std::vector<std::string> result(1);
  std::istringstream words(text);
  for (std::string word; words >> word;)
  {
    const std::string longer = result.back().empty() ? word : result.back() + " " + word;
    const bool last = static_cast<int>(result.size()) == lines;
    if (last || result.back().empty() || MeasureText(longer, size, false) <= width)
    {
      result.back() = longer;
    }
    else
    {
      result.push_back(word);
    }
  }
  for (std::string& line : result)
  {
    line = Fit(line, size, false, width);
  }
  return result;
}

namespace
{
// Nine colors of viridis at equal steps (S. van der Walt, N. Smith, CC0): even for the eye, and
// for eyes that tell fewer colors.
constexpr double Viridis[9][3] = { { 0.267, 0.005, 0.329 }, { 0.279, 0.175, 0.483 },
  { 0.230, 0.322, 0.546 }, { 0.173, 0.449, 0.558 }, { 0.128, 0.567, 0.551 },
  { 0.158, 0.684, 0.502 }, { 0.369, 0.789, 0.383 }, { 0.678, 0.864, 0.190 },
  { 0.993, 0.906, 0.144 } };
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkColorTransferFunction> MakeErrorColors()
{
  auto colors = vtkSmartPointer<vtkColorTransferFunction>::New();
  for (int k = 0; k < 9; ++k)
  {
    colors->AddRGBPoint(LowestError + (HighestError - LowestError) * k / 8.0, Viridis[k][0],
      Viridis[k][1], Viridis[k][2]);
  }
  colors->SetBelowRangeColor(0.87, 0.87, 0.87);
  colors->UseBelowRangeColorOn();
  colors->Build();
  return colors;
}
} // namespace tool
