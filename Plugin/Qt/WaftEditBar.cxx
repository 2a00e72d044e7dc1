// SPDX-License-Identifier: BSD-3-Clause
#include "WaftEditBar.h"

#include "WaftEditor.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqUndoStack.h>

#include <QAction>
#include <QMainWindow>
#include <QSpinBox>
#include <QTimer>
#include <QToolButton>

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
  this->connect(this->Edit, &QAction::toggled, this->Editor, &WaftEditor::SetOn);
  this->connect(this->Mark, &QAction::toggled, this->Editor, &WaftEditor::SetPlacing);
  this->connect(this->Remove, &QAction::triggered, this->Editor, &WaftEditor::RemoveMark);
  this->connect(this->SaveScene, &QAction::triggered, this, &WaftEditBar::Save);
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
  const bool isOn = this->Edit->isChecked() && this->Editor->Source() != nullptr;
  const int last = this->Editor->Scene().LastObject;
  this->Body->setMaximum(last > 0 ? last : 0);
  this->Body->setEnabled(isOn && last > 0);
  this->Mark->setEnabled(isOn && last >= 0);
  this->Remove->setEnabled(isOn);
  this->SaveScene->setEnabled(this->Editor->Source() != nullptr &&
                              waft::HasEdits(this->Editor->Source()->getProxy()));
}

void WaftEditBar::Save()
{
  pqPipelineSource* source = this->Editor->Source();
  if (source != nullptr && waft::SaveEdits(source->getProxy()))
  {
    // Steps before it are on the file now; to take one back is another edit.
    pqApplicationCore::instance()->getUndoStack()->clear();
    source->setModifiedState(pqProxy::UNMODIFIED);
    this->Editor->Refresh();
  }
}
