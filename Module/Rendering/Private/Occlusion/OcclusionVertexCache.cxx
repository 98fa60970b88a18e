// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OcclusionVertexCache.h"

#include "SharedObjects.h"
#include "vtkOpenGLRenderUtilities.h" // VTK's OpenGL, whichever library it loads it with
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <atomic>

namespace measuredbrdf
{
namespace
{
const char* const FragmentShader = "//VTK::System::Dec\n//VTK::Output::Dec\n"
                                   "void main()\n{\n  gl_FragData[0] = vec4(0.0);\n}\n";
constexpr int FloatsOfAttribute = 4;

std::atomic<std::size_t> LeastPoints{ OcclusionVertexCache::DefaultLeastPoints };
std::atomic<std::size_t> MadeCount{ 0 };
std::atomic<std::size_t> AddedCount{ 0 };

// Mappers share programs, and a program knows one such object: it would be linked anew for another.
using Captures = SharedObjects<std::string, vtkTransformFeedback>;

vtkSmartPointer<vtkTransformFeedback> FindCapture(const std::vector<std::string>& names)
{
  std::string all;
  for (const std::string& name : names)
  {
    all += name + " ";
  }
  return Captures::Get().Find(all,
    [&names]()
    {
      auto capture = vtkSmartPointer<vtkTransformFeedback>::New();
      for (const std::string& name : names)
      {
        capture->AddVarying(vtkTransformFeedback::Color_RGBA_F, name); // the role says nothing here
      }
      return capture;
    });
}
}

std::size_t OcclusionVertexCache::GetLeastPoints() { return LeastPoints; }

void OcclusionVertexCache::SetLeastPoints(std::size_t points) { LeastPoints = points; }

std::size_t OcclusionVertexCache::GetMadeCount() { return MadeCount; }

std::size_t OcclusionVertexCache::GetAddedCount() { return AddedCount; }

bool OcclusionVertexCache::Find(
  const OcclusionLights& lights, const OcclusionLayout& layout, const Question& question)
{
  const std::string key = GetOcclusionKey(lights, layout);
  const auto found = std::find_if(this->States.begin(), this->States.end(),
    [&](const std::unique_ptr<State>& state)
    {
      return state->Key == key && state->Of.Time == question.Time &&
             state->Of.Inputs == question.Inputs;
    });
  this->Current = found == this->States.end() ? nullptr : found->get();
  if (this->Current)
  {
    this->Current->Used = ++this->Clock;
  }
  return this->Current != nullptr;
}

vtkShaderProgram* OcclusionVertexCache::Begin(vtkOpenGLRenderWindow* window,
  vtkOpenGLVertexBufferObjectGroup* buffers, const OcclusionLights& lights,
  const OcclusionLayout& layout)
{
  this->Window = window;
  this->Owner = window;
  vtkOpenGLShaderCache* cache = window->GetShaderCache();
  const std::string key = GetOcclusionKey(lights, layout);
  vtkShaderProgram* program = nullptr;
  if (this->Helper.Program && key == this->Key)
  {
    program = cache->ReadyShaderProgram(this->Helper.Program, this->Capture);
  }
  else
  {
    this->Names = GetKeptNames(lights, layout);
    this->Capture = FindCapture(this->Names);
    program = cache->ReadyShaderProgram(
      MakeKeptShader(lights, layout).c_str(), FragmentShader, "", this->Capture);
  }
  this->Key = key;
  if (program != this->Helper.Program)
  {
    this->Helper.VAO->ReleaseGraphicsResources();
    this->Helper.Program = program;
  }
  this->CanMake = program != nullptr;
  if (program)
  {
    this->Helper.VAO->Bind();
    buffers->AddAllAttributesToVAO(program, this->Helper.VAO);
  }
  return program;
}

// Of the same view first: a light that moves takes no other's place.
OcclusionVertexCache::State& OcclusionVertexCache::FindPlace(const Question& question)
{
  const auto isOwn = [&](const std::unique_ptr<State>& state)
  {
    return state->Key == this->Key && state->Of.View == question.View &&
           state->Of.Actor == question.Actor;
  };
  auto place = std::find_if(this->States.begin(), this->States.end(), isOwn);
  if (place == this->States.end() && this->States.size() < MostStates)
  {
    this->States.push_back(std::make_unique<State>());
    return *this->States.back();
  }
  if (place == this->States.end())
  {
    place = std::min_element(this->States.begin(), this->States.end(),
      [](const auto& a, const auto& b) { return a->Used < b->Used; });
  }
  return **place;
}

void OcclusionVertexCache::Make(std::size_t points, const Question& question)
{
  // Of codes that are drawn no more.
  this->States.erase(std::remove_if(this->States.begin(), this->States.end(),
                       [&](const auto& state) { return state->Of.Time != question.Time; }),
    this->States.end());
  State& state = this->FindPlace(question);
  state.Key = this->Key;
  state.Of = question;
  state.Names = this->Names;
  state.Used = ++this->Clock;
  if (!state.Buffer)
  {
    state.Buffer = vtkSmartPointer<vtkOpenGLBufferObject>::New();
    state.Buffer->GenerateBuffer(vtkOpenGLBufferObject::ArrayBuffer);
    state.Bytes = 0;
  }
  const std::size_t bytes = points * this->Names.size() * FloatsOfAttribute * sizeof(float);
  if (bytes != state.Bytes)
  {
    state.Buffer->Bind();
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_COPY);
    state.Buffer->Release();
    state.Bytes = bytes;
  }
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, static_cast<GLuint>(state.Buffer->GetHandle()));
  glBeginTransformFeedback(GL_POINTS);
  // One instance: unlike glDrawArrays, VTK loads it, and programs need not link to OpenGL.
  glDrawArraysInstanced(GL_POINTS, 0, static_cast<GLsizei>(points), 1);
  glEndTransformFeedback();
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
  this->Helper.VAO->Release();
  this->Current = &state;
  ++MadeCount;
}

void OcclusionVertexCache::AddTo(vtkOpenGLHelper& drawn) const
{
  if (!this->Current)
  {
    return;
  }
  drawn.VAO->Bind();
  const std::size_t bytes = FloatsOfAttribute * sizeof(float);
  const std::vector<std::string>& names = this->Current->Names;
  for (std::size_t k = 0; k < names.size(); ++k)
  {
    // A program for depths alone, of peeling, reads none.
    if (drawn.Program->IsAttributeUsed(names[k].c_str()))
    {
      drawn.VAO->AddAttributeArray(drawn.Program, this->Current->Buffer, names[k],
        static_cast<int>(k * bytes), names.size() * bytes, VTK_FLOAT, FloatsOfAttribute, false);
      ++AddedCount;
    }
  }
}

void OcclusionVertexCache::Drop()
{
  this->Current = nullptr;
  this->States.clear(); // buffers delete themselves
}

void OcclusionVertexCache::Release(vtkWindow* window)
{
  vtkOpenGLRenderWindow* own = this->Window;
  if (!own && window && window == this->Owner)
  {
    own = vtkOpenGLRenderWindow::SafeDownCast(window);
  }
  if (own)
  {
    own->PushContext();
    this->Helper.ReleaseGraphicsResources(own);
    for (const std::unique_ptr<State>& state : this->States)
    {
      state->Buffer->ReleaseGraphicsResources();
    }
    own->PopContext();
  }
  this->Window = nullptr;
  this->Owner = nullptr;
  this->CanMake = true;
  this->Key.clear();
  this->States.clear();
  this->Current = nullptr;
  this->Capture = nullptr;
}

void SweepCaptures() { Captures::Get().Sweep(); }
} // namespace measuredbrdf
