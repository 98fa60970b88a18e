// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Edits of samples that can be undone.
 */

#ifndef EditCommands_h
#define EditCommands_h

#include "Session.h"

#include <QUndoCommand>

#include <optional>
#include <string>

namespace explorer
{
/// What a state has of a material's samples.
SampleEdits GetEdits(const State& state, const std::string& file);

/// Sets one sample of a material.
class EditSample : public QUndoCommand
{
public:
  EditSample(Session* session, const std::string& file, int row, const std::array<float, 3>& rgb);

  void redo() override { this->Set(this->After); }
  void undo() override { this->Set(this->Before); }

private:
  void Set(const std::optional<std::array<float, 3>>& rgb);

  Session* Model;
  std::string File;
  int Row;
  std::optional<std::array<float, 3>> Before; // nothing: as the material has it
  std::optional<std::array<float, 3>> After;
};

/// Sets all of them.
class SetEdits : public QUndoCommand
{
public:
  SetEdits(Session* session, const std::string& file, const SampleEdits& edits);

  void redo() override { this->Model->SetEdits(this->File, this->After); }
  void undo() override { this->Model->SetEdits(this->File, this->Before); }

private:
  Session* Model;
  std::string File;
  SampleEdits Before;
  SampleEdits After;
};
} // namespace explorer

#endif
