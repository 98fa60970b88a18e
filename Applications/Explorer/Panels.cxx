// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Panels.h"

#include "Controls.h"
#include "Inspection.h"
#include "JsonReport.h"
#include "Measuring.h"
#include "Sheets.h"
#include "Tool.h"

#include "vtkRadiancePlanner.h"

#include <QFontDatabase>
#include <QHeaderView>
#include <QPlainTextEdit>
#include <QScrollBar>
#include <QTextBrowser>
#include <QToolButton>
#include <QTreeWidget>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace explorer
{
//------------------------------------------------------------------------------
QWidget* MakePictureBar(Session* session)
{
  auto* bar = new QWidget;
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(6, 3, 6, 3);
  std::array<QComboBox*, 2> methods;
  for (int k = 0; k < 2; ++k)
  {
    auto* list = new QComboBox;
    for (const MethodName& name : GetMethodNames())
    {
      AddItem(list, name.Name, QString::fromStdString(name.Key), name.Description);
    }
    list->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    list->setMinimumContentsLength(10);
    list->setToolTip(k == 0 ? QObject::tr("What the left side is drawn by")
                            : QObject::tr("What the right side is drawn by"));
    list->setAccessibleName(k == 0 ? QObject::tr("Method A") : QObject::tr("Method B"));
    list->setObjectName(k == 0 ? "method A" : "method B");
    AddNamed(row, k == 0 ? QObject::tr("&A") : QObject::tr("&B"), list);
    OnChange(
      list, [=](const QVariant& key) { session->SetMethod(k, key.toString().toStdString()); });
    methods[k] = list;
  }
  auto* lights = new QComboBox;
  for (int count = 1; count <= MostLights; count *= 2)
  {
    lights->addItem(QString::number(count), count);
  }
  lights->setToolTip(QObject::tr(
    "How many lights stand for the environment: of the light set, soft lights and the thesis"));
  lights->setAccessibleName(QObject::tr("Number of lights"));
  auto* difference = new QToolButton;
  difference->setText(QObject::tr("Difference"));
  difference->setCheckable(true);
  difference->setShortcut(Qt::CTRL | Qt::Key_D);
  difference->setToolTip(QObject::tr("Show |A - B| instead of the pictures (Ctrl+D)"));
  auto* exposure = MakeField(-MostStops, MostStops, 1, 0.5, "",
    QObject::tr("Exposure of both sides in stops; at 0 the picture is that of the mapper"));
  exposure->setKeyboardTracking(true);
  exposure->setAccessibleName(QObject::tr("Exposure"));
  auto* fit = new QToolButton;
  fit->setText(QObject::tr("Fit"));
  fit->setToolTip(QObject::tr(
    "The exposure that shows a white matte surface as 70 % of white in this environment"));
  AddNamed(row, QObject::tr("&Lights"), lights);
  row->addWidget(difference);
  AddNamed(row, QObject::tr("E&xposure"), exposure);
  row->addWidget(fit);
  row->addStretch(1);

  OnChange(lights, [=](const QVariant& count) { session->SetLights(count.toInt()); });
  OnChange(difference, [=](bool on) { session->SetShown(on ? Shown::Difference : Shown::Split); });
  Bind(exposure, session, &Session::pictureChanged, &State::Exposure);
  QObject::connect(fit, &QToolButton::clicked, session,
    [=]()
    {
      session->Set(&State::Exposure, std::log2(tool::ChooseExposure(session->GetEnvironment())),
        &Session::pictureChanged);
    });
  Follow(session, bar,
    { &Session::methodsChanged, &Session::pictureChanged, &Session::environmentChanged },
    [=]()
    {
      const State& state = session->GetState();
      for (std::size_t k = 0; k < 2; ++k)
      {
        Show(methods[k], QString::fromStdString(state.Methods[k]));
      }
      Show(lights, state.Lights);
      lights->setEnabled(!session->IsDirectional()); // there is one, whatever is chosen
      Show(difference, state.Show == Shown::Difference);
      fit->setEnabled(session->GetEnvironment() != nullptr);
    });
  return bar;
}

namespace
{
//------------------------------------------------------------------------------
QTreeWidget* MakeTree(const QString& name)
{
  auto* list = new QTreeWidget;
  list->setHeaderHidden(true);
  list->setRootIsDecorated(false);
  list->setIndentation(12);
  list->setUniformRowHeights(true);
  list->setAccessibleName(name);
  list->setExpandsOnDoubleClick(false);
  return list;
}

//------------------------------------------------------------------------------
// Headings with their items; the one that is shown is selected.
void FillList(QTreeWidget* list, const std::vector<Item>& items, const std::string& current)
{
  list->clear();
  std::map<std::string, QTreeWidgetItem*> headings;
  for (const Item& item : items)
  {
    QTreeWidgetItem*& heading = headings[item.Kind];
    if (!heading)
    {
      QString title = QString::fromStdString(item.Kind);
      title.replace(0, 1, title.left(1).toUpper());
      heading = new QTreeWidgetItem(list, { title });
      heading->setFlags(Qt::ItemIsEnabled);
      QFont font = heading->font(0);
      font.setBold(true);
      heading->setFont(0, font);
    }
    auto* line = new QTreeWidgetItem(heading, { QString::fromStdString(item.Name) });
    line->setData(0, Qt::UserRole, QString::fromStdString(item.File));
    line->setToolTip(0, QString::fromStdString(item.Source));
    // A model's parameters follow its name; that with the same ones is a file, which comes first.
    if (item.File == current ||
        (!list->currentItem() && current.compare(0, item.File.size() + 1, item.File + " ") == 0))
    {
      list->setCurrentItem(line);
    }
  }
  list->expandAll();
  if (list->currentItem())
  {
    list->scrollToItem(list->currentItem());
  }
}

//------------------------------------------------------------------------------
// Calls a function with each item of a list that stands for a file, and its file.
template <typename Function>
void ForEachItem(QTreeWidget* list, const Function& function)
{
  for (int k = 0; k < list->topLevelItemCount(); ++k)
  {
    for (int j = 0; j < list->topLevelItem(k)->childCount(); ++j)
    {
      QTreeWidgetItem* item = list->topLevelItem(k)->child(j);
      function(item, item->data(0, Qt::UserRole).toString());
    }
  }
}

//------------------------------------------------------------------------------
// Widgets: a tick of a list's own would also choose the material.
void AddCompareBoxes(QTreeWidget* list, Session* session)
{
  ForEachItem(list,
    [=](QTreeWidgetItem* item, const QString& file)
    {
      auto* box = MakeBox("", QObject::tr("Draw it in the slices' charts, too"));
      box->setFocusPolicy(Qt::NoFocus); // View, Compare has a key
      box->setObjectName("compare " + file);
      box->setAccessibleName(QObject::tr("Compare %1").arg(item->text(0)));
      list->setItemWidget(item, 1, box);
      OnChange(box, [=](bool on) { session->SetCompared(file.toStdString(), on); });
      Follow(session, box, { &Session::comparedChanged },
        [=]() { Show(box, session->IsCompared(file.toStdString())); });
    });
}
}

//------------------------------------------------------------------------------
QWidget* MakeListPanel(Session* session)
{
  auto* panel = new QWidget;
  panel->setMinimumWidth(200);
  auto* materials = MakeTree(QObject::tr("Materials"));
  materials->setColumnCount(2); // the second: whether it is in the charts
  materials->header()->setStretchLastSection(false);
  materials->header()->setMinimumSectionSize(8);
  materials->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  materials->header()->setSectionResizeMode(1, QHeaderView::Fixed);
  materials->header()->resizeSection(1, QCheckBox().sizeHint().width() + 6);
  auto* environments = MakeTree(QObject::tr("Environments"));
  auto* meshes = new QComboBox;
  meshes->setAccessibleName(QObject::tr("Mesh"));
  meshes->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);

  auto* layout = MakeColumn(panel);
  const auto add = [&](const QString& title, QWidget* list, int stretch)
  {
    auto* label = new QLabel(title);
    label->setBuddy(list);
    layout->addWidget(label);
    layout->addWidget(list, stretch);
  };
  add(QObject::tr("&Materials"), materials, 5);
  add(QObject::tr("En&vironments"), environments, 2);
  add(QObject::tr("M&esh"), meshes, 0);

  const auto choose = [=](QTreeWidget* list, void (Session::*set)(const std::string&))
  {
    QObject::connect(list, &QTreeWidget::currentItemChanged, session,
      [=](QTreeWidgetItem* item)
      {
        const QString file = item ? item->data(0, Qt::UserRole).toString() : QString();
        if (!file.isEmpty())
        {
          (session->*set)(file.toStdString());
        }
      });
  };
  choose(materials, &Session::SetMaterial);
  choose(environments, &Session::SetEnvironment);
  OnChange(meshes, [=](const QVariant& file) { session->SetMesh(file.toString().toStdString()); });
  Follow(session, panel, { &Session::listsChanged },
    [=]()
    {
      const QSignalBlocker quiet[] = { QSignalBlocker(materials), QSignalBlocker(environments) };
      const State& state = session->GetState();
      FillList(materials, ListMaterials(state.MaterialFiles), state.Material);
      AddCompareBoxes(materials, session);
      FillList(environments, ListEnvironments(state.EnvironmentFiles), state.Environment);
      meshes->clear();
      for (const Item& item : ListMeshes(session->GetMeshFile()))
      {
        AddItem(meshes, item.Name, QString::fromStdString(item.File), item.Source);
      }
      Show(meshes, QString::fromStdString(state.Mesh));
    });
  return panel;
}

