// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <set>
#include <string>

#include <QObject>
#include <QTimer>

#include <sks_detector/CaptureView.h>
#include <sks_detector/Info.h>
#include <sks_detector/Status.h>
#ifndef Q_MOC_RUN
#include "rviz/async_calls.hpp"
#include "rviz/stream_watch.hpp"
#endif

namespace sks_detector {

struct NodeTopics;

/// A detector node as the panel sees it: its topics, and its services, which are called without waiting for them. To be
/// used in one thread, that of the window, in which all signals are emitted.
class NodeClient : public QObject {
  Q_OBJECT
public:
  /// What the panel can ask for; one of a kind at a time.
  enum class Action { capture, undo, train, cancel, load, save, remove, threshold };

  NodeClient();
  ~NodeClient() override;

  /// Another node: its name as in a launch file, remapped as any name. What still runs at the old one is not reported.
  void setNode(const std::string& name);
  /// The full name, e.g. "/detector"; empty where the name that was set is none.
  const std::string& node() const { return node_; }

  bool isBusy(Action action) const { return busy_.count(action) > 0; }
  /// Clouds and latencies of the last seconds.
  StreamWatch& stream() { return stream_; }

  void captureView(const std::string& object);
  void undoCapture(const std::string& object);
  void trainCaptured();
  void cancelTraining();
  void loadCodebook(const std::string& path);
  void saveCodebook(const std::string& path, bool overwrite);
  void removeObject(const std::string& object, bool delete_views);
  /// Lowest score of a detection, in [0, 1]: the parameter detection.threshold.
  void setThreshold(double threshold);

Q_SIGNALS:
  /// Whether the node answers; @param problem says what is wrong, empty: nothing
  void reached(const QString& problem);
  void statusReceived(const sks_detector::Status& status);
  void infoReceived(const sks_detector::InfoResponse& info);
  void thresholdReceived(double threshold);
  void captured(const QString& object, const sks_detector::CaptureViewResponse& response);
  /// Captured views of an object were deleted.
  void viewsTaken(const QString& object);
  /// What the node replied to an action, or why there is no reply.
  void replied(bool success, const QString& message);
  void busyChanged();

private:
  void connectTopics();
  void useTopics(const std::shared_ptr<NodeTopics>& topics);
  void releaseTopics();
  void askInfo();

  /// @param then gets the reply of an action that succeeded
  template <typename Service, typename Then>
  void ask(Action action, const std::string& service, const typename Service::Request& request,
           std::chrono::milliseconds bound, Then then);
  void end(Action action, bool success, const std::string& message);
  std::string nameOf(const std::string& resource) const { return node_ + "/" + resource; }

  std::string node_;
  std::set<Action> busy_;
  StreamWatch stream_;
  std::shared_ptr<NodeTopics> topics_;
  QTimer receive_timer_;
  QTimer info_timer_;
  AsyncCalls calls_;  // the last member: it ends first
};

}  // namespace sks_detector
