// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Report.h"

#include "Files.h"
#include "Inspection.h"
#include "JsonReport.h"
#include "MeasuredBRDFToolVersion.h"
#include "Measuring.h"
#include "Panels.h"
#include "Tool.h"

#include "vtkNew.h"
#include "vtkRadianceMetrics.h"

#include <QBuffer>

#include <functional>

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
QString MakePage(const explorer::ReportData& data, const ordered_json& report)
{
  const QString title = Escape(report["material"]) + " under " + Escape(report["environment"]);
  QString page = "<!DOCTYPE html><html><head><meta charset='utf-8'><title>" + title +
                 "</title><style>" + Style + "</style></head><body><h1>" + title + "</h1>";
  for (const auto& [name, image] : data.Pictures)
  {
    page += "<h2>" + name.toHtmlEscaped() + "</h2><img alt='" + name.toHtmlEscaped() + "' src='" +
            Embed(image) + "'>";
  }
  page += "<h2>Methods</h2><table><tr><th></th><th>A</th><th>B</th></tr>";
  // A figure of both sides, or "–" where one has none.
  using Format = std::function<std::string(double)>;
  const auto row = [&](const std::string& name, const std::string& key, const Format& format)
  {
    const ordered_json::json_pointer pointer(key);
    page += "<tr><td>" + QString::fromStdString(name) + "</td>";
    for (const ordered_json& side : report["sides"])
    {
      const bool has = side.contains(pointer) && side[pointer].is_number();
      page +=
        "<td class='n'>" + (has ? QString::fromStdString(format(side[pointer])) : "–") + "</td>";
    }
    page += "</tr>";
  };
  page += "<tr><td>Method</td><td>" + Escape(report["sides"][0]["description"]) + "</td><td>" +
          Escape(report["sides"][1]["description"]) + "</td></tr>";
  row("Frame", "/frame_ms", &tool::FormatMilliseconds);
  row("Predicted error", "/predicted_error", &tool::FormatPercent);
  for (const tool::Metric& metric : tool::GetMetrics())
  {
    row(
      metric.Label, "/errors/" + metric.Name,
      metric.Relative ? Format(&tool::FormatPercent)
                      : [](double value) { return QString::number(value, 'g', 3).toStdString(); });
  }
  page +=
    QString("</table><p>Errors are of this view in %1 x %2 pixels, against the exact picture. "
            "The frame is one of that size.</p>")
      .arg(data.Size.Width)
      .arg(data.Size.Height);
  if (report.contains("light"))
  {
    page += QString("<p>One directional light: polar angle %1°, azimuth %2°, irradiance %3.</p>")
              .arg(report["light"]["theta"].get<double>())
              .arg(report["light"]["phi"].get<double>())
              .arg(report["light"]["irradiance"].get<double>());
  }
  if (report["plan"] != "")
  {
    page += "<h2>Plan</h2><pre>" + Escape(report["plan"]) + "</pre>";
  }
  if (report.contains("info"))
  {
    page += "<h2>Material</h2>" + explorer::MakeFindingsTable(report["info"]) + "<pre>" +
            Escape(tool::FormatReport(report["info"])) + "</pre>";
  }
  return page + "<h2>State</h2><pre>" + Escape(report["state"].dump(2)) +
         "</pre><p>measured-brdf " MEASUREDBRDF_VERSION "</p></body></html>\n";
}
}

namespace explorer
{
//------------------------------------------------------------------------------
void WriteReport(const ReportData& data, const std::string& path)
{
  const std::string ending = tool::Extension(path);
  if (ending != ".html" && ending != ".json")
  {
    throw tool::Error(path + ": a report's name ends in .html or .json");
  }
  tool::CheckWritable(path);
  ordered_json report = data.Figures;
  for (std::size_t k = 0; k < 2; ++k)
  {
    if (!data.Reference.empty() && data.Radiance[k].size() == data.Reference.size())
    {
      vtkNew<vtkRadianceMetrics> metrics;
      tool::Measure(
        metrics, tool::Grid(*data.Visible, data.Size), data.Radiance[k], data.Reference);
      for (const tool::Metric& metric : tool::GetMetrics())
      {
        report["sides"][k]["errors"][metric.Name] = metric.Get(metrics); // NaN becomes null
      }
    }
  }
  tool::WriteWhole(path,
    ending == ".html" ? MakePage(data, report).toStdString()
                      : report.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}
} // namespace explorer