namespace
{
//------------------------------------------------------------------------------
// A row of a table, as HTML: words in the first column and the one of that number, else figures.
QString MakeRow(const QStringList& cells, int words = -1, bool bold = false)
{
  QString row = "<tr>";
  for (int k = 0; k < cells.size(); ++k)
  {
    row += QString("<td align='%1' style='padding:1px 6px'>%2</td>")
             .arg(k == 0 || k == words ? "left" : "right",
               bold ? "<b>" + cells[k].toHtmlEscaped() + "</b>" : cells[k].toHtmlEscaped());
  }
  return row + "</tr>";
}

constexpr int ToleranceSteps = 120; // of the slider, 40 for a factor of ten

//------------------------------------------------------------------------------
QString FormatError(double share)
{
  return share < 0.0 ? QString("–") : QString::fromStdString(tool::FormatPercent(share));
}

//------------------------------------------------------------------------------
QString FormatTime(double value) { return QString::fromStdString(tool::FormatMilliseconds(value)); }

//------------------------------------------------------------------------------
// Of a pixel, times a table's.
QString FormatCost(double value) { return QString::number(value, 'f', 2); }

//------------------------------------------------------------------------------
// What was predicted and measured of both sides.
QString MakeFigures(const std::array<Side*, 2>& sides, const Evaluation& evaluation)
{
  QStringList rows[] = { { "", "A", "B" }, { QObject::tr("Error, predicted") },
    { QObject::tr("Error, measured") }, { QObject::tr("Cost, predicted") },
    { QObject::tr("Frame, measured") } };
  for (int k = 0; k < 2; ++k)
  {
    const Side* side = sides[k];
    vtkRadiancePlanner* planner = side->IsReference() ? nullptr : side->GetPlanner();
    const int choice = planner && side->IsReady() ? planner->GetChoice() : -1;
    const SideFigures& figures = evaluation.GetFigures(k);
    rows[1] << FormatError(choice < 0 ? -1.0 : planner->GetPredictedError(choice));
    rows[2] << (side->IsReference()    ? QObject::tr("exact")
                : figures.Error >= 0.0 ? FormatError(figures.Error)
                                       : QString("…"));
    rows[3] << (choice < 0 ? QString("–") : FormatCost(planner->GetPredictedCost(choice)));
    rows[4] << (figures.Frame > 0.0 ? FormatTime(figures.Frame) : QString("–"));
  }
  QString table;
  for (const QStringList& row : rows)
  {
    table += MakeRow(row);
  }
  return "<table width='100%'>" + table + "</table>";
}

//------------------------------------------------------------------------------
// What was chosen of what, and why.
QString MakeCandidates(vtkRadiancePlanner* planner)
{
  QString table = MakeRow({ QObject::tr("Method"), QObject::tr("Error"), QObject::tr("Cost"),
                            QObject::tr("MB"), QObject::tr("Set-up"), QObject::tr("Sizes") },
    5);
  for (int k = 0; k < planner->GetNumberOfCandidates(); ++k)
  {
    const bool chosen = k == planner->GetChoice();
    const double megabytes = 1e-6 * double(planner->GetTextureBytes(k));
    table += MakeRow(
      { (chosen ? "▸ " : "") + QString::fromStdString(planner->GetMethodName(k)),
        FormatError(planner->GetPredictedError(k)), FormatCost(planner->GetPredictedCost(k)),
        QString::number(megabytes, 'f', 2), FormatTime(planner->GetSetUpMilliseconds(k)),
        QString::fromStdString(planner->GetDescription(k)) },
      5, chosen);
  }
  return "<p>" + QString::fromStdString(planner->GetReason()).toHtmlEscaped() + "</p><table>" +
         table + "</table>";
}
}

