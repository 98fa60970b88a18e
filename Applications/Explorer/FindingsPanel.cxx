// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Controls.h"
#include "Inspection.h"
#include "Measuring.h"
#include "Panels.h"
#include "Tool.h"

#include "vtkEnvironment.h"

#include <QFontDatabase>
#include <QPlainTextEdit>

#include <array>
#include <cstdio>

namespace explorer
{
namespace
{
// Where a deviation is worth a warning.
constexpr double ReciprocityLimit = 0.01; // relative
constexpr double Rounding = 1e-9;
constexpr double NegativeMassLimit = 0.001; // share

//------------------------------------------------------------------------------
std::string Format(const char* format, double value)
{
  char text[64];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

//------------------------------------------------------------------------------
Finding FindTransmission(const nlohmann::ordered_json& transmission)
{
  const auto share = [](const nlohmann::ordered_json& row)
  {
    const std::array<double, 3> rgb = row["light"];
    return tool::FormatPercent(vtkEnvironment::GetLuminance(rgb.data()));
  };
  const nlohmann::ordered_json& rows = transmission["per_angle"];
  const double total = transmission["largest_reflectance_and_transmittance"];
  const bool gains = transmission["gains_energy"];
  return { !gains, "Transmission",
    "Transmits " + share(rows.front()) + " of light along the normal, " + share(rows.back()) +
      " at " + Format("%.0f degrees", rows.back()["degrees"]) + "; with what is reflected " +
      Format("%.3f at most (azimuths averaged)", total) +
      (gains ? ": more light than it gets" : "") + ". Not drawn in the picture" };
}
}

//------------------------------------------------------------------------------
std::vector<Finding> FindFindings(const nlohmann::ordered_json& info)
{
  std::vector<Finding> findings;
  const double reciprocity = info["reciprocity_error"];
  findings.push_back({ reciprocity <= ReciprocityLimit, "Reciprocity",
    (reciprocity < Rounding
        ? std::string("f(i,o) and f(o,i) are equal but for rounding")
        : "f(i,o) and f(o,i) differ by " + tool::FormatPercent(reciprocity) + " (RMS " +
            tool::FormatPercent(info["reciprocity_rms_error"]) + ")") +
      (info["reciprocal_by_construction"] ? "; reciprocal by construction" : "") });
  const double albedo = info["largest_albedo"];
  const bool gains = info["gains_energy"];
  findings.push_back({ !gains, "Energy",
    "The largest albedo is " + Format("%.3f", albedo) +
      (gains ? ": the material gives back more light than it gets"
             : "; no reflectance is above 1") });
  const auto negative = info["negative_values"].get<long long>();
  const double mass = info["negative_mass"];
  findings.push_back({ mass <= NegativeMassLimit, "Negative values",
    negative == 0 && !(mass > 0.0)
      ? std::string("None")
      : tool::FormatCount(static_cast<std::size_t>(negative), "stored value") + ", " +
          tool::FormatPercent(mass) + " of all f, clamped to 0" });
  const auto invalid = info["invalid_values"].get<long long>();
  findings.push_back({ invalid == 0, "Invalid values",
    invalid == 0 ? std::string("None")
                 : tool::FormatCount(static_cast<std::size_t>(invalid), "stored value") +
                     " not finite, replaced" });
  if (info.contains("transmission"))
  {
    findings.push_back(FindTransmission(info["transmission"]));
  }
  return findings;
}

//------------------------------------------------------------------------------
FindingsPanel::FindingsPanel(Session* session, Jobs* jobs)
{
  auto* findings = new QLabel;
  findings->setObjectName("findings");
  findings->setWordWrap(true);
  findings->setTextFormat(Qt::RichText);
  findings->setTextInteractionFlags(Qt::TextSelectableByMouse);
  findings->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  auto* text = new QPlainTextEdit;
  text->setReadOnly(true);
  text->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  text->setLineWrapMode(QPlainTextEdit::NoWrap);
  text->setAccessibleName(tr("What is known of the material"));
  auto* layout = MakeColumn(this);
  layout->addWidget(findings);
  layout->addWidget(text, 1);
  const auto show = [=](const nlohmann::ordered_json& info)
  {
    this->Info = info;
    QString rows;
    for (const Finding& finding : FindFindings(info))
    {
      rows += QString("<tr><td style='color:%1'>%2</td><td style='padding:2px "
                      "8px'><b>%3</b></td><td>%4</td></tr>")
                .arg(finding.IsGood ? "#2e8c3e" : "#c8641e", finding.IsGood ? "✔" : "⚠",
                  QString::fromStdString(finding.Name).toHtmlEscaped(),
                  QString::fromStdString(finding.Text).toHtmlEscaped());
    }
    findings->setText("<table>" + rows + "</table>");
    text->setPlainText(QString::fromStdString(tool::FormatInspection(info)));
    emit this->inspected();
  };
  connect(session, &Session::materialChanged, this,
    [=]()
    {
      this->Info = nullptr;
      findings->setText(tr("Being measured …"));
      text->clear();
      jobs->Compute(
        "findings", tr("measuring the material"),
        [material = MakeSnapshot(session->GetMaterial())]()
        { return tool::InspectMaterial(material); },
        show,
        [=](const QString& problem)
        {
          findings->clear();
          session->Say(problem, true);
        });
    });
}
} // namespace explorer
