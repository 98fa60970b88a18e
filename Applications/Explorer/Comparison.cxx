// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Comparison.h"

#include "Materials.h"
#include "Progress.h"

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
  connect(session, &Session::settingsSettled, this,
    [this]()
    {
      const ModelStates& models = this->Model->GetState().Models;
      if (std::any_of(this->Materials.begin(), this->Materials.end(),
            [&](const ComparedMaterial& one)
            { return one.Values != FindValues(one.File, models); }))
      {
        this->Update();
      }
    });
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
  const ModelStates models = this->Model->GetState().Models;
  std::vector<ComparedMaterial> kept;
  std::vector<std::string> missing;
  for (const std::string& file : this->Model->GetState().Compared)
  {
    const auto found = std::find_if(this->Materials.begin(), this->Materials.end(),
      [&](const ComparedMaterial& material) { return material.File == file; });
    if (found != this->Materials.end())
    {
      kept.push_back(*found); // of a model until it is made with its new parameters
    }
    if (found == this->Materials.end() || found->Values != FindValues(file, models))
    {
      missing.push_back(file);
    }
  }
  this->Materials = kept;
  emit this->changed();
  if (missing.empty())
  {
    this->Background->Stop("compare");
    return;
  }
  this->Background->Start("compare", tr("reading for comparison"),
    [this, missing, models](const Jobs::Post& post)
    {
      for (const std::string& file : missing)
      {
        if (!tool::BackgroundWork::Get()->IsStopped())
        {
          this->Read(file, models, post);
        }
      }
    });
}

//------------------------------------------------------------------------------
// On a thread.
void Comparison::Read(const std::string& file, const ModelStates& models, const Jobs::Post& post)
{
  try
  {
    const tool::Material read = LoadMaterial(file, models);
    read.BRDF->Prepare();
    if (read.Transmission)
    {
      read.Transmission->Prepare();
    }
    const ComparedMaterial material{ file, read.Name, read.BRDF, SampleAlbedo(read.BRDF),
      FindValues(file, models), read.Transmission,
      read.Transmission ? SampleTransmittance(read.Transmission) : Curve() };
    post([this, material]() { this->Take(material); });
  }
  catch (const std::exception& error)
  {
    const QString text = QString::fromUtf8(error.what());
    post(
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
  const auto before = std::find_if(this->Materials.begin(), this->Materials.end(),
    [&](const ComparedMaterial& one) { return one.File == material.File; });
  if (before != this->Materials.end())
  {
    this->Materials.erase(before);
  }
  this->Materials.push_back(material);
  const std::vector<std::string>& files = this->Model->GetState().Compared;
  const auto place = [&](const ComparedMaterial& one)
  { return std::find(files.begin(), files.end(), one.File) - files.begin(); };
  std::stable_sort(this->Materials.begin(), this->Materials.end(),
    [&](const ComparedMaterial& a, const ComparedMaterial& b) { return place(a) < place(b); });
  emit this->changed();
  if (material.Values != FindValues(material.File, this->Model->GetState().Models))
  {
    this->Update(); // they have changed since this was begun
  }
}
} // namespace explorer
