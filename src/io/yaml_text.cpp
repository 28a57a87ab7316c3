// SPDX-License-Identifier: BSD-3-Clause
#include "io/yaml_text.hpp"

#include <algorithm>
#include <sstream>

#include <yaml-cpp/eventhandler.h>

#include <sks_detector/error.hpp>

namespace sks {
namespace {

constexpr int deepest = 400;  // files of ours need 5, the library since 0.7 takes 500

[[noreturn]] void fail(const std::string& origin, int line, const std::string& reason) {
  throw Error(ErrorCode::bad_file, origin + ":" + std::to_string(line + 1) + ": " + reason);
}

/// Refuses a second document.
class OneDocument : public YAML::EventHandler {
public:
  explicit OneDocument(const std::string& origin) : origin_(origin) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) fail(origin_, mark.line, "a second document in one file; keep one");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}

private:
  const std::string& origin_;
  int documents_ = 0;
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

YAML::Node parseYaml(const std::string& text, const std::string& origin) {
  checkNesting(text, origin);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    OneDocument one(origin);
    while (parser.HandleNextDocument(one)) {
    }
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    fail(origin, error.mark.line, "not a YAML file: " + error.msg);
  }
}

}  // namespace sks
