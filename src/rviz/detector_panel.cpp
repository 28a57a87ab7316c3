// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/detector_panel.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSlider>
#include <QTableWidget>
#include <pluginlib/class_list_macros.hpp>

#include "rviz/panel_text.hpp"
#include "rviz/request_dialog.hpp"

namespace sks_detector {
namespace {

using Action = NodeClient::Action;

constexpr int stream_period = 500;    // [ms]
constexpr int threshold_delay = 200;  // [ms] for which a slider must rest
constexpr double slider_steps = 100;  // for a threshold of 1

QString shownText(const std::string& utf8) {
  return QString::fromStdString(utf8);
}

QString thresholdText(double threshold) {
  return QString::number(threshold, 'f', 2);
}

}  // namespace

DetectorPanel::DetectorPanel(QWidget* parent) : rviz::Panel(parent) {
  build();
  connectButtons();
  connectClient();
  clear();
  useNode();
  stream_timer_.start(stream_period);
}

void DetectorPanel::load(const rviz::Config& config) {
  rviz::Panel::load(config);
  QString node;
  if (!config.mapGetString("Node", &node)) return;
  node_->setText(node);
  useNode();
}

void DetectorPanel::save(rviz::Config config) const {
  rviz::Panel::save(config);
  config.mapSetValue("Node", node_->text());
}

void DetectorPanel::connectButtons() {
  connect(node_, &QLineEdit::editingFinished, this, [this] {
    if (node_->text() == used_node_) return;
    useNode();
    Q_EMIT configChanged();
  });
  connect(objects_, &QTableWidget::cellClicked, this,
          [this](int row, int) { object_->setText(objects_->item(row, 0)->text()); });
  connect(capture_, &QPushButton::clicked, this, [this] {
    if (!objectGiven()) return;
    showReply(true, "Waiting for the next cloud ...");
    client_.captureView(objectName());
  });
  connect(undo_, &QPushButton::clicked, this, [this] {
    if (objectGiven()) client_.undoCapture(objectName());
  });
  connect(train_, &QPushButton::clicked, this, [this] { client_.trainCaptured(); });
  connect(cancel_, &QPushButton::clicked, this, [this] { client_.cancelTraining(); });
  connect(load_, &QPushButton::clicked, this, &DetectorPanel::askToLoad);
  connect(save_, &QPushButton::clicked, this, &DetectorPanel::askToSave);
  connect(remove_, &QPushButton::clicked, this, &DetectorPanel::askToRemove);
  threshold_timer_.setSingleShot(true);
  connect(threshold_, &QSlider::valueChanged, this, [this](int value) {
    threshold_value_->setText(thresholdText(value / slider_steps));
    threshold_timer_.start(threshold_delay);
  });
  connect(&threshold_timer_, &QTimer::timeout, this, [this] {
    if (client_.isBusy(Action::threshold)) {
      threshold_timer_.start(threshold_delay);  // the newest value is not to be lost
    } else {
      client_.setThreshold(threshold_->value() / slider_steps);
    }
  });
}

void DetectorPanel::connectClient() {
  connect(&client_, &NodeClient::reached, this, [this](const QString& problem) {
    answers_ = problem.isEmpty();
    if (answers_) {
      showState();
    } else {
      state_->setText(problem);
    }
    enableButtons();
  });
  connect(&client_, &NodeClient::statusReceived, this, &DetectorPanel::showStatus);
  connect(&client_, &NodeClient::infoReceived, this, &DetectorPanel::showInfo);
  connect(&client_, &NodeClient::captured, this, &DetectorPanel::showCaptured);
  connect(&client_, &NodeClient::viewsTaken, this, [this](const QString& object) {
    captured_.erase(object.toStdString());  // how many are left is not known
    missing_->clear();
    fillTable();
  });
  connect(&client_, &NodeClient::replied, this, &DetectorPanel::showReply);
  connect(&client_, &NodeClient::thresholdReceived, this, &DetectorPanel::showThreshold);
  connect(&client_, &NodeClient::busyChanged, this, &DetectorPanel::enableButtons);
  connect(&stream_timer_, &QTimer::timeout, this, &DetectorPanel::showStream);
}

void DetectorPanel::useNode() {
  used_node_ = node_->text();
  threshold_timer_.stop();
  clear();
  client_.setNode(used_node_.trimmed().toStdString());
}

void DetectorPanel::clear() {
  answers_ = has_status_ = false;
  status_ = Status();
  info_ = InfoResponse();
  captured_.clear();
  for (QLabel* label : {error_, stream_, codebook_, missing_, reply_}) label->clear();
  threshold_value_->setText("-");
  fillTable();
  enableButtons();
  progress_->reset();
}

void DetectorPanel::showState() {
  const std::string state = has_status_ ? describeState(status_) : "it answers, but nothing came on its ~status yet";
  const std::string& node = client_.node();
  const bool same_name = used_node_.trimmed().toStdString() == node;
  state_->setText(shownText(same_name ? state : state + " (" + node + ")"));
}

void DetectorPanel::showStatus(const Status& status) {
  const bool other_objects = status.objects != status_.objects || status.captured != status_.captured;
  status_ = status;
  has_status_ = true;
  if (answers_) showState();
  error_->setText(shownText(status.last_error));
  error_->setVisible(!status.last_error.empty());
  if (status.progress.empty()) {
    progress_->reset();
  } else {
    const float fraction = std::isfinite(status.progress_fraction) ? status.progress_fraction : 0;
    progress_->setValue(int(100 * std::min(std::max(fraction, 0.0F), 1.0F)));
  }
  progress_->setFormat(shownText(status.progress).replace("%", "%%") + " %p%");
  progress_->setToolTip(shownText(status.progress));
  if (other_objects) fillTable();
  enableButtons();
}

void DetectorPanel::showInfo(const InfoResponse& info) {
  const bool other_objects = info.objects != info_.objects || info.views != info_.views;
  info_ = info;
  codebook_->setText(shownText(describeCodebook(info)));
  if (other_objects) fillTable();
}

void DetectorPanel::showCaptured(const QString& object, const CaptureViewResponse& response) {
  captured_[object.toStdString()] = describeCaptured(response);
  missing_->setText(response.missing.empty() ? QString() : "Missing: " + shownText(response.missing));
  fillTable();
}

void DetectorPanel::showReply(bool success, const QString& message) {
  reply_->setStyleSheet(success ? "" : "color: #c01010");
  reply_->setText(message);
}

void DetectorPanel::showThreshold(double threshold) {
  if (threshold_->isSliderDown() || threshold_timer_.isActive()) return;  // the user is about to change it
  const QSignalBlocker blocker(threshold_);
  threshold_->setValue(int(std::lround(slider_steps * std::min(std::max(threshold, 0.0), 1.0))));
  threshold_value_->setText(thresholdText(threshold));
}

void DetectorPanel::showStream() {
  stream_->setText(answers_ ? shownText(client_.stream().describe(StreamWatch::Clock::now())) : QString());
}

void DetectorPanel::fillTable() {
  std::vector<std::string> names = info_.objects;
  std::set<std::string> listed(names.begin(), names.end());
  const auto add = [&](const std::string& name) {
    if (listed.insert(name).second) names.push_back(name);
  };
  const std::set<std::string> untrained(status_.captured.begin(), status_.captured.end());
  for (const std::string& name : untrained) add(name);
  for (const auto& [name, views] : captured_) add(name);
  objects_->setRowCount(int(names.size()));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto known = captured_.find(names[i]);
    const std::string captured = known != captured_.end()        ? known->second
                                 : untrained.count(names[i]) > 0 ? "not trained yet"
                                                                 : "";
    const QString views = i < info_.views.size() ? QString::number(info_.views[i]) : QString();
    const QString cells[] = {shownText(names[i]), views, shownText(captured)};
    for (int column = 0; column < 3; ++column) {
      objects_->setItem(int(i), column, new QTableWidgetItem(cells[column]));
      objects_->item(int(i), column)->setToolTip(cells[column]);
    }
  }
}

