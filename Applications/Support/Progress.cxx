// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Progress.h"

#include "Tool.h"

#include "vtkBRDFReader.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <iostream>
#include <unistd.h>
#include <utility>

namespace tool
{
namespace
{
thread_local tool::BackgroundWork* Current = nullptr;
}

//------------------------------------------------------------------------------
BackgroundWork::BackgroundWork(
  const std::atomic<bool>& stop, std::function<void(const std::string&, double)> show)
  : Show(std::move(show))
  , Stopped(stop)
  , Outer(Current)
{
  Current = this;
}

//------------------------------------------------------------------------------
BackgroundWork::~BackgroundWork() { Current = this->Outer; }

//------------------------------------------------------------------------------
BackgroundWork* BackgroundWork::Get() { return Current; }

namespace
{
volatile std::sig_atomic_t Interrupted = 0;
void (*Previous)(int) = SIG_DFL;
int Bars = 0;
constexpr double LeastElapsed = 5.0; // seconds before the time left is told

extern "C" void MeasuredBRDFToolInterrupt(int) { Interrupted = 1; }
}

//------------------------------------------------------------------------------
Interruptible::Interruptible()
{
  Interrupted = 0;
  Previous = std::signal(SIGINT, MeasuredBRDFToolInterrupt);
}

//------------------------------------------------------------------------------
Interruptible::~Interruptible() { std::signal(SIGINT, Previous); }

//------------------------------------------------------------------------------
bool Interruptible::IsInterrupted()
{
  const BackgroundWork* work = BackgroundWork::Get();
  return work ? work->IsStopped() : Interrupted != 0;
}

//------------------------------------------------------------------------------
void Interruptible::Check()
{
  if (IsInterrupted())
  {
    throw Error("interrupted; nothing was written");
  }
}

//------------------------------------------------------------------------------
ProgressBar::ProgressBar(std::string label)
  : Label(vtkBRDFReader::GetPrintable(label))
  , Work(BackgroundWork::Get())
  , Terminal(!Work && Bars++ == 0 && isatty(STDERR_FILENO) != 0)
  , Begin(std::chrono::steady_clock::now())
{
  this->Update(0.0);
}

//------------------------------------------------------------------------------
ProgressBar::~ProgressBar()
{
  Bars -= this->Work ? 0 : 1;
  if (this->Terminal)
  {
    std::cerr << "\r\033[K" << std::flush;
  }
}

//------------------------------------------------------------------------------
std::string ProgressBar::GetTimeLeft(double share) const
{
  const double elapsed =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Begin).count();
  if (elapsed < LeastElapsed || share <= 0.0)
  {
    return "";
  }
  const double left = elapsed * (1.0 - share) / share;
  return left < 90.0 ? ", " + std::to_string(std::lround(left)) + " s left"
                     : ", " + std::to_string(std::lround(left / 60.0)) + " min left";
}

//------------------------------------------------------------------------------
void ProgressBar::Update(double share)
{
  const int percent = static_cast<int>(100.0 * std::clamp(share, 0.0, 1.0));
  if (this->Work)
  {
    this->Work->Show(this->Label, share);
    return;
  }
  if (!this->Terminal || percent == this->Shown)
  {
    return;
  }
  this->Shown = percent;
  const int filled = percent * 40 / 100;
  std::cerr << "\r" << this->Label << " [" << std::string(filled, '#')
            << std::string(40 - filled, ' ') << "] " << percent << " %" << this->GetTimeLeft(share)
            << "\033[K" << std::flush;
}
} // namespace tool
