// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/request_dialog.hpp"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QLabel>
#include <QLineEdit>
#include <QVBoxLayout>

namespace sks_detector {

void askForRequest(QWidget* parent, const RequestQuestion& question,
                   const std::function<void(const QString&, bool)>& send) {
  auto* dialog = new QDialog(parent);
  dialog->setObjectName("request");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(question.title);
  auto* label = new QLabel(question.label);
  label->setWordWrap(true);
  auto* text = new QLineEdit(question.text);
  text->setObjectName("text");
  auto* option = new QCheckBox(question.option);
  option->setObjectName("option");
  option->setVisible(!question.option.isEmpty());
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  buttons->setObjectName("buttons");
  auto* layout = new QVBoxLayout(dialog);
  for (QWidget* part : {static_cast<QWidget*>(label), static_cast<QWidget*>(text), static_cast<QWidget*>(option),
                        static_cast<QWidget*>(buttons)}) {
    layout->addWidget(part);
  }
  QObject::connect(buttons, &QDialogButtonBox::accepted, dialog, &QDialog::accept);
  QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
  QObject::connect(dialog, &QDialog::accepted, parent, [=] {
    const QString answer = text->text().trimmed();
    if (!answer.isEmpty()) send(answer, option->isChecked());
  });
  dialog->open();
}

}  // namespace sks_detector
