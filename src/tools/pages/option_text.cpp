// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pages/option_text.hpp"

#include <sstream>

namespace sks::tools {
namespace {

void add(const CLI::App& command, const std::string& words, std::vector<CommandEntry>& entries) {
  entries.push_back({words, &command});
  for (const CLI::App* sub : subcommandsOf(command)) {
    add(*sub, words + (words.empty() ? "" : " ") + sub->get_name(), entries);
  }
}

}  // namespace

std::vector<CommandEntry> commandsOf(const CLI::App& app) {
  std::vector<CommandEntry> entries;
  add(app, "", entries);
  return entries;
}

std::vector<const CLI::App*> subcommandsOf(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> namesOf(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  return names;
}

std::string valueName(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) return "";
  const std::string name = option.get_type_name();
  return name.substr(0, name.find(':'));
}

std::vector<std::string> choicesOf(const CLI::Option& option) {
  const std::string text = option.get_type_name();  // NAME:{one,another}
  const std::size_t begin = text.find('{'), end = text.find('}');
  std::vector<std::string> choices;
  if (begin == std::string::npos || end == std::string::npos || end < begin) return choices;
  std::istringstream list(text.substr(begin + 1, end - begin - 1));
  for (std::string choice; std::getline(list, choice, ',');) choices.push_back(choice);
  return choices;
}

}  // namespace sks::tools
