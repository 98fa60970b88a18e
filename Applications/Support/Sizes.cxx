// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Sizes.h"

#include "Tool.h"

#include "vtkBasisBRDF.h"

#include <charconv>
#include <cmath>

namespace
{
constexpr double MinimumAngle = 1.0;
constexpr double MaximumAngle = 120.0;

//------------------------------------------------------------------------------
// Two numbers with one separator between, and nothing else.
template <typename Number>
bool ParseTwo(const std::string& text, char separator, Number& first, Number& second)
{
  const char* end = text.data() + text.size();
  const auto a = std::from_chars(text.data(), end, first);
  if (a.ec != std::errc() || a.ptr == end || *a.ptr != separator)
  {
    return false;
  }
  const auto b = std::from_chars(a.ptr + 1, end, second);
  return b.ec == std::errc() && b.ptr == end;
}
}

namespace tool
{
//------------------------------------------------------------------------------
Size ParseSize(const std::string& option, const std::string& text, int largest)
{
  Size size{};
  if (!ParseTwo(text, 'x', size.Width, size.Height) || size.Width < 1 || size.Height < 1 ||
      size.Width > largest || size.Height > largest)
  {
    throw UsageError(option + ": '" + text + "' is not WIDTHxHEIGHT with both between 1 and " +
                     std::to_string(largest) + ", like 800x600");
  }
  return size;
}

//------------------------------------------------------------------------------
View ParseView(const std::string& text)
{
  View view{};
  const std::size_t first = text.find(',');
  const std::size_t last = text.rfind(',');
  bool valid = false;
  if (first == last)
  {
    valid = ParseTwo(text, ',', view.Azimuth, view.Elevation);
  }
  else
  {
    valid = ParseTwo(text.substr(0, last), ',', view.Azimuth, view.Elevation) &&
            ParseTwo(text.substr(first + 1), ',', view.Elevation, view.Angle);
  }
  valid = valid && std::isfinite(view.Azimuth) && std::abs(view.Elevation) <= 90.0 &&
          view.Angle >= MinimumAngle && view.Angle <= MaximumAngle;
  if (!valid)
  {
    throw UsageError("--view: '" + text +
                     "' is not AZIMUTH,ELEVATION or AZIMUTH,ELEVATION,ANGLE in degrees with the "
                     "elevation between -90 and 90 and the angle of view between 1 and 120, like "
                     "30,20");
  }
  return view;
}

//------------------------------------------------------------------------------
Range ParseZone(const std::string& option, const std::string& text)
{
  Range zone{};
  if (!ParseTwo(text, ',', zone.Begin, zone.End) || !(zone.Begin >= 0.0) ||
      !(zone.Begin + vtkBasisBRDF::MinimumZoneWidth <= zone.End) || !(zone.End <= 90.0))
  {
    throw UsageError(option + ": '" + text +
                     "' is not BEGIN,END in degrees with 0 <= BEGIN < END <= 90 and at least " +
                     FormatNumber(vtkBasisBRDF::MinimumZoneWidth) + " between, like 9,57");
  }
  return zone;
}
} // namespace tool
