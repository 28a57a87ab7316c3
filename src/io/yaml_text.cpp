// SPDX-License-Identifier: BSD-3-Clause
#include "io/yaml_text.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include <yaml-cpp/eventhandler.h>

#include <sks_detector/error.hpp>

#include "core/settings/number_format.hpp"
#include "core/settings/utf8.hpp"

namespace sks {
namespace {

constexpr int deepest = 400;  // files of ours need 5, the library since 0.7 takes 500

[[noreturn]] void fail(const std::string& origin, int line, const std::string& reason) {
  throw Error(ErrorCode::bad_file, origin + ":" + std::to_string(line + 1) + ": " + reason);
}

int lineAt(const std::string& text, std::size_t place) {
  return int(std::count(text.begin(), text.begin() + std::ptrdiff_t(place), '\n'));
}

bool beginsWith(const std::string& text, const std::string& with) {
  return text.compare(0, with.size(), with) == 0;
}

/// The text without the mark that some editors put before UTF-8; other encodings are refused, since names of them would
/// reach messages and results.
std::string asUtf8(const std::string& text, const std::string& origin) {
  const std::size_t first_null = text.find('\0');
  if (beginsWith(text, "\xff\xfe") || beginsWith(text, "\xfe\xff") || first_null < 4) {
    fail(origin, 0,
         "the file is UTF-16 or UTF-32, not UTF-8: save it as UTF-8, or convert it by iconv -f UTF-16 -t UTF-8");
  }
  if (first_null != std::string::npos) fail(origin, lineAt(text, first_null), "not a text file: a null character");
  const std::size_t wrong = firstNoUtf8(text);
  if (wrong < text.size()) {
    fail(origin, lineAt(text, wrong),
         formatted("the byte 0x%02x is not UTF-8: save the file as UTF-8, or convert it by iconv -f LATIN1 -t UTF-8",
                   unsigned(static_cast<unsigned char>(text[wrong]))));
  }
  return beginsWith(text, "\xef\xbb\xbf") ? text.substr(3) : text;
}

/// The line of a tab that may be why YAML makes no sense at a line: one on it, else one that an earlier line begins
/// with; -1 where there is none.
int lineOfTab(const std::string& text, int at_line) {
  std::istringstream lines(text);
  int found = -1;
  std::string line;
  for (int number = 0; number <= at_line && std::getline(lines, line); ++number) {
    const std::size_t tab = line.find('\t');
    if (tab == std::string::npos) continue;
    if (number == at_line || line.find_first_not_of(" \t") > tab) found = number;
  }
  return found;
}

/// Refuses a second document, and aliases that stand for so much together that a small file would fill the memory.
class OneDocument : public YAML::EventHandler {
public:
  explicit OneDocument(const std::string& origin) : origin_(origin) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) fail(origin_, mark.line, "a second document in one file; keep one");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t anchor) override { add(anchor); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto known = sizes_.find(anchor);
    const std::size_t size = known == sizes_.end() ? 1 : known->second;  // 1: it is within itself
    if (aliased_ += size; aliased_ > most_aliased) {
      fail(origin_, mark.line,
           "the aliases (*name) up to here stand for more than " + std::to_string(most_aliased) +
               " values: write out what they stand for, or split the file");
    }
    nodes_ += size;
  }
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t anchor, const std::string&) override {
    add(anchor);
  }
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    begin(anchor);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t anchor, YAML::EmitterStyle::value) override {
    begin(anchor);
  }
  void OnMapEnd() override { end(); }

private:
  static constexpr std::size_t most_aliased = 1000000;

  void add(YAML::anchor_t anchor) {
    ++nodes_;
    if (anchor != YAML::NullAnchor) sizes_[anchor] = 1;
  }
  void begin(YAML::anchor_t anchor) { open_.emplace_back(anchor, nodes_++); }
  void end() {
    const auto [anchor, nodes_before] = open_.back();
    if (anchor != YAML::NullAnchor) sizes_[anchor] = nodes_ - nodes_before;
    open_.pop_back();
  }

  const std::string& origin_;
  int documents_ = 0;
  std::size_t nodes_ = 0, aliased_ = 0;  // with all that aliases stand for
  std::map<YAML::anchor_t, std::size_t> sizes_;
  std::vector<std::pair<YAML::anchor_t, std::size_t>> open_;  // and how many nodes there were before
};

/// An upper bound of the nesting: brackets that are open, whatever they stand in, and blocks that one line begins.
void checkNesting(const std::string& text, const std::string& origin) {
  int line = 0, open = 0, blocks = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i], next = i + 1 < text.size() ? text[i + 1] : '\n';
    if (c == '[' || c == '{') ++open;
    if (c == ']' || c == '}') open = std::max(0, open - 1);
    if ((c == '-' || c == '?') && (next == ' ' || next == '\t')) ++blocks;
    if (open + blocks > deepest) fail(origin, line, "not a YAML file: it is nested too deeply");
    if (c == '\n') {
      ++line;
      blocks = 0;
    }
  }
}

}  // namespace

YAML::Node parseYaml(const std::string& raw_text, const std::string& origin) {
  const std::string text = asUtf8(raw_text, origin);
  checkNesting(text, origin);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    OneDocument one(origin);
    while (parser.HandleNextDocument(one)) {
    }
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    const int tab = lineOfTab(text, error.mark.line);
    if (tab >= 0) fail(origin, tab, "a tab, which is no indentation in YAML: use spaces");
    fail(origin, std::max(0, error.mark.line), "not a YAML file: " + error.msg);
  }
}

}  // namespace sks
