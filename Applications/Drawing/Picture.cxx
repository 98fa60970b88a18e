// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Picture.h"

#include "Files.h"
#include "Tool.h"

#include "vtkEnvironment.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMeasuredBRDFConfigure.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkStdString.h"
#include "vtkTextProperty.h"
#include "vtkTextRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#if MEASUREDBRDF_WITH_OPENEXR
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#endif

namespace tool
{
namespace
{
// Size that a blurred environment is worked out at.
constexpr int BlurWidth = 128;
constexpr int BlurHeight = 64;

//------------------------------------------------------------------------------
// Mean radiance of the environment over blocks of texels (exact solid angles): a smaller map.
std::vector<tool::RGB> Shrink(vtkEnvironment* environment, int width, int height)
{
  std::vector<tool::RGB> sums(static_cast<std::size_t>(width) * height, tool::RGB{});
  std::vector<double> weights(sums.size(), 0.0);
  for (int y = 0; y < environment->GetHeight(); ++y)
  {
    const double solidAngle = environment->GetTexelSolidAngle(y);
    const int row = std::min(height - 1, y * height / environment->GetHeight());
    for (int x = 0; x < environment->GetWidth(); ++x)
    {
      double rgb[3];
      environment->GetPixel(x, y, rgb);
      const std::size_t k =
        static_cast<std::size_t>(row) * width + x * width / environment->GetWidth();
      for (int c = 0; c < 3; ++c)
      {
        sums[k][c] += solidAngle * rgb[c];
      }
      weights[k] += solidAngle;
    }
  }
  for (std::size_t k = 0; k < sums.size(); ++k)
  {
    for (double& value : sums[k])
    {
      value /= weights[k] > 0.0 ? weights[k] : 1.0;
    }
  }
  return sums;
}
}

//------------------------------------------------------------------------------
void Picture::Blend(int x, int y, const RGB& rgb, double alpha)
{
  if (x < 0 || y < 0 || x >= this->Width || y >= this->Height)
  {
    return;
  }
  float* pixel = this->At(x, y);
  for (int c = 0; c < 3; ++c)
  {
    pixel[c] = static_cast<float>(pixel[c] + alpha * (rgb[c] - pixel[c]));
  }
  pixel[3] = static_cast<float>(pixel[3] + alpha * (1.0 - pixel[3]));
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
      double sum[4] = { 0, 0, 0, 0 };
      for (int k = 0; k < factor * factor; ++k)
      {
        const float* pixel = picture.At(x * factor + k % factor, y * factor + k / factor);
        for (int c = 0; c < 4; ++c)
        {
          sum[c] += pixel[c];
        }
      }
      for (int c = 0; c < 4; ++c)
      {
        result.At(x, y)[c] = static_cast<float>(sum[c] / (factor * factor));
      }
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
#if MEASUREDBRDF_WITH_OPENEXR
  // EXR has its first row at the top.
  const std::size_t row = 4 * static_cast<std::size_t>(picture.Width);
  std::vector<float> pixels;
  pixels.reserve(picture.Pixels.size());
  for (int y = picture.Height - 1; y >= 0; --y)
  {
    pixels.insert(pixels.end(), picture.At(0, y), picture.At(0, y) + row);
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
#else
  CheckWritable(path); // says why not
  static_cast<void>(picture);
#endif
}

//------------------------------------------------------------------------------
Backdrop::Backdrop(vtkEnvironment* environment)
  : Width(environment->GetWidth())
  , Height(environment->GetHeight())
  , Pixels(environment->GetPixels())
{
}

//------------------------------------------------------------------------------
Backdrop::Backdrop(vtkEnvironment* environment, double degrees)
  : Width(BlurWidth)
  , Height(BlurHeight)
  , Pixels(3 * BlurWidth * BlurHeight)
{
  const int width = std::min(environment->GetWidth(), 64);
  const int height = std::min(environment->GetHeight(), 32);
  const std::vector<RGB> texels = Shrink(environment, width, height);

  // exp(k (cos a - 1)) falls to a half at the given angle.
  const double k = std::log(2.0) / (1.0 - std::cos(vtkMath::RadiansFromDegrees(degrees)));
  std::vector<double> directions(3 * texels.size());
  std::vector<double> solidAngles(texels.size());
  for (std::size_t t = 0; t < texels.size(); ++t)
  {
    const double x = static_cast<double>(t % width);
    const double y = static_cast<double>(t / width);
    vtkEnvironment::GetDirection((x + 0.5) / width, (y + 0.5) / height, &directions[3 * t]);
    solidAngles[t] = std::cos(vtkMath::Pi() * ((y + 0.5) / height - 0.5));
  }
  for (int p = 0; p < BlurWidth * BlurHeight; ++p)
  {
    double d[3];
    vtkEnvironment::GetDirection(
      (p % BlurWidth + 0.5) / BlurWidth, (p / BlurWidth + 0.5) / BlurHeight, d);
    double sum[4] = { 0, 0, 0, 0 };
    for (std::size_t t = 0; t < texels.size(); ++t)
    {
      const double exponent = k * (vtkMath::Dot(d, &directions[3 * t]) - 1.0);
      if (exponent < -12.0)
      {
        continue;
      }
      const double weight = solidAngles[t] * std::exp(exponent);
      for (int c = 0; c < 3; ++c)
      {
        sum[c] += weight * texels[t][c];
      }
      sum[3] += weight;
    }
    for (int c = 0; c < 3; ++c)
    {
      this->Pixels[3 * p + c] = static_cast<float>(sum[3] > 0.0 ? sum[c] / sum[3] : 0.0);
    }
  }
}

//------------------------------------------------------------------------------
RGB Backdrop::Look(const std::array<double, 3>& direction) const
{
  double u;
  double v;
  vtkEnvironment::GetCoordinates(direction.data(), u, v);
  const double x = u * this->Width - 0.5;
  const double y = std::clamp(v * this->Height - 0.5, 0.0, this->Height - 1.0);
  const int x0 = static_cast<int>(std::floor(x));
  const int y0 = static_cast<int>(y);
  RGB result{};
  for (int corner = 0; corner < 4; ++corner)
  {
    const int dx = corner & 1;
    const int dy = corner >> 1;
    const double weight = (dx ? x - x0 : 1.0 - (x - x0)) * (dy ? y - y0 : 1.0 - (y - y0));
    const int column = ((x0 + dx) % this->Width + this->Width) % this->Width;
    const int row = std::min(y0 + dy, this->Height - 1);
    const float* texel = &this->Pixels[3 * (static_cast<std::size_t>(row) * this->Width + column)];
    for (int c = 0; c < 3; ++c)
    {
      result[c] += weight * texel[c];
    }
  }
  return result;
}

//------------------------------------------------------------------------------
void Backdrop::Scale(double factor)
{
  for (float& value : this->Pixels)
  {
    value = static_cast<float>(value * factor);
  }
}

namespace
{
// Pixels per inch at which a font size is a number of pixels.
constexpr int DPI = 72;

//------------------------------------------------------------------------------
vtkTextRenderer* GetRenderer()
{
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
  property->SetFontFamilyToArial();
  property->SetFontSize(size);
  property->SetBold(bold);
  int box[4] = { 0, 0, 0, 0 };
  GetRenderer()->GetBoundingBox(property, text, box, DPI);
  return box[1] - box[0] + 1;
}

//------------------------------------------------------------------------------
void DrawText(
  Picture& picture, int x, int y, const std::string& text, int size, bool bold, const RGB& color)
{
  if (text.empty())
  {
    return;
  }
  vtkNew<vtkTextProperty> property;
  property->SetFontFamilyToArial();
  property->SetFontSize(size);
  property->SetBold(bold);
  property->SetColor(1.0, 1.0, 1.0);
  vtkNew<vtkImageData> image;
  int size2[2] = { 0, 0 };
  if (!GetRenderer()->RenderString(property, text, image, size2, DPI))
  {
    throw Error("text can't be drawn: " + TakeErrorText());
  }
  int extent[6];
  image->GetExtent(extent);
  for (int v = 0; v < size2[1] && extent[2] + v <= extent[3]; ++v)
  {
    for (int u = 0; u < size2[0] && extent[0] + u <= extent[1]; ++u)
    {
      const auto* texel =
        static_cast<const unsigned char*>(image->GetScalarPointer(extent[0] + u, extent[2] + v, 0));
      picture.Blend(x + u, y + v, color, texel[3] / 255.0);
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
