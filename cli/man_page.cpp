#include "cli/man_page.hpp"

#include <fmt/format.h>

#include <sstream>

namespace acinus::cli {
namespace {

/// Text with everything escaped that roff would take as a request, an escape or a hyphen.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (out.empty() || out.back() == '\n')
      if (c == '.' || c == '\'') out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}

/// Lines that keep their breaks.
std::string example(const std::string& text) {
  std::string lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin != std::string::npos) lines += escaped(line.substr(begin)) + "\n";
  }
  return ".nf\n" + lines + ".fi\n";
}

std::string entry(const CLI::Option& option, const CLI::Formatter& format) {
  const bool is_argument = option.get_positional();
  return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n",
                     escaped(format.make_option_name(&option, is_argument)),
                     escaped(format.make_option_opts(&option)), escaped(option.get_description()));
}

void append_command(const CLI::App& command, const CLI::Formatter& format, std::string& page) {
  page += fmt::format(".SS acinus {}\n{}\n", escaped(command.get_name()),
                      escaped(command.get_description()));
  for (const bool arguments : {true, false})
    for (const CLI::Option* option : command.get_options())
      if (option->get_positional() == arguments && option != command.get_help_ptr())
        page += entry(*option, format);
  if (!command.get_footer().empty()) page += ".PP\n" + example(command.get_footer());
}

}  // namespace

std::string man_page(const CLI::App& app, const std::string& version) {
  const CLI::Formatter format;
  std::string page = fmt::format(
      ".TH ACINUS 1 \"\" \"acinus {}\" \"User Commands\"\n.ad l\n"
      ".SH NAME\nacinus \\- {}\n"
      ".SH SYNOPSIS\n.B acinus\n.I COMMAND\n[\\fIARGUMENT\\fR ...]\n"
      ".SH COMMANDS\n",
      escaped(version), escaped(app.get_description()));
  for (const CLI::App* command : app.get_subcommands({})) append_command(*command, format, page);
  page += ".SH MORE\n" + example(app.get_footer());
  return page;
}

}  // namespace acinus::cli
