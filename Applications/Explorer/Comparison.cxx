// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Comparison.h"

#include "BackgroundWork.h"

#include <algorithm>

namespace explorer
{
//------------------------------------------------------------------------------
Comparison::Comparison(Session* session, Jobs* jobs, QObject* parent)
  : QObject(parent)
  , Model(session)
  , Background(jobs)
{
  connect(session, &Session::comparedChanged, this, &Comparison::Update);
}

//------------------------------------------------------------------------------
void Comparison::SetCompared(const std::string& file, bool isCompared)
{
  std::vector<std::string> files = this->Model->GetState().Compared;
  files.erase(std::remove(files.begin(), files.end(), file), files.end());
  if (isCompared)
  {
    if (files.size() >= MostCompared)
    {
      this->Model->Say(tr("At most %1 materials are compared with the one that is shown")
                         .arg(static_cast<int>(MostCompared)),
        true);
    }
    else
    {
      files.push_back(file);
    }
  }
  this->Model->SetCompared(files);
}

//------------------------------------------------------------------------------
bool Comparison::IsCompared(const std::string& file) const
{
  const std::vector<std::string>& files = this->Model->GetState().Compared;
  return std::find(files.begin(), files.end(), file) != files.end();
}

//------------------------------------------------------------------------------
// One job reads what is missing, one after the other: they may be large.
void Comparison::Update()
{
  std::vector<ComparedMaterial> kept;
  std::vector<std::string> missing;
  for (const std::string& file : this->Model->GetState().Compared)
  {
    const auto found = std::find_if(this->Materials.begin(), this->Materials.end(),
      [&](const ComparedMaterial& material) { return material.File == file; });
    if (found == this->Materials.end())
    {
      missing.push_back(file);
    }
    else
    {
      kept.push_back(*found);
    }
  }
  this->Materials = kept;
  emit this->changed();
  if (missing.empty())
  {
    this->Background->Stop("compare");
    return;
  }
  this->Background->Start(
    "compare", tr("reading for comparison"),
    [this, missing](JobThread& thread)
    {
      for (const std::string& file : missing)
      {
        if (!tool::BackgroundWork::Get()->IsStopped())
        {
          this->Read(file, thread);
        }
      }
    },
    [this](const QString& text) { this->Model->Say(text, true); });
}

//------------------------------------------------------------------------------
// On a thread.
void Comparison::Read(const std::string& file, JobThread& thread)
{
  try
  {
    const tool::Material read = tool::LoadMaterial(file);
    read.BRDF->Prepare();
    const ComparedMaterial material{ file, read.Name, read.BRDF, SampleAlbedo(read.BRDF) };
    thread.Post([this, material]() { this->Take(material); });
  }
  catch (const std::exception& error)
  {
    const QString text = QString::fromUtf8(error.what());
    thread.Post(
      [this, file, text]()
      {
        this->Model->Say(text, true);
        this->SetCompared(file, false);
      });
  }
}

//------------------------------------------------------------------------------
void Comparison::Take(const ComparedMaterial& material)
{
  this->Materials.push_back(material);
  const std::vector<std::string>& files = this->Model->GetState().Compared;
  const auto place = [&](const ComparedMaterial& one)
  { return std::find(files.begin(), files.end(), one.File) - files.begin(); };
  std::stable_sort(this->Materials.begin(), this->Materials.end(),
    [&](const ComparedMaterial& a, const ComparedMaterial& b) { return place(a) < place(b); });
  emit this->changed();
}
} // namespace explorer
