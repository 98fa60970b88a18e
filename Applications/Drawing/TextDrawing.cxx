// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TextDrawing.h"

#include "Tool.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkStdString.h"
#include "vtkTextProperty.h"
#include "vtkTextRenderer.h"

#include <algorithm>
#include <sstream>

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

namespace tool
{
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
} // namespace tool
