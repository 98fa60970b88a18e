// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Progress.h"

#include "Tool.h"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <iostream>

namespace
{
volatile std::sig_atomic_t Interrupted = 0;
void (*Previous)(int) = SIG_DFL;
}

extern "C" void MeasuredBRDFToolInterrupt(int) { Interrupted = 1; }

namespace tool
{
//------------------------------------------------------------------------------
Interruptible::Interruptible()
{
  Interrupted = 0;
  Previous = std::signal(SIGINT, MeasuredBRDFToolInterrupt);
}

//------------------------------------------------------------------------------
Interruptible::~Interruptible() { std::signal(SIGINT, Previous); }

//------------------------------------------------------------------------------
bool Interruptible::IsInterrupted() { return Interrupted != 0; }

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
  : Label(std::move(label))
  , Terminal(isatty(STDERR_FILENO) != 0)
{
  this->Update(0.0);
}

//------------------------------------------------------------------------------
ProgressBar::~ProgressBar()
{
  if (this->Terminal)
  {
    std::cerr << "\r\033[K" << std::flush;
  }
}

//------------------------------------------------------------------------------
void ProgressBar::Update(double share)
{
  const int percent = static_cast<int>(100.0 * std::clamp(share, 0.0, 1.0));
  if (!this->Terminal || percent == this->Shown)
  {
    return;
  }
  this->Shown = percent;
  const int filled = percent * 40 / 100;
  std::cerr << "\r" << this->Label << " [" << std::string(filled, '#')
            << std::string(40 - filled, ' ') << "] " << percent << " %" << std::flush;
}
} // namespace tool
