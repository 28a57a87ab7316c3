// SPDX-License-Identifier: BSD-3-Clause
// How the parts of the panel are arranged.
#include <QFormLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSlider>
#include <QTableWidget>
#include <QVBoxLayout>

#include "rviz/detector_panel.hpp"

namespace sks_detector {
namespace {

constexpr int percent = 100;      // steps of slider and progress
constexpr int table_height = 60;  // [px] at least
constexpr int narrow_margin = 4;  // [px]

template <typename Part>
Part* named(Part* part, const char* name, const char* help = "") {
  part->setObjectName(name);
  part->setToolTip(help);
  return part;
}

/// A text from outside: never taken for markup, never wider than the panel.
QLabel* newLabel(const char* name, const char* help = "") {
  auto* label = named(new QLabel, name, help);
  label->setTextFormat(Qt::PlainText);
  label->setWordWrap(true);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Minimum);
  return label;
}

QHBoxLayout* row(std::initializer_list<QWidget*> parts) {
  auto* layout = new QHBoxLayout;
  for (QWidget* part : parts) layout->addWidget(part);
  return layout;
}

}  // namespace

void DetectorPanel::build() {
  node_ = named(new QLineEdit("/detector"), "node", "Name of the detector's node");
  state_ = newLabel("state");
  error_ = newLabel("error", "The last error whose cause is still there");
  error_->setStyleSheet("color: #c01010");
  stream_ = newLabel("stream", "Results of the last seconds: medians");
  codebook_ = newLabel("codebook");
  auto* form = new QFormLayout;
  form->addRow("Node", node_);
  form->addRow("State", state_);
  form->addRow("Results", stream_);
  form->addRow("Codebook", codebook_);

  objects_ = named(new QTableWidget(0, 3), "objects", "Click on an object to work on it");
  objects_->setHorizontalHeaderLabels({"Object", "Trained views", "Captured"});
  objects_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  objects_->verticalHeader()->hide();
  objects_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  objects_->setSelectionBehavior(QAbstractItemView::SelectRows);
  objects_->setSelectionMode(QAbstractItemView::SingleSelection);
  objects_->setMinimumHeight(table_height);

  load_ = named(new QPushButton("Load..."), "load", "Uses a codebook file of the node's machine");
  save_ = named(new QPushButton("Save..."), "save", "Writes the codebook in use to a file of the node's machine");
  remove_ = named(new QPushButton("Remove..."), "remove", "Takes the object out of the codebook in use");
  threshold_ = named(new QSlider(Qt::Horizontal), "threshold", "Lowest score of what the node reports");
  threshold_->setRange(0, percent);
  threshold_value_ = named(new QLabel("-"), "threshold_value");

  object_ = named(new QLineEdit, "object", "Name of the object to capture or to remove");
  object_->setPlaceholderText("name of an object");
  capture_ = named(new QPushButton("Capture"), "capture",
                   "Takes the one object that stands alone on the table as a training view");
  undo_ = named(new QPushButton("Undo"), "undo", "Takes the last captured view of the object back");
  missing_ = newLabel("missing", "Directions that the captured views do not show");
  train_ = named(new QPushButton("Train"), "train",
                 "Trains a new codebook from the captured views of all objects; it replaces the one in use");
  cancel_ = named(new QPushButton("Cancel"), "cancel", "Ends the training; the codebook in use stays");
  progress_ = named(new QProgressBar, "progress");
  progress_->setRange(0, percent);
  auto* training = new QGroupBox("Train objects");
  auto* training_layout = new QVBoxLayout(training);
  training_layout->addWidget(object_);
  training_layout->addLayout(row({capture_, undo_, train_, cancel_}));
  training_layout->addWidget(missing_);
  training_layout->addWidget(progress_);

  reply_ = newLabel("reply", "What the node replied last");
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(narrow_margin, narrow_margin, narrow_margin, narrow_margin);
  layout->addLayout(form);
  layout->addWidget(error_);
  layout->addWidget(objects_, 1);
  layout->addLayout(row({load_, save_, remove_}));
  layout->addLayout(row({new QLabel("Threshold"), threshold_, threshold_value_}));
  layout->addWidget(training);
  layout->addWidget(reply_);
}

}  // namespace sks_detector
