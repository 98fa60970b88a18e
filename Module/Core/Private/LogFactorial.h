// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A thread-safe log n!. (In some C libraries std::lgamma also writes the sign of the gamma function
 * to a global variable.)
 */

#ifndef LogFactorial_h
#define LogFactorial_h

#include <cmath>
#include <math.h> // for lgamma_r, which is POSIX's

namespace measuredbrdf
{
inline double LogFactorial(int n)
{
#ifdef _WIN32
  return std::lgamma(n + 1.0); // has no such variable
#else
  int sign;
  return ::lgamma_r(n + 1.0, &sign);
#endif
}
} // namespace measuredbrdf

#endif
