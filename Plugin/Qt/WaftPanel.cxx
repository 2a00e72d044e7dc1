// SPDX-License-Identifier: BSD-3-Clause
#include "WaftPanel.h"

#include <QComboBox>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>

namespace waft
{

namespace
{

constexpr int Border = 12; // pixels about an icon, as the other buttons of the row have it

} // namespace

void FitPanel(QWidget* window)
{
  auto* panel = window->findChild<QWidget*>("propertiesPanel");
  auto* area = panel != nullptr ? panel->findChild<QScrollArea*>("scrollArea") : nullptr;
  if (area == nullptr)
  {
    return;
  }
  const auto fit = [area](int, int lacking)
  {
    if (lacking > 0)
    {
      for (auto* button : area->findChildren<QPushButton*>("EditColorMap"))
      {
        button->setText({});
        button->setMaximumWidth(button->iconSize().width() + Border);
      }
      for (auto* choice : area->findChildren<QComboBox*>("Variables"))
      {
        choice->setMinimumWidth(choice->minimumSizeHint().width() / 2);
      }
    }
  };
  QObject::connect(area->horizontalScrollBar(), &QScrollBar::rangeChanged, area, fit);
}

} // namespace waft
