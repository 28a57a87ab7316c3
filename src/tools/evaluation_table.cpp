// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluation_table.hpp"

#include <limits>
#include <map>

#include "tools/table.hpp"

namespace sks::tools {
namespace {

std::string number(const std::optional<double>& value, int decimals) {
  return fixed(value.value_or(std::numeric_limits<double>::quiet_NaN()), decimals);
}

std::string median(const std::optional<Quantiles>& quantiles, double scale, int decimals) {
  return number(quantiles ? std::optional<double>(scale * quantiles->median) : std::nullopt, decimals);
}

std::vector<std::string> tallyCells(const Tally& tally) {
  return {std::to_string(tally.true_positives), std::to_string(tally.false_positives), number(tally.precision(), 3),
          number(tally.recall(), 3), number(tally.f1(), 3)};
}

std::vector<std::string> scoreRow(const std::string& name, const Score& score) {
  std::vector<std::string> row{name, std::to_string(score.tally.ground_truth)};
  for (const std::string& cell : tallyCells(score.tally)) row.push_back(cell);
  row.push_back(number(score.average_precision, 3));
  row.push_back(std::to_string(score.pose.count));
  row.push_back(median(score.pose.translation, 1000, 1));
  row.push_back(median(score.pose.rotation, 1, 1));
  row.push_back(median(score.pose.t_diff, 1, 3));
  return row;
}

std::string objectTable(const Evaluation& evaluation) {
  Table table(
      {"<object", "true", "TP", "FP", "precision", "recall", "F1", "AP", "poses", "t [mm]", "R [deg]", "T_diff"});
  for (const auto& [object, score] : evaluation.objects) table.add(scoreRow(object, score));
  table.add(scoreRow("all", evaluation.total));
  return table.text();
}

std::vector<std::string> bopRow(const std::string& name, const BopRecall& recall) {
  return {name,
          std::to_string(recall.targets),
          number(recall.vsd, 3),
          number(recall.mssd, 3),
          number(recall.mspd, 3),
          number(recall.ar, 3)};
}

/// Average recalls, and why some are missing: objects with the same reason in one line.
std::string bopTable(const BopScores& scores) {
  std::string text;
  if (scores.total.vsd || scores.total.mssd || scores.total.mspd) {
    Table table({"<object", "targets", "AR_VSD", "AR_MSSD", "AR_MSPD", "AR"});
    for (const auto& [object, recall] : scores.objects) table.add(bopRow(object, recall));
    table.add(bopRow("all", scores.total));
    text = table.text();
  }
  std::map<std::string, std::string> objects;
  for (const auto& [object, reason] : scores.shortcomings)
    objects[reason] += (objects[reason].empty() ? "" : ", ") + object;
  for (const auto& [reason, names] : objects) text += "BOP errors not available for " + names + ": " + reason + "\n";
  return text.empty() ? text : "\n" + text;
}

std::vector<std::string> sweepRow(const CurvePoint& point, int decimals) {
  std::vector<std::string> row{fixed(point.threshold, decimals)};
  for (const std::string& cell : tallyCells(point.tally)) row.push_back(cell);
  return row;
}

std::string sweepTable(const Evaluation& evaluation) {
  const std::vector<RankedDetection>& ranking = evaluation.total.ranking;
  const std::size_t ground_truth = evaluation.total.tally.ground_truth;
  Table table({"threshold", "TP", "FP", "precision", "recall", "F1"});
  for (const CurvePoint& point : thresholdSweep(ranking, ground_truth)) table.add(sweepRow(point, 2));
  std::string text = table.text();
  if (const auto best = bestPoint(precisionRecallCurve(ranking, ground_truth))) {
    text += "highest F1 " + number(best->tally.f1(), 3) + " at " + fixed(best->threshold, 4) +
            " (chosen on these scenes: a bound, no result)\n";
  }
  return text;
}

std::string timeTable(const Evaluation& evaluation) {
  Table table({"<stage", "mean [ms]", "p50 [ms]", "p95 [ms]"});
  for (const auto& [stage, time] : evaluation.times) {
    table.add({stage, fixed(time.mean, 1), fixed(time.p50, 1), fixed(time.p95, 1)});
  }
  return table.text();
}

}  // namespace

std::string recordedTable(const Evaluation& evaluation) {
  return evaluation.data_set + ", " + evaluation.method + ": " + std::to_string(evaluation.scenes.size()) +
         " scenes, threshold " + fixed(evaluation.threshold, 3) + ", within " +
         fixed(1000 * evaluation.max_distance, 0) + " mm; pose errors are medians\n\n" + objectTable(evaluation) +
         (evaluation.bop ? bopTable(*evaluation.bop) : "") + "\n" + sweepTable(evaluation) + "\n" +
         timeTable(evaluation);
}

std::string evaluationTable(const Evaluation& evaluation) {
  return recordedTable(evaluation) + "peak memory " + fixed(evaluation.peak_memory_mb, 0) + " MiB\n";
}

}  // namespace sks::tools
