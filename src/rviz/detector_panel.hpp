// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

#include <QTimer>

#include <sks_detector/Info.h>
#include <sks_detector/Status.h>
#ifndef Q_MOC_RUN
#include <rviz/panel.h>

#include "rviz/node_client.hpp"
#endif

class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QSlider;
class QTableWidget;

namespace sks_detector {

/// rviz panel of a detector node: what it does, its codebook, and buttons to capture views, train, load, save and
/// remove. Nothing that is asked of the node is waited for; the last line says what it replied. The parts have object
/// names, such as `capture` or `reply`.
class DetectorPanel : public rviz::Panel {
  Q_OBJECT
public:
  explicit DetectorPanel(QWidget* parent = nullptr);

  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

private:
  void build();
  void connectButtons();
  void connectClient();

  void useNode();
  void showState();
  void showStatus(const Status& status);
  void showInfo(const InfoResponse& info);
  void showCaptured(const QString& object, const CaptureViewResponse& response);
  void showReply(bool success, const QString& message);
  void showThreshold(double threshold);
  void showStream();
  void fillTable();
  void enableButtons();
  void clear();
  /// The object that the buttons are for.
  std::string objectName() const;
  /// Says so where none is given.
  bool objectGiven();
  void askToLoad();
  void askToSave();
  void askToRemove();

  QLineEdit* node_ = nullptr;
  QLabel* state_ = nullptr;
  QLabel* error_ = nullptr;
  QLabel* stream_ = nullptr;
  QLabel* codebook_ = nullptr;
  QTableWidget* objects_ = nullptr;
  QSlider* threshold_ = nullptr;
  QLabel* threshold_value_ = nullptr;
  QLineEdit* object_ = nullptr;
  QLabel* missing_ = nullptr;
  QProgressBar* progress_ = nullptr;
  QLabel* reply_ = nullptr;
  QPushButton* load_ = nullptr;
  QPushButton* save_ = nullptr;
  QPushButton* remove_ = nullptr;
  QPushButton* capture_ = nullptr;
  QPushButton* undo_ = nullptr;
  QPushButton* train_ = nullptr;
  QPushButton* cancel_ = nullptr;

  QString used_node_;        // as it was given
  bool answers_ = false;     // the node
  bool has_status_ = false;  // of it
  Status status_;
  InfoResponse info_;
  std::map<std::string, std::string> captured_;  // what is known of objects' captured views
  QTimer stream_timer_;
  QTimer threshold_timer_;
  NodeClient client_;  // the last member: what it reports is of use to nobody else
};

}  // namespace sks_detector
