// SPDX-License-Identifier: BSD-3-Clause
#include "baselines/method_settings.hpp"
#include "tools/pages/option_text.hpp"
#include "tools/pages/pages.hpp"

#include <sks_detector/settings.hpp>

namespace sks::tools {
namespace {

/// The part that does not depend on the commands. Words that bash splits at '=' are put together again; of what is
/// offered, only the part behind the '=' may then be answered.
constexpr const char* functions = R"sh(
# Prints the folders that may hold the presets, for the command $1.
_sks_share() {
  local program
  program=$(type -P -- "$1" 2>/dev/null)
  [[ -n ${SKS_SHARE-} ]] && printf '%s\n' "$SKS_SHARE"
  [[ -n $program ]] || return 0
  program=$(readlink -f -- "$program")
  printf '%s\n' "${program%/*}/../share/sks_detector" "${program%/*}/../../share/sks_detector"
}

# Presets whose name or path begins with $2, for the command $1.
_sks_presets() {
  local folder file
  while IFS= read -r folder; do
    for file in "$folder"/config/*.yaml "$folder"/config/methods/*.yaml; do
      [[ -f $file ]] || continue
      [[ ${file##*/} == "$2"* || $file == "$2"* ]] && COMPREPLY+=("$file")
    done
  done < <(_sks_share "$1")
}

# Offers the words of $1 that begin with $2.
_sks_words() {
  local word
  for word in $1; do
    [[ $word == "$2"* ]] && COMPREPLY+=("$word")
  done
}

# Offers values of the kind $1 for what was typed, $2, to the command $3. False where bash is to offer files.
_sks_value() {
  case $1 in
    set)
      if [[ $2 == *=* ]]; then
        _sks_words "${_sks_choices[${2%%=*}]-}" "${2#*=}"
        [[ ${COMP_WORDBREAKS} == *=* ]] || COMPREPLY=("${COMPREPLY[@]/#/${2%%=*}=}")
      else
        _sks_words "$_sks_settings" "$2"
        compopt -o nospace 2>/dev/null
      fi
      ;;
    config) _sks_presets "$3" "$2"; mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -X '!*.yaml' -- "$2") ;;
    folder) compopt -o dirnames 2>/dev/null; return 1 ;;
    file) return 1 ;;
    none) compopt +o default 2>/dev/null ;;
    *) _sks_words "${1#words }" "$2" ;;
  esac
}

_sks() {
  local words=() i command=sks current previous kind
  COMPREPLY=()
  for ((i = 1; i <= COMP_CWORD; i++)); do
    if ((i > 1 && ${#words[@]} > 1)) && [[ ${COMP_WORDS[i]} == = || ${COMP_WORDS[i - 1]} == = ]]; then
      words[${#words[@]} - 1]+=${COMP_WORDS[i]}
    else
      words+=("${COMP_WORDS[i]}")
    fi
  done
  local last=$((${#words[@]} - 1))
  current=${words[last]}
  for ((i = 0; i < last; i++)); do  # the words of the command come first
    [[ -n ${_sks_commands[$command]-} && " ${_sks_commands[$command]} " == *" ${words[i]} "* ]] || break
    command+=" ${words[i]}"
  done
  previous=""
  ((last > 0)) && previous=${words[last - 1]}
  if [[ $current == --*=* ]]; then  # --option=value
    kind=${_sks_kinds[$command ${current%%=*}]-file}
    current=${current#*=}
    _sks_value "$kind" "$current" "$1"
    return 0
  fi
  if [[ $current != -* && $previous == -* && -n ${_sks_kinds[$command $previous]-} ]]; then
    _sks_value "${_sks_kinds[$command $previous]}" "$current" "$1"
    return 0
  fi
  if [[ $current == -* ]]; then
    _sks_words "${_sks_options[$command]-}" "$current"
  elif [[ -n ${_sks_commands[$command]-} ]]; then
    _sks_words "${_sks_commands[$command]}" "$current"
    compopt +o default 2>/dev/null
  elif [[ -n ${_sks_positional[$command]-} ]]; then
    for ((i = 0; i < last; i++)); do  # it was given already: files come next
      [[ " ${_sks_positional[$command]} " == *" ${words[i]} "* ]] && return 0
    done
    _sks_words "${_sks_positional[$command]}" "$current"
  fi
  return 0
}

complete -o default -F _sks sks
)sh";

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// What can be offered as the value of an option, as _sks_value() knows it; empty for a flag.
std::string kindOf(const CLI::Option& option) {
  const std::string value = valueName(option);
  const std::vector<std::string> choices = choicesOf(option);
  if (value.empty()) return "";
  if (!choices.empty()) return "words " + joined(choices);
  if (option.check_lname("set")) return "set";
  if (option.check_lname("config")) return "config";
  if (value == "DIR") return "folder";
  return value.find("FILE") != std::string::npos ? "file" : "none";
}

class Arrays {
public:
  void addCommand(const CommandEntry& entry) {
    std::vector<std::string> subcommands, options;
    for (const CLI::App* sub : subcommandsOf(*entry.command)) subcommands.push_back(sub->get_name());
    for (const CLI::Option* option : entry.command->get_options()) {
      if (option->get_positional()) {
        if (!choicesOf(*option).empty()) positional_ += line(keyOf(entry), joined(choicesOf(*option)));
        continue;
      }
      for (const std::string& name : namesOf(*option)) {
        options.push_back(name);
        if (!kindOf(*option).empty()) kinds_ += line(keyOf(entry) + " " + name, kindOf(*option));
      }
    }
    if (!subcommands.empty()) commands_ += line(keyOf(entry), joined(subcommands));
    options_ += line(keyOf(entry), joined(options));
  }

  void addSettings(const std::vector<SettingInfo>& infos) {
    for (const SettingInfo& info : infos) {
      settings_ += info.key + "= ";
      if (info.type == "choice") choices_ += line(info.key, joined(info.choices));
      if (info.type == "bool") choices_ += line(info.key, "true false");
    }
  }

  std::string text() const {
    const auto array = [](const std::string& name, const std::string& lines) {
      return "declare -gA " + name + "=(\n" + lines + ")\n";
    };
    return array("_sks_commands", commands_) + array("_sks_options", options_) + array("_sks_kinds", kinds_) +
           array("_sks_positional", positional_) + array("_sks_choices", choices_) + "_sks_settings='" + settings_ +
           "'\n";
  }

private:
  static std::string keyOf(const CommandEntry& entry) { return "sks" + (entry.words.empty() ? "" : " " + entry.words); }
  static std::string line(const std::string& key, const std::string& value) {
    return "  ['" + key + "']='" + value + "'\n";
  }

  std::string commands_, options_, kinds_, positional_, choices_, settings_;
};

}  // namespace

std::string completionScript(const CLI::App& app) {
  Arrays arrays;
  for (const CommandEntry& entry : commandsOf(app)) arrays.addCommand(entry);
  arrays.addSettings(settingInfos());
  arrays.addSettings(baselines::methodTable().infos());
  return "# bash completion of sks; made from its help texts.\n" + arrays.text() + functions;
}

}  // namespace sks::tools
