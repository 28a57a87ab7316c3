// SPDX-License-Identifier: BSD-3-Clause
#include <sstream>

#include "tools/pages/option_text.hpp"
#include "tools/pages/pages.hpp"

namespace sks::tools {
namespace {

constexpr std::size_t line_length = 78;

/// Text that roff prints as it is.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
  }
  return result;
}

/// Words in lines; none begins like a request.
std::string paragraph(const std::string& text) {
  std::istringstream words(text);
  std::string result, line;
  for (std::string word; words >> word;) {
    word = escaped(word);
    if (!line.empty() && line.size() + 1 + word.size() > line_length) {
      result += line + "\n";
      line.clear();
    }
    if (line.empty() && (word[0] == '.' || word[0] == '\'')) word = "\\&" + word;
    line += (line.empty() ? "" : " ") + word;
  }
  return line.empty() ? result : result + line + "\n";
}

std::string bold(const std::string& text) {
  return "\\fB" + escaped(text) + "\\fR";
}

std::string italic(const std::string& text) {
  return "\\fI" + escaped(text) + "\\fR";
}

std::string positionalText(const CLI::Option& option) {
  const std::string name = option.get_single_name();
  return italic(name) + (option.get_items_expected_max() > 1 ? " ..." : "");
}

std::string synopsis(const CommandEntry& entry) {
  std::string text = bold("sks " + entry.words);
  bool options = false;
  for (const CLI::Option* option : entry.command->get_options()) options = options || !option->get_positional();
  if (options) text += " [" + italic("options") + "]";
  for (const CLI::Option* option : entry.command->get_options()) {
    if (option->get_positional()) text += " " + positionalText(*option);
  }
  return text + "\n";
}

std::string optionText(const CLI::Option& option) {
  std::string head;
  for (const std::string& name : namesOf(option)) head += (head.empty() ? "" : ", ") + bold(name);
  if (option.get_positional()) head = positionalText(option);
  const std::string value = valueName(option);
  if (!option.get_positional() && !value.empty()) head += " " + italic(value);
  std::string text = option.get_description();
  std::string choices;
  for (const std::string& choice : choicesOf(option)) choices += (choices.empty() ? "" : ", ") + choice;
  if (!choices.empty()) text += (text.empty() ? "" : ". ") + std::string("One of: ") + choices;
  if (option.get_required()) text += text.empty() ? "required" : " (required)";
  return ".TP\n" + head + "\n" + paragraph(text.empty() ? option.get_single_name() : text);
}

std::string commandText(const CommandEntry& entry) {
  std::string text = ".SS " + escaped("sks " + entry.words) + "\n" + synopsis(entry) + ".PP\n" +
                     paragraph(entry.command->get_description());
  for (const CLI::Option* option : entry.command->get_options()) text += optionText(*option);
  const std::string footer = entry.command->get_footer();
  return footer.empty() ? text : text + ".PP\n" + paragraph(footer);
}

constexpr const char* closing = R"(.SH EXIT STATUS
.TP
0
Everything went well.
.TP
1
Something cannot be read, written or used; the message on standard error
names it and the remedy.
.TP
2
The arguments make no sense.
.SH ENVIRONMENT
.TP
.B SKS_SHARE
Folder of the presets (config/) and scripts, if they are not where they were
installed.
.SH FILES
.TP
.I share/sks_detector/config/*.yaml
Presets for
.BR \-\-config :
paper, default, fast, classify.
.SH SEE ALSO
.BR rosrun (1),
.BR rosbag (1)
)";

}  // namespace

std::string manualPage(const CLI::App& app, const std::string& version, const std::string& date) {
  std::string text = ".\\\" Made from the help texts of sks; changes belong there.\n.TH SKS 1 \"" + date + "\" \"sks " +
                     version +
                     "\" \"User Commands\"\n.SH NAME\nsks \\- find known objects in cluttered RGB\\-D point clouds\n" +
                     ".SH SYNOPSIS\n";
  const std::vector<CommandEntry> entries = commandsOf(app);
  bool first = true;
  for (const CommandEntry& entry : entries) {
    if (entry.words.empty() || !subcommandsOf(*entry.command).empty()) continue;
    text += (first ? "" : ".br\n") + synopsis(entry);
    first = false;
  }
  text += ".SH DESCRIPTION\n" + paragraph(app.get_description()) + ".PP\n" +
          paragraph("Results go to standard output, messages to standard error.") + ".SH COMMANDS\n";
  for (const CommandEntry& entry : entries) {
    if (!entry.words.empty() && subcommandsOf(*entry.command).empty()) text += commandText(entry);
  }
  return text + closing;
}

}  // namespace sks::tools
