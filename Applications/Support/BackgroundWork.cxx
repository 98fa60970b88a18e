// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BackgroundWork.h"

#include <utility>

namespace
{
thread_local tool::BackgroundWork* Current = nullptr;
}

namespace tool
{
//------------------------------------------------------------------------------
BackgroundWork::BackgroundWork(
  const std::atomic<bool>& stop, std::function<void(const std::string&, double)> show)
  : ShowProgress(std::move(show))
  , Stopped(stop)
  , Outer(Current)
{
  Current = this;
}

//------------------------------------------------------------------------------
BackgroundWork::~BackgroundWork() { Current = this->Outer; }

//------------------------------------------------------------------------------
BackgroundWork* BackgroundWork::Get() { return Current; }
} // namespace tool
