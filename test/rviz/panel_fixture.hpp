// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <QCheckBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QtTest/QTest>

#include "rviz/detector_panel.hpp"

namespace sks_detector {

/// A panel that is used as by hand.
class PanelFixture : public ::testing::Test {
protected:
  static constexpr int panel_patience = 20000;  // [ms] far longer than anything takes

  void SetUp() override { panel_->show(); }

  template <typename Part>
  Part* part(const char* name) {
    return panel_->findChild<Part*>(name);
  }
  std::string text(const char* label) { return part<QLabel>(label)->text().toStdString(); }
  void click(const char* button) { QTest::mouseClick(part<QPushButton>(button), Qt::LeftButton); }
  std::string cell(int row, int column) {
    const QTableWidgetItem* item = part<QTableWidget>("objects")->item(row, column);
    return item ? item->text().toStdString() : "no cell";
  }

  template <typename Condition>
  static bool until(Condition condition, int limit = panel_patience) {
    return QTest::qWaitFor([&] { return bool(condition()); }, limit);
  }
  bool untilText(const char* label, const std::string& wanted, int limit = panel_patience) {
    return until([&] { return text(label).find(wanted) != std::string::npos; }, limit);
  }

  /// Answers the dialog that is open.
  void answer(const QString& text, bool option, QDialogButtonBox::StandardButton button = QDialogButtonBox::Ok) {
    auto* dialog = part<QDialog>("request");
    ASSERT_NE(dialog, nullptr);
    dialog->findChild<QLineEdit*>("text")->setText(text);
    dialog->findChild<QCheckBox*>("option")->setChecked(option);
    QTest::mouseClick(dialog->findChild<QDialogButtonBox*>("buttons")->button(button), Qt::LeftButton);
    ASSERT_TRUE(until([&] { return part<QDialog>("request") == nullptr; }));
  }

  std::unique_ptr<DetectorPanel> panel_ = std::make_unique<DetectorPanel>();
};

}  // namespace sks_detector
