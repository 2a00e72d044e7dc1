// SPDX-License-Identifier: BSD-3-Clause
#include "WaftEditBar.h"

#include "SceneFlight.h"
#include "WaftActive.h"
#include "WaftEditor.h"
#include "WaftVerdict.h"

#include <pqApplicationCore.h>
#include <pqFileDialog.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>
#include <pqUndoStack.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>

#include <QAction>
#include <QFileInfo>
#include <QGuiApplication>
#include <QMainWindow>
#include <QMessageBox>
#include <QSpinBox>
#include <QStatusBar>
#include <QTimer>
#include <QToolButton>

namespace
{

constexpr int ToldFor = 10000; // ms

}

WaftEditBar::WaftEditBar(QWidget* parent) :
  QToolBar("Waft Edit", parent), Editor(new WaftEditor(this))
{
  this->setObjectName("WaftEditBar");
  this->Edit = this->Add("Edit", "Edit scene",
                         "Show the starts, marks and obstacles of the active Waft Animation as "
                         "handles that can be dragged (with Shift: up and down)");
  this->Edit->setCheckable(true);
  this->Mark = this->Add("Mark", "New mark",
                         "The next click in the view is a mark of the body at the frame shown");
  this->Mark->setCheckable(true);
  this->Body = new QSpinBox(this);
  this->Body->setObjectName("Body");
  this->Body->setPrefix("body ");
  this->Body->setToolTip("Whom a new mark is for; touching a handle chooses its body");
  this->addWidget(this->Body);
  this->Remove = this->Add("Remove", "Remove mark", "Take away the mark that was touched last");
  this->SaveScene =
    this->Add("SaveScene", "Save scene", "Write the edits to the scene file, in its own words");
  this->SaveSceneAs = this->Add("SaveSceneAs", "Save scene as...",
                                "Write the scene, with the edits, to a file of another name; also "
                                "what flies of sources that were made by hand");
  this->SaveFlight = this->Add("SaveFlight", "Save flight...",
                               "Write the flight to a folder, as the command does: for its "
                               "pictures, its page, Blender and others");
  this->connect(this->SaveFlight, &QAction::triggered, this, &WaftEditBar::SaveMotion);
  this->connect(this->Edit, &QAction::toggled, this->Editor, &WaftEditor::SetOn);
  this->connect(this->Mark, &QAction::toggled, this->Editor, &WaftEditor::SetPlacing);
  this->connect(this->Remove, &QAction::triggered, this->Editor, &WaftEditor::RemoveMark);
  this->connect(this->SaveScene, &QAction::triggered, this, &WaftEditBar::Save);
  this->connect(this->SaveSceneAs, &QAction::triggered, this, &WaftEditBar::SaveAs);
  this->connect(this->Body, QOverload<int>::of(&QSpinBox::valueChanged), this->Editor,
                &WaftEditor::SetBody);
  this->connect(this->Editor, &WaftEditor::changed, this, &WaftEditBar::Show);
  this->connect(this->Editor, &WaftEditor::placed, this, [this] { this->Mark->setChecked(false); });
  this->connect(this->Editor, &WaftEditor::touched, this,
                [this](int body)
                {
                  if (body >= 0)
                  {
                    this->Body->setValue(body);
                  }
                  this->Show();
                });
  this->Show();
  QTimer::singleShot(0, this, &WaftEditBar::MoveDown); // once the window has taken it in
}

WaftEditBar::~WaftEditBar() = default;

QAction* WaftEditBar::Add(const char* name, const QString& text, const QString& tip)
{
  auto* action = this->addAction(text);
  action->setToolTip(tip);
  this->widgetForAction(action)->setObjectName(name);
  return action;
}

void WaftEditBar::MoveDown()
{
  if (auto* window = qobject_cast<QMainWindow*>(this->window()))
  {
    window->addToolBar(Qt::BottomToolBarArea, this);
  }
}

void WaftEditBar::Show()
{
  pqPipelineSource* source = this->Editor->Source();
  const bool isOn = this->Edit->isChecked() && source != nullptr;
  const int last = this->Editor->Scene().LastObject;
  this->Edit->setEnabled(source != nullptr || this->Edit->isChecked());
  this->Body->setMaximum(last > 0 ? last : 0);
  this->Body->setEnabled(isOn && last > 0);
  this->Mark->setEnabled(isOn && last >= 0);
  this->Remove->setEnabled(isOn && this->Editor->CanRemoveMark());
  this->SaveFlight->setEnabled(source != nullptr);
  this->SaveScene->setEnabled(source != nullptr && waft::HasEdits(source->getProxy()));
  this->SaveSceneAs->setEnabled(source != nullptr ||
                                waft::FlightOf(waft::ChosenIn("ActiveSources")) != nullptr);
}

void WaftEditBar::Save()
{
  pqPipelineSource* source = this->Editor->Source();
  if (source != nullptr && waft::SaveEdits(source->getProxy()))
  {
    this->Saved(vtkSMPropertyHelper(source->getProxy(), "FileName").GetAsString());
  }
}

void WaftEditBar::SaveAs()
{
  pqPipelineSource* source = this->Editor->Source();
  vtkSMProxy* flight = waft::FlightOf(waft::ChosenIn("ActiveSources"));
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  pqServer* server =
    model->findServer((source != nullptr ? source->getProxy() : flight)->GetSession());
  pqFileDialog dialog(server, this->window(), "Save scene as", QString(),
                      "Waft scenes (*.waft.json)");
  dialog.setObjectName("SaveSceneDialog");
  dialog.setFileMode(pqFileDialog::AnyFile);
  if (dialog.exec() != QDialog::Accepted || dialog.getSelectedFiles().isEmpty())
  {
    return;
  }
  const QString file = dialog.getSelectedFiles().first();
  const bool isSaved =
    source != nullptr
      ? waft::SaveEditsAs(source->getProxy(), file)
      : waft::SaveFlownScene(vtkSMSourceProxy::SafeDownCast(flight), file.toStdString());
  if (isSaved)
  {
    this->Saved(file);
    if (source != nullptr)
    {
      source->rename(QFileInfo(file).fileName());
      source->renderAllViews();
    }
  }
}

void WaftEditBar::SaveMotion()
{
  pqPipelineSource* source = this->Editor->Source();
  pqFileDialog dialog(source->getServer(), this->window(), "Save flight: a folder for its files");
  dialog.setObjectName("SaveFlightDialog");
  dialog.setFileMode(pqFileDialog::Directory);
  if (dialog.exec() != QDialog::Accepted || dialog.getSelectedFiles().isEmpty())
  {
    return;
  }
  const QString folder = dialog.getSelectedFiles().first();
  QGuiApplication::setOverrideCursor(Qt::WaitCursor); // for some seconds
  const QString wrong = waft::SaveFlight(source->getProxy(), folder);
  QGuiApplication::restoreOverrideCursor();
  if (wrong.isEmpty())
  {
    this->Tell("saved: " + folder);
    return;
  }
  QMessageBox::warning(this->window(), "Save flight", wrong);
}

void WaftEditBar::Saved(const QString& file)
{
  if (pqPipelineSource* source = this->Editor->Source())
  {
    // Steps before it are on the file now; to take one back is another edit.
    pqApplicationCore::instance()->getUndoStack()->clear();
    source->setModifiedState(pqProxy::UNMODIFIED);
    this->Editor->Refresh();
  }
  this->Tell("saved: " + file);
}

void WaftEditBar::Tell(const QString& text)
{
  if (auto* window = qobject_cast<QMainWindow*>(this->window()))
  {
    window->statusBar()->showMessage(text, ToldFor);
  }
}