//------------------------------------------------------------------------------
QWidget* MakePlanPanel(Session* session, std::array<Side*, 2> sides, Evaluation* evaluation)
{
  auto* panel = new QWidget;
  auto* text = new QTextBrowser;
  text->setAccessibleName(QObject::tr("Plan"));
  auto* layout = MakeColumn(panel);
  auto* row = new QHBoxLayout;
  auto* percent = MakeField(0.1, 100.0, 2, 1.0, " %",
    QObject::tr("Error that a plan has to stay below, relative to the mean radiance"));
  percent->setAccessibleName(QObject::tr("Tolerance"));
  auto* name = new QLabel(QObject::tr("&Tolerance "));
  name->setBuddy(percent);
  row->addWidget(name);
  AddSlider(
    row, "tolerance", percent, ToleranceSteps, [](double value) { return std::log10(value); },
    [](double exponent) { return std::pow(10.0, exponent); }, session, &Session::toleranceChanged,
    [=]() { return 100.0 * session->GetState().Tolerance; },
    [=](double value) { session->SetTolerance(value / 100.0); });
  layout->addLayout(row);
  layout->addWidget(text, 1);

  const auto update = [=]()
  {
    QString html = MakeFigures(sides, *evaluation);
    QString plan =
      session->IsDirectional()
        ? QObject::tr("No plan: under one directional light there is nothing to integrate.")
        : QObject::tr("No plan: neither side is planned, or the plan is being made.");
    for (Side* side : { sides[1], sides[0] })
    {
      if (side->GetPlanner() && side->GetPlanner()->GetChoice() >= 0)
      {
        plan = (side->IsReady() ? QString()
                                : QObject::tr("(a new plan, or its picture, is being made) ")) +
               MakeCandidates(side->GetPlanner());
      }
    }
    html += plan;
    const tool::Size& size = evaluation->GetSize();
    html +=
      QObject::tr("<p>Errors are relative L1: mean |x - r| / mean r. Predicted: over a sphere "
                  "seen from everywhere. Measured: of this view in %1 x %2 pixels, where the "
                  "exact picture and the frame are made. Cost: of a pixel, times a "
                  "table's.</p>")
        .arg(size.Width)
        .arg(size.Height);
    const int place = text->verticalScrollBar()->value();
    text->setHtml(html);
    text->verticalScrollBar()->setValue(place);
  };
  for (Side* side : sides)
  {
    QObject::connect(side, &Side::changed, panel, update);
  }
  QObject::connect(evaluation, &Evaluation::changed, panel, update);
  update();
  return panel;
}

