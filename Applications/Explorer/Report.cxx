// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Report.h"

#include "Files.h"
#include "Inspection.h"
#include "MeasuredBRDFToolVersion.h"
#include "Measuring.h"
#include "Panels.h"
#include "Tool.h"

#include "vtkNew.h"
#include "vtkRadianceMetrics.h"

#include <QBuffer>

using nlohmann::ordered_json;

namespace
{
const char* const Style =
  "body{font-family:sans-serif;max-width:60em;margin:2em auto;padding:0 1em;color:#222}"
  "table{border-collapse:collapse}td,th{padding:.2em .8em;border-bottom:1px solid "
  "#ddd;text-align:left}"
  "td.n{text-align:right}img{max-width:100%}pre{background:#f4f4f4;padding:1em;overflow:auto}";

//------------------------------------------------------------------------------
QString Escape(const std::string& text) { return QString::fromStdString(text).toHtmlEscaped(); }

//------------------------------------------------------------------------------
QString Embed(const QImage& image)
{
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  image.save(&buffer, "PNG");
  return "data:image/png;base64," + QString::fromLatin1(bytes.toBase64());
}

//------------------------------------------------------------------------------
QString FormatFigure(const tool::Metric& metric, const ordered_json& value)
{
  return !value.is_number() ? QString("–")
         : metric.Relative  ? QString::fromStdString(tool::FormatPercent(value))
                            : QString::number(value.get<double>(), 'g', 3);
}

//------------------------------------------------------------------------------
QString MakePage(const explorer::ReportData& data, const ordered_json& report)
{
  QString page = "<!DOCTYPE html><html><head><meta charset='utf-8'><title>" +
                 Escape(data.Material) + "</title><style>" + Style + "</style></head><body><h1>" +
                 Escape(data.Material) + " under " + Escape(data.Explored.Environment) + "</h1>";
  for (const auto& [title, image] : data.Pictures)
  {
    page += "<h2>" + title.toHtmlEscaped() + "</h2><img alt='" + title.toHtmlEscaped() + "' src='" +
            Embed(image) + "'>";
  }
  page += "<h2>Methods</h2><table><tr><th></th><th>A</th><th>B</th></tr>";
  const auto row = [&](const QString& name, const auto& get)
  {
    page += "<tr><td>" + name + "</td>";
    for (const ordered_json& side : report["sides"])
    {
      page += "<td class='n'>" + get(side) + "</td>";
    }
    page += "</tr>";
  };
  row("Method", [](const ordered_json& side) { return Escape(side["description"]); });
  // A figure of a side, or "–" where it has none.
  const auto figure = [&](const QString& name, const char* key, std::string (*format)(double))
  {
    row(name, [=](const ordered_json& side)
      { return side.contains(key) ? QString::fromStdString(format(side[key])) : QString("–"); });
  };
  figure("Frame", "frame_ms", &tool::FormatMilliseconds);
  figure("Predicted error", "predicted_error", &tool::FormatPercent);
  for (const tool::Metric& metric : tool::GetMetrics())
  {
    row(QString::fromStdString(metric.Label),
      [&](const ordered_json& side)
      {
        return side.contains("errors") ? FormatFigure(metric, side["errors"][metric.Name])
                                       : QString("–");
      });
  }
  page += "</table>";
  page += QString("<p>Errors are of this view in %1 x %2 pixels, against the exact picture. The "
                  "frame is one of that size.</p>")
            .arg(data.Size.Width)
            .arg(data.Size.Height);
  if (report.contains("light"))
  {
    const explorer::LightState& light = data.Explored.Light;
    page += QString("<p>One directional light: polar angle %1°, azimuth %2°, irradiance %3.</p>")
              .arg(light.Theta)
              .arg(light.Phi)
              .arg(light.Irradiance);
  }
  if (!data.Plan.empty())
  {
    page += "<h2>Plan</h2><pre>" + Escape(data.Plan) + "</pre>";
  }
  if (data.Inspection.is_object())
  {
    page += "<h2>Material</h2><table>";
    for (const auto& finding : explorer::FindFindings(data.Inspection))
    {
      page += QString("<tr><td>%1</td><td>%2</td><td>%3</td></tr>")
                .arg(finding.IsGood ? "✔" : "⚠", Escape(finding.Name), Escape(finding.Text));
    }
    page += "</table><pre>" + Escape(tool::FormatInspection(data.Inspection)) + "</pre>";
  }
  return page + "<h2>State</h2><pre>" + Escape(explorer::WriteState(data.Explored)) +
         "</pre><p>measured-brdf " MEASUREDBRDF_VERSION "</p></body></html>\n";
}
}

namespace explorer
{
//------------------------------------------------------------------------------
ordered_json MakeReport(const ReportData& data)
{
  ordered_json sides = ordered_json::array();
  for (const ReportSide& side : data.Sides)
  {
    ordered_json entry = { { "description", side.Description } };
    if (side.PredictedError >= 0.0)
    {
      entry["predicted_error"] = side.PredictedError;
    }
    if (side.Frame > 0.0)
    {
      entry["frame_ms"] = side.Frame;
    }
    if (!side.IsReference && !data.Reference.empty() &&
        side.Radiance.size() == data.Reference.size())
    {
      vtkNew<vtkRadianceMetrics> metrics;
      tool::Measure(metrics, tool::Grid(*data.Visible, data.Size), side.Radiance, data.Reference);
      for (const tool::Metric& metric : tool::GetMetrics())
      {
        entry["errors"][metric.Name] = metric.Get(metrics); // NaN becomes null
      }
    }
    sides.push_back(entry);
  }
  ordered_json report = { { "format", "measured-brdf explorer report" },
    { "material", data.Material }, { "environment", data.Explored.Environment },
    { "width", data.Size.Width }, { "height", data.Size.Height }, { "sides", sides },
    { "plan", data.Plan }, { "state", ordered_json::parse(WriteState(data.Explored)) } };
  if (data.Explored.Environment == DirectionalLightName)
  {
    const LightState& light = data.Explored.Light;
    report["light"] = { { "theta", light.Theta }, { "phi", light.Phi },
      { "irradiance", light.Irradiance } };
  }
  if (data.Inspection.is_object())
  {
    report["info"] = data.Inspection;
  }
  return report;
}

//------------------------------------------------------------------------------
void WriteReport(const ReportData& data, const std::string& path)
{
  const std::string ending = tool::Extension(path);
  if (ending != ".html" && ending != ".json")
  {
    throw tool::Error(path + ": a report's name ends in .html or .json");
  }
  tool::CheckWritable(path);
  const ordered_json report = MakeReport(data);
  tool::WriteWhole(path,
    ending == ".html" ? MakePage(data, report).toStdString()
                      : report.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}
} // namespace explorer
