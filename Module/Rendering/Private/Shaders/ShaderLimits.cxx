// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ShaderLimits.h"

#include "vtkOpenGLRenderUtilities.h" // VTK's OpenGL, whichever library it loads it with
#include "vtkOpenGLState.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace measuredbrdf
{
namespace
{
constexpr std::size_t Unlimited = std::numeric_limits<std::size_t>::max();
std::atomic<std::size_t> LargestAttributes{ Unlimited };
std::atomic<std::size_t> LargestVaryings{ Unlimited };

void ReadLimit(vtkOpenGLState* state, unsigned int name, std::size_t& limit)
{
  int value = 0;
  state->vtkglGetIntegerv(name, &value);
  limit = value > 0 ? static_cast<std::size_t>(value) : limit;
}
}

ShaderLimits ShaderLimits::Read(vtkOpenGLState* state)
{
  ShaderLimits limits;
  ReadLimit(state, GL_MAX_VERTEX_ATTRIBS, limits.Attributes);
  ReadLimit(state, GL_MAX_VARYING_COMPONENTS, limits.Varyings);
  limits.Attributes = std::min<std::size_t>(limits.Attributes, LargestAttributes);
  limits.Varyings = std::min<std::size_t>(limits.Varyings, LargestVaryings);
  return limits;
}

void ShaderLimits::SetMost(std::size_t attributes, std::size_t varyings)
{
  LargestAttributes = attributes > 0 ? attributes : Unlimited;
  LargestVaryings = varyings > 0 ? varyings : Unlimited;
}
} // namespace measuredbrdf