namespace
{
constexpr int SliderSteps = 400;
constexpr int TitleWidth = 130; // pixels

//------------------------------------------------------------------------------
// A number of a model by a slider and a field.
QWidget* MakeParameterRow(
  Session* session, const ParametricModel& model, const ModelParameter& parameter, std::size_t k)
{
  const bool isColor = parameter.Default.size() > 1;
  const QString channels[3] = { QObject::tr(", red"), QObject::tr(", green"),
    QObject::tr(", blue") };
  const QString title =
    QString::fromStdString(parameter.Name) + (isColor ? channels[k] : QString());
  const QString name =
    QString::fromStdString(parameter.Key) + (isColor ? QString(" %1").arg(k) : QString());
  const auto get = [=, &model]() // until its rows go, another model may be edited
  {
    const bool isShown = FindModel(session->GetEdited()) == &model;
    return (isShown ? GetValues(session->GetEdited()).at(parameter.Key) : parameter.Default)[k];
  };
  const auto set = [=](double value) { session->SetModelValue(parameter.Key, k, value); };
  auto* row = new QWidget;
  row->setToolTip(QString::fromStdString(parameter.Description));
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* label = new QLabel(title);
  label->setMinimumWidth(TitleWidth);
  layout->addWidget(label);
  auto* field =
    MakeField(parameter.Least, parameter.Largest, parameter.Largest > 100.0 ? 1 : 3, 1.0, "", "");
  field->setAccessibleName(title);
  double (*scale)(double) = [](double value) { return value; };
  double (*unscale)(double) = scale;
  if (parameter.IsLogarithmic)
  {
    scale = [](double value) { return std::log1p(value); };
    unscale = [](double place) { return std::expm1(place); };
  }
  AddSlider(
    layout, name, field, SliderSteps, scale, unscale, session, &Session::modelsChanged, get, set);
  return row;
}
}

