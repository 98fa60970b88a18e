// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What holds for a part of a mapper's render, whatever way that ends. Private to the rendering
 * room.
 */

#ifndef RenderScopes_h
#define RenderScopes_h

namespace measuredbrdf
{
// The superclass declares normals and positions for lit primitives only; an environment lights
// scenes without a single vtkLight. Works on int (VTK < 9.4) and on the enum that followed.
template <typename Complexity>
class ForceLit
{
public:
  ForceLit(Complexity& complexity, bool force)
    : Target(complexity)
    , Saved(complexity)
  {
    if (force && static_cast<int>(complexity) == 0)
    {
      complexity = static_cast<Complexity>(1);
    }
  }
  ~ForceLit() { this->Target = this->Saved; }
  ForceLit(const ForceLit&) = delete;
  void operator=(const ForceLit&) = delete;

private:
  Complexity& Target;
  Complexity Saved;
};

// Counts calls that are not over yet, whatever way they end.
class Depth
{
public:
  explicit Depth(int& depth)
    : Count(depth)
  {
    ++this->Count;
  }
  ~Depth() { --this->Count; }
  Depth(const Depth&) = delete;
  void operator=(const Depth&) = delete;

private:
  int& Count;
};
} // namespace measuredbrdf

#endif
