// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Thesis.h"

#include "Bases.h"
#include "RunWithProgress.h"
#include "Tool.h"

#include "vtkBasisBRDF.h"
#include "vtkNew.h"
#include "vtkRepresentationAdvisor.h"

#include <CLI/CLI.hpp>

namespace tool
{
//------------------------------------------------------------------------------
void ThesisOptions::AddTo(CLI::App* command)
{
  command
    ->add_option("--order", this->Order,
      "Order of the basis of --method thesis (default " + std::to_string(this->Order) +
        ": 49 functions)")
    ->check(CLI::Range(1, static_cast<int>(vtkBasisBRDF::MaximumOrder)));
}

//------------------------------------------------------------------------------
void ThesisOptions::Check(const CLI::App* command, const std::string& method) const
{
  if (command->count("--order") > 0 && method != "thesis")
  {
    throw UsageError("--order: has no effect without --method thesis");
  }
}

//------------------------------------------------------------------------------
Representation Represent(const Material& material, int order)
{
  vtkNew<vtkRepresentationAdvisor> advisor;
  advisor->SetInput(material.BRDF);
  advisor->SetOrder(order);
  if (!RunWithProgress(advisor.Get(), &vtkRepresentationAdvisor::Represent, "representing"))
  {
    throw Error(material.File + ": " + TakeErrorText());
  }
  const bool basis = advisor->GetRecommendation() == vtkRepresentationAdvisor::BASIS;
  return { advisor->GetOutput(), basis ? "basis" : "fit", DescribeForm(advisor->GetOutput()),
    advisor->GetReason() };
}

//------------------------------------------------------------------------------
Representation RepresentAsThesis(const Material& material, const ThesisOptions& options)
{
  Representation made = Represent(material, options.Order);
  PrintNote(material.Name + ": " + made.Reason);
  return made;
}
} // namespace tool
