// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Thesis.h"

#include "Progress.h"
#include "Tool.h"

#include "vtkBasisBRDF.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkRepresentationAdvisor.h"

namespace
{
// Shows the advisor's progress and passes Ctrl-C on to it.
struct Watcher
{
  vtkRepresentationAdvisor* Advisor;
  tool::ProgressBar Bar{ "representing" };

  void OnProgress(vtkObject*, unsigned long, void* data)
  {
    this->Bar.Update(*static_cast<double*>(data));
    if (tool::Interruptible::IsInterrupted())
    {
      this->Advisor->SetAbort(true);
    }
  }
};
}

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
vtkSmartPointer<vtkBRDF> RepresentAsThesis(
  vtkBRDF* material, const std::string& name, const ThesisOptions& options)
{
  vtkNew<vtkRepresentationAdvisor> advisor;
  advisor->SetInput(material);
  advisor->SetOrder(options.Order);
  bool done = false;
  {
    Watcher watcher{ advisor };
    advisor->AddObserver(vtkCommand::ProgressEvent, &watcher, &Watcher::OnProgress);
    done = advisor->Represent();
    advisor->RemoveObservers(vtkCommand::ProgressEvent);
  }
  Interruptible::Check();
  if (!done)
  {
    throw Error(name + ": " + TakeErrorText());
  }
  PrintNote(name + ": " + advisor->GetReason());
  return advisor->GetOutput();
}
} // namespace tool
