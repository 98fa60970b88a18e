// SPDX-FileCopyrightText: Copyright (c) The vtkMeasuredBRDF authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ListPanel.h"

#include "Comparison.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include <map>

namespace
{
//------------------------------------------------------------------------------
QTreeWidget* MakeList(QWidget* parent, const QString& name)
{
  auto* list = new QTreeWidget(parent);
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
void Fill(QTreeWidget* list, const std::vector<explorer::Item>& items, const std::string& current)
{
  list->clear();
  std::map<std::string, QTreeWidgetItem*> headings;
  for (const explorer::Item& item : items)
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
QWidget* MakeHeading(
  const QString& text, QWidget* buddy, QPushButton*& button, const QString& toolTip)
{
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* label = new QLabel(text);
  label->setBuddy(buddy);
  button = new QPushButton(QObject::tr("Open…"));
  button->setToolTip(toolTip);
  layout->addWidget(label);
  layout->addStretch(1);
  layout->addWidget(button);
  return row;
}
}

namespace explorer
{
//------------------------------------------------------------------------------
ListPanel::ListPanel(Session* session, Comparison* comparison, QWidget* parent)
  : QWidget(parent)
  , Model(session)
  , Compared(comparison)
  , Search(new QLineEdit)
  , Materials(MakeList(this, tr("Materials")))
  , Environments(MakeList(this, tr("Environments")))
  , Meshes(new QComboBox)
{
  this->Search->setPlaceholderText(tr("Find a material"));
  this->Search->setClearButtonEnabled(true);
  this->Search->setAccessibleName(tr("Find a material"));
  this->Meshes->setAccessibleName(tr("Mesh"));
  this->Meshes->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 6);
  const auto add = [&](const QString& title, QWidget* list, const QString& kind, int stretch,
                     const QString& toolTip)
  {
    QPushButton* button = nullptr;
    layout->addWidget(MakeHeading(title, list, button, toolTip));
    if (list == this->Materials)
    {
      layout->addWidget(this->Search);
    }
    layout->addWidget(list, stretch);
    connect(button, &QPushButton::clicked, this, [this, kind]() { emit openRequested(kind); });
  };
  add(tr("&Materials"), this->Materials, "materials", 5,
    tr("Open material files; or drop them into the window"));
  add(tr("En&vironments"), this->Environments, "environments", 2,
    tr("Open environment images; or drop them into the window"));
  add(tr("M&esh"), this->Meshes, "meshes", 0, tr("Open a mesh; or drop it into the window"));
  this->setMinimumWidth(200);
  this->Materials->setColumnCount(2); // the second: whether it is in the charts
  this->Materials->header()->setStretchLastSection(false);
  this->Materials->header()->setMinimumSectionSize(8);
  this->Materials->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  this->Materials->header()->setSectionResizeMode(1, QHeaderView::Fixed);
  this->Materials->header()->resizeSection(1, QCheckBox().sizeHint().width() + 6);

  connect(this->Materials, &QTreeWidget::currentItemChanged, this,
    [this](QTreeWidgetItem* item)
    {
      const QString file = item ? item->data(0, Qt::UserRole).toString() : QString();
      if (!this->IsUpdating && !file.isEmpty())
      {
        this->Model->SetMaterial(file.toStdString());
      }
    });
  connect(this->Environments, &QTreeWidget::currentItemChanged, this,
    [this](QTreeWidgetItem* item)
    {
      const QString file = item ? item->data(0, Qt::UserRole).toString() : QString();
      if (!this->IsUpdating && !file.isEmpty())
      {
        this->Model->SetEnvironment(file.toStdString());
      }
    });
  connect(this->Meshes, QOverload<int>::of(&QComboBox::activated), this,
    [this](int index)
    { this->Model->SetMesh(this->Meshes->itemData(index).toString().toStdString()); });
  connect(this->Search, &QLineEdit::textChanged, this, &ListPanel::Filter);
  connect(session, &Session::listsChanged, this, &ListPanel::Update);
  connect(session, &Session::comparedChanged, this, &ListPanel::UpdateCompareBoxes);
  this->Update();
}

//------------------------------------------------------------------------------
void ListPanel::Update()
{
  this->IsUpdating = true;
  const State& state = this->Model->GetState();
  Fill(this->Materials, this->Model->GetMaterials(), state.Material);
  this->AddCompareBoxes();
  Fill(this->Environments, this->Model->GetEnvironments(), state.Environment);
  this->Meshes->clear();
  for (const Item& item : this->Model->GetMeshes())
  {
    this->Meshes->addItem(QString::fromStdString(item.Name), QString::fromStdString(item.File));
    this->Meshes->setItemData(
      this->Meshes->count() - 1, QString::fromStdString(item.Source), Qt::ToolTipRole);
  }
  this->Meshes->setCurrentIndex(this->Meshes->findData(QString::fromStdString(state.Mesh)));
  this->IsUpdating = false;
  this->Filter();
}

//------------------------------------------------------------------------------
// Widgets: a tick of a list's own would also choose the material.
void ListPanel::AddCompareBoxes()
{
  this->CompareBoxes.clear(); // the list has deleted them
  for (int k = 0; k < this->Materials->topLevelItemCount(); ++k)
  {
    QTreeWidgetItem* heading = this->Materials->topLevelItem(k);
    for (int j = 0; j < heading->childCount(); ++j)
    {
      QTreeWidgetItem* item = heading->child(j);
      const std::string file = item->data(0, Qt::UserRole).toString().toStdString();
      auto* box = new QCheckBox;
      box->setFocusPolicy(Qt::NoFocus); // View, Compare has a key
      box->setToolTip(tr("Draw it in the slices' charts, too"));
      box->setAccessibleName(tr("Compare %1").arg(item->text(0)));
      this->Materials->setItemWidget(item, 1, box);
      this->CompareBoxes[file] = box;
      connect(box, &QCheckBox::clicked, this,
        [this, file](bool on) { this->Compared->SetCompared(file, on); });
    }
  }
  this->UpdateCompareBoxes();
}

//------------------------------------------------------------------------------
void ListPanel::UpdateCompareBoxes()
{
  for (const auto& [file, box] : this->CompareBoxes)
  {
    box->setChecked(this->Compared->IsCompared(file));
  }
}

//------------------------------------------------------------------------------
QCheckBox* ListPanel::GetCompareBox(const std::string& file) const
{
  const auto found = this->CompareBoxes.find(file);
  return found == this->CompareBoxes.end() ? nullptr : found->second;
}

//------------------------------------------------------------------------------
void ListPanel::Filter()
{
  const QString words = this->Search->text().trimmed();
  for (int k = 0; k < this->Materials->topLevelItemCount(); ++k)
  {
    QTreeWidgetItem* heading = this->Materials->topLevelItem(k);
    bool any = false;
    for (int j = 0; j < heading->childCount(); ++j)
    {
      QTreeWidgetItem* item = heading->child(j);
      const bool fits = item->text(0).contains(words, Qt::CaseInsensitive) ||
                        heading->text(0).contains(words, Qt::CaseInsensitive);
      item->setHidden(!fits);
      any = any || fits;
    }
    heading->setHidden(!any);
  }
}
} // namespace explorer
