// SPDX-License-Identifier: BSD-3-Clause
#include "core/pipeline/codebook_merge.hpp"

#include <map>

#include <sks_detector/error.hpp>

#include "core/descriptors/quantizer.hpp"
#include "core/matching/background_words.hpp"
#include "core/pipeline/default_stages.hpp"
#include "core/settings/shown_text.hpp"

namespace sks {
namespace {

std::string quotedLabel(const CodebookPart& part) {
  return "'" + shown(part.label) + "'";
}

void checkSettings(const CodebookPart& first, const CodebookPart& part) {
  std::string differences;
  for (const SettingInfo& info : settingInfos()) {
    if (info.key == "threads") continue;  // changes no codebook
    const std::string known = getSetting(first.codebook->settings, info.key);
    const std::string value = getSetting(part.codebook->settings, info.key);
    if (value != known)
      differences += (differences.empty() ? "" : ", ") + info.key + " = " + value + " (not " + known + ")";
  }
  if (differences.empty()) return;
  throw Error(ErrorCode::incompatible, quotedLabel(part) + " was trained with " + differences + " unlike " +
                                           quotedLabel(first) + ": train both with the same values");
}

void checkDescriptors(const CodebookPart& first, const CodebookPart& part) {
  const auto described = [](const Codebook& codebook) {
    return "'" + codebook.descriptorName() + "' of " + std::to_string(codebook.descriptorSize()) + " values";
  };
  const Codebook &known = *first.codebook, &codebook = *part.codebook;
  const bool both_have = !known.words.empty() && !codebook.words.empty();
  if (known.descriptorName() == codebook.descriptorName() &&
      (!both_have || known.descriptorSize() == codebook.descriptorSize())) {
    return;
  }
  throw Error(ErrorCode::incompatible, quotedLabel(part) + " holds descriptors " + described(codebook) + ", not " +
                                           described(known) + " like " + quotedLabel(first) +
                                           ": train both with the same descriptor stage");
}

/// An object of one name in two parts may be two things, or views of one that were not registered to each other.
void checkNames(const std::vector<CodebookPart>& parts) {
  std::map<std::string, const CodebookPart*> known;
  for (const CodebookPart& part : parts) {
    std::vector<std::string> twice;
    const CodebookPart* other = nullptr;
    for (const std::string& object : part.codebook->objects) {
      const auto [entry, is_new] = known.emplace(object, &part);
      if (is_new || (other != nullptr && entry->second != other)) continue;
      other = entry->second;
      twice.push_back("'" + shown(object, 60) + "'");
    }
    if (other == nullptr) continue;
    throw Error(ErrorCode::incompatible, quotedLabel(*other) + " and " + quotedLabel(part) + " both hold " +
                                             shownList(twice) + ": train under other names, or all views in one run");
  }
}

void append(const Codebook& part, Codebook& all, Quantizer& rows) {
  const auto first_object = std::uint32_t(all.objects.size()), first_view = std::uint32_t(all.views.size());
  all.objects.insert(all.objects.end(), part.objects.begin(), part.objects.end());
  for (const TrainingView& view : part.views) {
    all.views.push_back(view);
    all.views.back().object += first_object;
  }
  for (const RegisteredModel& model : part.models) {
    all.models.push_back(model);
    all.models.back().object += first_object;
  }
  for (std::size_t i = 0; i < part.words.size(); ++i) {
    all.words.push_back(part.words[i]);
    all.words.back().view += first_view;
    rows.add(part.descriptors, i);
  }
}

/// Earlier versions of the file hold none.
QuantizedDescriptors backgroundOf(const std::vector<CodebookPart>& parts, const Codebook& all) {
  if (!hasBackground(all, all.settings)) return {};
  for (const CodebookPart& part : parts) {
    if (part.codebook->background.rows() > 0) return part.codebook->background;
  }
  return backgroundDescriptors(all.settings);
}

}  // namespace

Codebook mergedCodebook(const std::vector<CodebookPart>& parts, const std::string& name) {
  const Codebook& first = *parts.front().codebook;
  for (const CodebookPart& part : parts) {
    checkDescriptors(parts.front(), part);
    checkSettings(parts.front(), part);
  }
  checkNames(parts);

  Codebook all;
  all.name = name;
  all.descriptor_type = first.descriptor_type;
  all.own_descriptor = first.own_descriptor;
  all.settings = first.settings;
  std::size_t views = 0, words = 0, columns = 0;
  for (const CodebookPart& part : parts) {
    views += part.codebook->views.size();
    words += part.codebook->words.size();
    if (!part.codebook->words.empty()) columns = part.codebook->descriptors.cols();
  }
  all.views.reserve(views);
  all.words.reserve(words);
  Quantizer rows(columns);
  for (const CodebookPart& part : parts) append(*part.codebook, all, rows);
  all.descriptors = rows.release();
  all.background = backgroundOf(parts, all);
  return all;
}

}  // namespace sks