//------------------------------------------------------------------------------
QWidget* MakeModelPanel(Session* session)
{
  auto* panel = new QWidget;
  auto* text = new QLabel;
  text->setWordWrap(true);
  auto* layout = MakeColumn(panel);
  layout->addWidget(text);
  layout->addStretch(1);
  Follow(session, panel, { &Session::modelsChanged },
    [=]()
    {
      const ParametricModel* model = FindModel(session->GetEdited());
      const QString key = model ? QString::fromStdString(model->Key) : QString();
      auto* before = panel->findChild<QWidget*>("parameters", Qt::FindDirectChildrenOnly);
      if (before && before->property("model").toString() == key)
      {
        return;
      }
      delete before;
      auto* rows = new QWidget;
      rows->setObjectName("parameters");
      rows->setProperty("model", key);
      layout->insertWidget(1, rows);
      text->setText(model ? QString::fromStdString(model->Name + ": " + model->Description)
                          : QObject::tr("The material that is shown is no model. Choose one in the "
                                        "list of materials."));
      auto* column = new QVBoxLayout(rows);
      column->setContentsMargins(0, 0, 0, 0);
      for (const ModelParameter& parameter :
        model ? model->Parameters : std::vector<ModelParameter>())
      {
        for (std::size_t k = 0; k < parameter.Default.size(); ++k)
        {
          column->addWidget(MakeParameterRow(session, *model, parameter, k));
        }
      }
    });
  return panel;
}

//------------------------------------------------------------------------------
QWidget* MakeFindingsPanel(Session* session)
{
  auto* text = new QPlainTextEdit;
  text->setObjectName("findings");
  text->setReadOnly(true);
  text->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  text->setLineWrapMode(QPlainTextEdit::NoWrap);
  text->setAccessibleName(QObject::tr("What is known of the material"));
  Follow(session, text, { &Session::materialChanged, &Session::inspected },
    [=]()
    {
      const nlohmann::ordered_json& info = session->GetInspection();
      text->setPlainText(session->GetInspectionError().isEmpty()
                           ? info.is_null() ? QObject::tr("Being measured …")
                                            : QString::fromStdString(tool::FormatReport(info))
                           : session->GetInspectionError());
    });
  return text;
}
} // namespace explorer
