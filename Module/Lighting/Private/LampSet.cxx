// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LampSet.h"

#include "vtkObjectFactory.h"

namespace measuredbrdf
{
vtkStandardNewMacro(LampSet);
}
