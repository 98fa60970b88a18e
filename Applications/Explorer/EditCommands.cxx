// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "EditCommands.h"

#include <filesystem>

namespace
{
//------------------------------------------------------------------------------
QString GetTitle(const std::string& file)
{
  return QString::fromStdString(std::filesystem::path(file).filename().string());
}
}

namespace explorer
{
//------------------------------------------------------------------------------
SampleEdits GetEdits(const State& state, const std::string& file)
{
  const auto found = state.Edits.find(file);
  return found == state.Edits.end() ? SampleEdits() : found->second;
}

//------------------------------------------------------------------------------
EditSample::EditSample(
  Session* session, const std::string& file, int row, const std::array<float, 3>& rgb)
  : QUndoCommand(QObject::tr("row %1 of %2").arg(row + 1).arg(GetTitle(file)))
  , Model(session)
  , File(file)
  , Row(row)
  , After(rgb)
{
  const SampleEdits edits = GetEdits(session->GetState(), file);
  const auto found = edits.find(row);
  if (found != edits.end())
  {
    this->Before = found->second;
  }
}

//------------------------------------------------------------------------------
void EditSample::Set(const std::optional<std::array<float, 3>>& rgb)
{
  SampleEdits edits = GetEdits(this->Model->GetState(), this->File);
  if (rgb)
  {
    edits[this->Row] = *rgb;
  }
  else
  {
    edits.erase(this->Row);
  }
  this->Model->SetEdits(this->File, edits);
}

//------------------------------------------------------------------------------
SetEdits::SetEdits(Session* session, const std::string& file, const SampleEdits& edits)
  : QUndoCommand(QObject::tr("all edits of %1").arg(GetTitle(file)))
  , Model(session)
  , File(file)
  , Before(GetEdits(session->GetState(), file))
  , After(edits)
{
}
} // namespace explorer