void DetectorPanel::enableButtons() {
  const bool training = status_.state == Status::TRAINING && answers_;
  const bool node = !client_.node().empty();
  capture_->setEnabled(node && !client_.isBusy(Action::capture));
  undo_->setEnabled(node && !client_.isBusy(Action::undo));
  train_->setEnabled(node && !training && !client_.isBusy(Action::train));
  cancel_->setEnabled(node && (training || client_.isBusy(Action::train)) && !client_.isBusy(Action::cancel));
  load_->setEnabled(node && !client_.isBusy(Action::load));
  save_->setEnabled(node && !client_.isBusy(Action::save));
  remove_->setEnabled(node && !client_.isBusy(Action::remove));
  threshold_->setEnabled(answers_);
}

std::string DetectorPanel::objectName() const {
  return object_->text().trimmed().toStdString();
}

bool DetectorPanel::objectGiven() {
  const bool given = !objectName().empty();
  if (!given) showReply(false, "Give the name of an object first");
  return given;
}

void DetectorPanel::askToLoad() {
  askForRequest(this, {"Load a codebook", "File *.sks in the node's ~codebook_directory, or absolute:", "", ""},
                [this](const QString& path, bool) { client_.loadCodebook(path.toStdString()); });
}

void DetectorPanel::askToSave() {
  askForRequest(this,
                {"Save the codebook", "File *.sks in the node's ~codebook_directory, or absolute:",
                 shownText(info_.codebook_file), "Replace an existing file"},
                [this](const QString& path, bool replace) { client_.saveCodebook(path.toStdString(), replace); });
}

void DetectorPanel::askToRemove() {
  askForRequest(this,
                {"Remove an object", "Object to take out of the codebook in use:", object_->text(),
                 "Also delete its captured views"},
                [this](const QString& object, bool views) { client_.removeObject(object.toStdString(), views); });
}

}  // namespace sks_detector

PLUGINLIB_EXPORT_CLASS(sks_detector::DetectorPanel, rviz::Panel)
