// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <sks_detector/cloud.hpp>
#include <sks_detector/progress.hpp>
#include <sks_detector/settings.hpp>

#include "core/pipeline/classifier.hpp"
#include "core/sharing/work_share.hpp"
#include "io/dataset.hpp"

namespace sks {

/// One test and what it was taken for.
struct ClassificationTest {
  TestEntry entry;
  Classification result;

  bool correct() const { return result.object() == entry.object; }
};

/// Tests and hits of one object, or of all.
struct HitCount {
  std::size_t tests = 0;
  std::size_t correct = 0;

  double accuracy() const { return tests == 0 ? 0 : double(correct) / double(tests); }
};

/// The outcome of a classification set.
struct ClassificationEvaluation {
  std::string data_set;  ///< name
  std::string method;    ///< name
  Settings settings;
  std::vector<ClassificationTest> tests;  ///< in the order of the data set
  HitCount total;
  std::vector<std::string> objects;                 ///< of tests and answers, in order of their names
  std::vector<HitCount> per_object;                 ///< of each of `objects`
  std::vector<std::vector<std::size_t>> confusion;  ///< [true][answer], both as in `objects`
  std::vector<std::size_t> unanswered;              ///< tests of each object without any hypothesis
};

/// Classifies every test of a data set.
/// @param method name that stands in the result @param settings that `classify` works with
/// @param share where given, its processes classify; only the leader's result is whole
/// @throws Error(bad_data) for a data set without tests; any error of reading or classifying, with the cloud's file;
///         Error(cancelled)
ClassificationEvaluation evaluateTests(const DataSet& data_set, const ClassifyFunction& classify,
                                       const std::string& method, const Settings& settings,
                                       const Progress& progress = {}, WorkShare* share = nullptr);

}  // namespace sks
