// SPDX-License-Identifier: BSD-3-Clause
#include "tools/classification_report.hpp"

#include "evaluation/evaluation.hpp"
#include "tools/detection_json.hpp"
#include "tools/settings_json.hpp"
#include "tools/table.hpp"

namespace sks::tools {
namespace {

using nlohmann::json;

json hitsJson(const HitCount& hits) {
  return {
      {"tests", hits.tests}, {"correct", hits.correct}, {"accuracy", hits.tests == 0 ? json() : json(hits.accuracy())}};
}

json testJson(const ClassificationTest& test) {
  json candidates = json::array();
  for (const Classification::Candidate& candidate : test.result.candidates) {
    candidates.push_back({{"object", candidate.object}, {"score", candidate.score}});
  }
  return {{"cloud", test.entry.path},
          {"object", test.entry.object},
          {"answer", test.result.candidates.empty() ? json() : json(test.result.object())},
          {"correct", test.correct()},
          {"candidates", candidates},
          {"time_ms", timesJson(test.result.times)},
          {"counts", countsJson(test.result.counts)}};
}

/// Mean of each stage over the tests, `total` first [ms].
std::vector<std::pair<std::string, double>> meanTimes(const ClassificationEvaluation& evaluation) {
  auto means = namedTimes(StageTimes());
  for (const ClassificationTest& test : evaluation.tests) {
    const auto times = namedTimes(test.result.times);
    for (std::size_t i = 0; i < means.size(); ++i) {
      means[i].second += 1000 * times[i].second / double(evaluation.tests.size());
    }
  }
  return means;
}

std::string objectTable(const ClassificationEvaluation& evaluation) {
  Table table({"<object", "tests", "correct", "accuracy"});
  const auto add = [&](const std::string& name, const HitCount& hits) {
    table.add({name, std::to_string(hits.tests), std::to_string(hits.correct),
               hits.tests == 0 ? "-" : fixed(hits.accuracy(), 3)});
  };
  for (std::size_t i = 0; i < evaluation.objects.size(); ++i) add(evaluation.objects[i], evaluation.per_object[i]);
  add("all", evaluation.total);
  return table.text();
}

/// Rows are the truth, columns the answers, numbered like the rows.
std::string confusionTable(const ClassificationEvaluation& evaluation) {
  std::vector<std::string> header{"<true \\ answer"};
  const std::size_t count = evaluation.objects.size();
  for (std::size_t i = 0; i < count; ++i) header.push_back(std::to_string(i + 1));
  header.emplace_back("none");
  Table table(header);
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<std::string> row{std::to_string(i + 1) + " " + evaluation.objects[i]};
    std::vector<std::size_t> cells = evaluation.confusion[i];
    cells.push_back(evaluation.unanswered[i]);
    for (const std::size_t cell : cells) row.push_back(cell == 0 ? "." : std::to_string(cell));
    table.add(row);
  }
  return table.text();
}

}  // namespace

json classificationJson(const ClassificationEvaluation& evaluation) {
  json result = hitsJson(evaluation.total);
  result["dataset"] = evaluation.data_set;
  result["method"] = evaluation.method;
  result["objects"] = evaluation.objects;
  result["confusion"] = evaluation.confusion;
  result["unanswered"] = evaluation.unanswered;
  result["settings"] = settingsJson(evaluation.settings);
  result["settings"].erase("threads");  // changes nothing but the times
  result["per_object"] = json::object();
  for (std::size_t i = 0; i < evaluation.objects.size(); ++i) {
    result["per_object"][evaluation.objects[i]] = hitsJson(evaluation.per_object[i]);
  }
  result["per_test"] = json::array();
  for (const ClassificationTest& test : evaluation.tests) result["per_test"].push_back(testJson(test));
  for (const auto& [stage, mean] : meanTimes(evaluation)) result["time_ms"][stage] = {{"mean", mean}};
  return result;
}

std::string classificationTable(const ClassificationEvaluation& evaluation) {
  std::string times = "mean times [ms]:";
  for (const auto& [stage, mean] : meanTimes(evaluation)) times += " " + stage + " " + fixed(mean, 1);
  return evaluation.data_set + ", " + evaluation.method + ": accuracy " + fixed(evaluation.total.accuracy(), 3) + " (" +
         std::to_string(evaluation.total.correct) + " of " + std::to_string(evaluation.total.tests) + ")\n\n" +
         objectTable(evaluation) + "\n" + confusionTable(evaluation) + "\n" + times + "\n";
}

}  // namespace sks::tools
