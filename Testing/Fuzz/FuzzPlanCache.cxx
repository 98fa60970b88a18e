// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
// A file of the plan cache, as another program may leave it. The first byte says what the rest is:
// the file, magic and all; its contents, behind a right checksum; or a table's bytes among them.
#include "FuzzTarget.h"

#include "PlanCache.h"
#include "vtkDoubleArray.h"
#include "vtkEnvironment.h"
#include "vtkLambertBRDF.h"
#include "vtkNew.h"
#include "vtkRadiancePlanner.h"
#include "vtkSmartPointer.h"
#include "vtkTableRadianceIntegrator.h"

#include <vector>

namespace
{
// A material, an environment and the key of their plan, which is made once.
class Cache
{
public:
  Cache()
  {
    Require(this->Environment->SetPixels(8, 4, std::vector<float>(8 * 4 * 3, 0.5f)));
    const auto planner = this->NewPlanner();
    Require(planner->Update());
    for (const auto& entry : std::filesystem::directory_iterator(this->GetPath()))
    {
      this->Key = entry.path().filename().string();
    }
    Require(!this->Key.empty());
  }

  vtkSmartPointer<vtkRadiancePlanner> NewPlanner() const
  {
    auto planner = vtkSmartPointer<vtkRadiancePlanner>::New();
    planner->SetBRDF(this->BRDF);
    planner->SetEnvironment(this->Environment);
    planner->SetCacheFolder(this->Folder.GetPath());
    return planner;
  }

  void WriteFile(std::string_view bytes) const
  {
    this->Folder.Write(measuredbrdf::CacheSubfolder + ("/" + this->Key), bytes);
  }

  void WriteContents(std::string_view bytes) const
  {
    std::filesystem::remove(this->GetPath() + "/" + this->Key); // may be none of ours
    measuredbrdf::WriteCache(this->Folder.GetPath(), this->Key, std::string(bytes), 1 << 24);
  }

  vtkLambertBRDF* GetBRDF() const { return this->BRDF; }
  vtkEnvironment* GetEnvironment() const { return this->Environment; }

private:
  static void Require(bool promise) { fuzz::Require(promise); }
  std::string GetPath() const
  {
    return this->Folder.GetPath() + "/" + measuredbrdf::CacheSubfolder;
  }

  fuzz::ScratchFolder Folder;
  std::string Key;
  vtkNew<vtkLambertBRDF> BRDF;
  vtkNew<vtkEnvironment> Environment;
};

void TakeTable(const Cache& cache, std::string_view bytes)
{
  vtkNew<vtkTableRadianceIntegrator> table;
  table->SetNumberOfRows(9);
  table->SetNumberOfViewAngles(2);
  table->SetNumberOfAzimuths(4);
  table->SetBRDF(cache.GetBRDF());
  table->SetEnvironment(cache.GetEnvironment());
  if (table->TakePrepared(std::string(bytes)))
  {
    const double up[3] = { 0.0, 0.0, 1.0 };
    const double view[3] = { 0.6, 0.0, 0.8 };
    vtkNew<vtkDoubleArray> normals;
    vtkNew<vtkDoubleArray> views;
    vtkNew<vtkDoubleArray> radiance;
    normals->SetNumberOfComponents(3);
    views->SetNumberOfComponents(3);
    normals->InsertNextTuple(up);
    views->InsertNextTuple(view);
    table->Integrate(normals, views, radiance);
  }
}
}

MEASUREDBRDF_FUZZ_TARGET(PlanCache)(const std::uint8_t* data, std::size_t size)
{
  static const Cache cache;
  const fuzz::Silence silence;
  const std::string_view bytes = fuzz::ToView(data, size).substr(size > 0);
  const int kind = size > 0 ? data[0] % 4 : 0;
  if (kind == 3)
  {
    TakeTable(cache, bytes);
    return 0;
  }
  if (kind == 0)
  {
    cache.WriteFile(bytes);
  }
  else
  {
    cache.WriteContents(bytes);
  }
  // Hybrid plans make their other layers anew, which takes long.
  if (kind != 0 && bytes.find("\n4 ") != bytes.npos && !fuzz::IsRare(data, size))
  {
    return 0;
  }
  const auto planner = cache.NewPlanner();
  planner->SetAbort(true); // no search where the file is refused
  if (planner->Update())
  {
    fuzz::Require(planner->GetFromCache());
    planner->GetPlan();
    for (int k = 0; k < planner->GetNumberOfCandidates(); ++k)
    {
      planner->GetDescription(k);
    }
    vtkSmartPointer<vtkRadianceIntegrator>::Take(planner->NewIntegrator());
  }
  return 0;
}
