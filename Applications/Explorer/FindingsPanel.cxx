// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FindingsPanel.h"

#include "Findings.h"
#include "Inspection.h"

#include <QFontDatabase>
#include <QLabel>
#include <QPlainTextEdit>
#include <QVBoxLayout>

namespace explorer
{
//------------------------------------------------------------------------------
FindingsPanel::FindingsPanel(Session* session, Jobs* jobs, QWidget* parent)
  : QWidget(parent)
  , Model(session)
  , Background(jobs)
  , Findings(new QLabel)
  , Text(new QPlainTextEdit)
{
  this->Findings->setWordWrap(true);
  this->Findings->setTextFormat(Qt::RichText);
  this->Findings->setTextInteractionFlags(Qt::TextSelectableByMouse);
  this->Findings->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  this->Text->setReadOnly(true);
  this->Text->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  this->Text->setLineWrapMode(QPlainTextEdit::NoWrap);
  this->Text->setAccessibleName(tr("What is known of the material"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 6);
  layout->addWidget(this->Findings);
  layout->addWidget(this->Text, 1);
  connect(session, &Session::materialChanged, this, &FindingsPanel::Start);
}

//------------------------------------------------------------------------------
void FindingsPanel::Start()
{
  tool::Material material = this->Model->GetMaterial();
  if (auto copy = vtkSmartPointer<vtkBRDF>::Take(material.BRDF->NewSnapshot()))
  {
    material.BRDF = copy;
  }
  this->Info = nullptr;
  this->Findings->setText(tr("Being measured …"));
  this->Text->clear();
  this->Background->Start(
    "findings", tr("measuring the material"),
    [this, material](JobThread& thread)
    {
      const nlohmann::ordered_json info = tool::InspectMaterial(material);
      thread.Post([this, info]() { this->Show(info); });
    },
    [this](const QString& text)
    {
      this->Findings->clear();
      this->Model->Say(text, true);
    });
}

//------------------------------------------------------------------------------
void FindingsPanel::Show(const nlohmann::ordered_json& info)
{
  this->Info = info;
  QString rows;
  for (const Finding& finding : FindFindings(info))
  {
    rows += QString(
      "<tr><td style='color:%1'>%2</td><td style='padding:2px 8px'><b>%3</b></td><td>%4</td></tr>")
              .arg(finding.IsGood ? "#2e8c3e" : "#c8641e", finding.IsGood ? "✔" : "⚠",
                QString::fromStdString(finding.Name).toHtmlEscaped(),
                QString::fromStdString(finding.Text).toHtmlEscaped());
  }
  this->Findings->setText("<table>" + rows + "</table>");
  this->Text->setPlainText(QString::fromStdString(tool::FormatInspection(info)));
  emit this->inspected();
}
} // namespace explorer
