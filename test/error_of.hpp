// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <gtest/gtest.h>

#include <sks_detector/error.hpp>

namespace sks::test {

/// What the sks::Error of `action` says; fails the test if there is none, or if its code is another one.
template <typename Action>
std::string errorOf(ErrorCode code, Action action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(int(error.code()), int(code)) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

}  // namespace sks::test
