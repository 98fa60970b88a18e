// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FilterPrecision.h"

#include "vtkNew.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPixelBufferObject.h"
#include "vtkShaderProgram.h"
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace measuredbrdf
{
namespace
{
constexpr int Side = 64;     // pixels, each of two places between the texels, as in the shader
constexpr int MostBits = 11; // that so many places tell from exact weights

const char Shader[] = R"(//VTK::System::Dec
//VTK::Output::Dec
in vec2 texCoord;
uniform sampler2D edge;
void main()
{
  vec2 pixel = floor(gl_FragCoord.xy);
  float first = 2.0 * (pixel.x + 64.0 * pixel.y);
  vec2 between = vec2(first, first + 1.0) / 8191.0;
  gl_FragData[0] = vec4(texture(edge, vec2(0.25 + 0.5 * between.x, 0.5)).r,
    texture(edge, vec2(0.25 + 0.5 * between.y, 0.5)).r, texCoord.x, 1.0);
}
)";

std::vector<float> Download(vtkTextureObject* texture)
{
  std::vector<float> values(static_cast<std::size_t>(Side) * Side * 4);
  unsigned int size[] = { Side, Side };
  vtkIdType increments[] = { 0, 0 };
  const auto buffer = vtkSmartPointer<vtkPixelBufferObject>::Take(texture->Download());
  if (!buffer || !buffer->Download2D(VTK_FLOAT, values.data(), size, 4, increments))
  {
    return {};
  }
  return values;
}

// What an edge from 0 to 1 looks like at all places, in red and green; blue uses what VTK binds,
// and alpha is 1, whatever the blending. Empty where nothing can be drawn.
std::vector<float> DrawEdge(vtkOpenGLRenderWindow* window)
{
  float texels[] = { 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f, 1.0f, 1.0f };
  vtkNew<vtkTextureObject> edge;
  vtkNew<vtkTextureObject> target;
  for (vtkTextureObject* texture : { edge.Get(), target.Get() })
  {
    texture->SetContext(window);
    texture->SetWrapS(vtkTextureObject::ClampToEdge);
    texture->SetWrapT(vtkTextureObject::ClampToEdge);
  }
  edge->SetMinificationFilter(vtkTextureObject::Linear);
  edge->SetMagnificationFilter(vtkTextureObject::Linear);
  vtkNew<vtkOpenGLFramebufferObject> framebuffer;
  framebuffer->SetContext(window);
  if (!edge->Create2DFromRaw(2, 1, 4, VTK_FLOAT, texels) ||
      !target->Create2D(Side, Side, 4, VTK_FLOAT, false))
  {
    return {};
  }
  std::vector<float> values;
  framebuffer->GetContext()->GetState()->PushFramebufferBindings();
  framebuffer->Bind();
  framebuffer->AddColorAttachment(0, target);
  framebuffer->ActivateDrawBuffer(0);
  if (framebuffer->StartNonOrtho(Side, Side))
  {
    vtkOpenGLQuadHelper quad(window, nullptr, Shader, nullptr);
    if (quad.Program && quad.Program->GetCompiled())
    {
      edge->Activate();
      quad.Program->SetUniformi("edge", edge->GetTextureUnit());
      quad.Render();
      edge->Deactivate();
      values = Download(target);
    }
    quad.ReleaseGraphicsResources(window);
  }
  framebuffer->GetContext()->GetState()->PopFramebufferBindings();
  framebuffer->ReleaseGraphicsResources(window);
  edge->ReleaseGraphicsResources(window);
  target->ReleaseGraphicsResources(window);
  return values;
}
}

int MeasureFilterWeightBits(vtkRenderWindow* window)
{
  auto* gl = vtkOpenGLRenderWindow::SafeDownCast(window);
  if (!gl)
  {
    return -1;
  }
  gl->MakeCurrent();
  const std::vector<float> rgba = DrawEdge(gl);
  std::vector<float> levels;
  for (std::size_t k = 0; k < rgba.size(); k += 4)
  {
    levels.insert(levels.end(), { rgba[k], rgba[k + 1] });
  }
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  if (levels.size() < 3 || // one that does not interpolate
      levels.front() != 0.0f || levels.back() != 1.0f)
  {
    return -1;
  }
  const int bits = static_cast<int>(std::lround(std::log2(static_cast<double>(levels.size() - 1))));
  return bits <= MostBits ? bits : 0;
}
} // namespace measuredbrdf
