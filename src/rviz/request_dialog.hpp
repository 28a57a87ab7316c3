// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include <QDialog>

class QWidget;

namespace sks_detector {

/// What a request still needs before it is sent.
struct RequestQuestion {
  QString title;
  QString label;   ///< of the line of text
  QString text;    ///< that stands there at first
  QString option;  ///< of the box to tick; empty: there is none
};

/// Asks for a line of text and, where there is one, whether an option is wanted. Does not wait for the answer: the
/// dialog goes with its parent, or when it is closed. Parts: `text`, `option`, `buttons`.
/// @param send gets the answer where it is accepted with a text that is not empty
void askForRequest(QWidget* parent, const RequestQuestion& question,
                   const std::function<void(const QString& text, bool option)>& send);

}  // namespace sks_detector
