// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/classification.hpp"

#include <algorithm>
#include <set>

#include <sks_detector/cloud_io.hpp>
#include <sks_detector/error.hpp>

#include "evaluation/result_fields.hpp"

namespace sks {
namespace {

Classification classifyTest(const TestEntry& entry, double scale, const ClassifyFunction& classify) {
  try {
    return classify(readCloud(entry.path, scale));
  } catch (const Error& error) {
    const bool named = std::string(error.what()).find(entry.path) != std::string::npos;
    throw Error(error.code(), (named ? "" : entry.path + ": ") + error.what());
  }
}

/// Counts hits and confusions.
void score(ClassificationEvaluation& evaluation) {
  std::set<std::string> names;
  for (const ClassificationTest& test : evaluation.tests) {
    names.insert(test.entry.object);
    if (!test.result.candidates.empty()) names.insert(test.result.object());
  }
  evaluation.objects.assign(names.begin(), names.end());
  const std::size_t count = names.size();
  evaluation.per_object.resize(count);
  evaluation.unanswered.assign(count, 0);
  evaluation.confusion.assign(count, std::vector<std::size_t>(count, 0));
  const auto indexOf = [&](const std::string& name) { return std::distance(names.begin(), names.find(name)); };
  for (const ClassificationTest& test : evaluation.tests) {
    const std::size_t truth = std::size_t(indexOf(test.entry.object));
    for (HitCount* hits : {&evaluation.total, &evaluation.per_object[truth]}) {
      ++hits->tests;
      hits->correct += test.correct() ? 1 : 0;
    }
    if (test.result.candidates.empty()) {
      ++evaluation.unanswered[truth];
    } else {
      ++evaluation.confusion[truth][std::size_t(indexOf(test.result.object()))];
    }
  }
}

}  // namespace

ClassificationEvaluation evaluateTests(const DataSet& data_set, const ClassifyFunction& classify,
                                       const std::string& method, const Settings& settings, const Progress& progress,
                                       WorkShare* share) {
  const std::size_t count = data_set.tests.size();
  if (count == 0) {
    throw Error(ErrorCode::bad_data, "'" + data_set.file +
                                         "' has nothing to classify; list isolated objects under "
                                         "'tests', each with 'object' and 'cloud'");
  }
  ClassificationEvaluation evaluation;
  evaluation.data_set = data_set.name;
  evaluation.method = method;
  evaluation.settings = settings;
  const std::vector<TestEntry>& tests = data_set.tests;
  dealOut<Classification>(
      share, count, [&](std::size_t i) { return classifyTest(tests[i], data_set.scale, classify); },
      [&](std::size_t i, Classification result) {
        evaluation.tests.push_back({tests[i], std::move(result)});
      },
      [&](std::size_t done) {
        report(progress, {"classifying", done < count ? tests[done].path : "", done, count});
      });
  report(progress, {"classifying", "", count, count});
  score(evaluation);
  return evaluation;
}

}  // namespace sks
