// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Comparison.h"
#include "Controls.h"
#include "Panels.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLineEdit>
#include <QPushButton>
#include <QTreeWidget>

#include <map>

namespace explorer
{
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
void Fill(QTreeWidget* list, const std::vector<Item>& items, const std::string& current)
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
    if (item.File == current)
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
void AddCompareBoxes(QTreeWidget* list, Comparison* comparison)
{
  ForEachItem(list,
    [=](QTreeWidgetItem* item, const QString& file)
    {
      auto* box = MakeBox("", QObject::tr("Draw it in the slices' charts, too"));
      box->setFocusPolicy(Qt::NoFocus); // View, Compare has a key
      box->setObjectName("compare " + file);
      box->setAccessibleName(QObject::tr("Compare %1").arg(item->text(0)));
      box->setChecked(comparison->IsCompared(file.toStdString()));
      list->setItemWidget(item, 1, box);
      OnChange(box, [=](bool on) { comparison->SetCompared(file.toStdString(), on); });
    });
}

//------------------------------------------------------------------------------
// Hides what has not the words in its name or its heading's.
void Filter(QTreeWidget* list, const QString& words)
{
  for (int k = 0; k < list->topLevelItemCount(); ++k)
  {
    list->topLevelItem(k)->setHidden(true);
  }
  ForEachItem(list,
    [&words](QTreeWidgetItem* item, const QString&)
    {
      const bool fits = item->text(0).contains(words, Qt::CaseInsensitive) ||
                        item->parent()->text(0).contains(words, Qt::CaseInsensitive);
      item->setHidden(!fits);
      item->parent()->setHidden(item->parent()->isHidden() && !fits);
    });
}
}

//------------------------------------------------------------------------------
QWidget* MakeListPanel(
  Session* session, Comparison* comparison, const std::function<void(const QString&)>& open)
{
  auto* panel = new QWidget;
  panel->setMinimumWidth(200);
  auto* search = new QLineEdit;
  search->setPlaceholderText(QObject::tr("Find a material"));
  search->setClearButtonEnabled(true);
  search->setAccessibleName(QObject::tr("Find a material"));
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
  const auto add = [&](const QString& title, QWidget* list, const QString& kind, int stretch,
                     const QString& toolTip)
  {
    auto* label = new QLabel(title);
    label->setBuddy(list);
    auto* button = new QPushButton(QObject::tr("Open…"));
    button->setToolTip(toolTip);
    auto* row = new QHBoxLayout;
    row->addWidget(label);
    row->addStretch(1);
    row->addWidget(button);
    layout->addLayout(row);
    if (list == materials)
    {
      layout->addWidget(search);
    }
    layout->addWidget(list, stretch);
    QObject::connect(button, &QPushButton::clicked, panel, [=]() { open(kind); });
  };
  add(QObject::tr("&Materials"), materials, "materials", 5,
    QObject::tr("Open material files; or drop them into the window"));
  add(QObject::tr("En&vironments"), environments, "environments", 2,
    QObject::tr("Open environment images; or drop them into the window"));
  add(QObject::tr("M&esh"), meshes, "meshes", 0,
    QObject::tr("Open a mesh; or drop it into the window"));

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
  QObject::connect(search, &QLineEdit::textChanged, panel,
    [=](const QString& words) { Filter(materials, words.trimmed()); });
  const auto update = [=]()
  {
    const QSignalBlocker quiet[] = { QSignalBlocker(materials), QSignalBlocker(environments) };
    const State& state = session->GetState();
    Fill(materials, session->GetMaterials(), state.Material);
    AddCompareBoxes(materials, comparison);
    Fill(environments, session->GetEnvironments(), state.Environment);
    meshes->clear();
    for (const Item& item : session->GetMeshes())
    {
      meshes->addItem(QString::fromStdString(item.Name), QString::fromStdString(item.File));
      meshes->setItemData(
        meshes->count() - 1, QString::fromStdString(item.Source), Qt::ToolTipRole);
    }
    Show(meshes, QString::fromStdString(state.Mesh));
    Filter(materials, search->text().trimmed());
  };
  QObject::connect(session, &Session::listsChanged, panel, update);
  QObject::connect(session, &Session::comparedChanged, panel,
    [=]()
    {
      ForEachItem(materials,
        [=](QTreeWidgetItem* item, const QString& file)
        {
          auto* box = static_cast<QCheckBox*>(materials->itemWidget(item, 1));
          Show(box, comparison->IsCompared(file.toStdString()));
        });
    });
  update();
  return panel;
}
} // namespace explorer
