// SPDX-License-Identifier: BSD-3-Clause
#include "tools/progress_bar.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>

#include <sys/ioctl.h>
#include <unistd.h>

#include "core/settings/number_format.hpp"
#include "core/settings/shown_text.hpp"
#include "tools/cluster/cluster.hpp"

namespace sks::tools {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void interrupt(int) {
  interrupted = 1;
}

std::size_t terminalWidth() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string duration(double seconds) {
  if (seconds < 120) return formatted("%.0f s", seconds);
  return seconds < 7200 ? formatted("%.0f min", seconds / 60) : formatted("%.1f h", seconds / 3600);
}

}  // namespace

void cancelOnInterrupt() {
  struct sigaction action {};
  action.sa_handler = interrupt;
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

ProgressBar::ProgressBar() : terminal_(leads() && ::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  clear();
}

Progress ProgressBar::callback() {
  return [this](const ProgressState& state) {
    if (terminal_) show(state);
    return !interrupted;
  };
}

void ProgressBar::clear() {
  if (shown_) std::fputs("\r\033[K", stderr);
  shown_ = false;
}

void ProgressBar::show(const ProgressState& state) {
  const Clock::time_point now = Clock::now();
  if (state.stage != stage_) {
    stage_ = state.stage;
    start_ = now;
  } else if (now - last_ < std::chrono::milliseconds(100)) {
    return;
  }
  last_ = now;
  shown_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::fprintf(stderr, "\r\033[K%s", progressLine(state, seconds, terminalWidth() - 1).c_str());
  std::fflush(stderr);
}

std::string progressLine(const ProgressState& state, double seconds, std::size_t width) {
  std::string line = state.stage + "  " + std::to_string(state.done);
  if (state.total > 0) {
    const std::size_t cells = 20, full = cells * std::min(state.done, state.total) / state.total;
    line += "/" + std::to_string(state.total) + " [" + std::string(full, '#') + std::string(cells - full, '-') + "]";
  }
  if (state.done > 0 && seconds > 0) {
    line += formatted(" %.3g/s", double(state.done) / seconds);
    if (state.total > state.done)
      line += ", " + duration(seconds * double(state.total - state.done) / double(state.done)) + " left";
  }
  return (line + "  " + shown(state.item)).substr(0, width);
}

}  // namespace sks::tools
