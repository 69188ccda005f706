// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/names.h>
#include <myolines/cli/manual.h>
#include <myolines/output/version.h>

#include <CLI/CLI.hpp>

#include <algorithm>

namespace myolines
{
  namespace
  {
    const auto all_commands = [](const CLI::App *) { return true; };
    const auto all_options  = [](const CLI::Option *) { return true; };

    /// Text as troff reads it: no escapes, no requests, and hyphens that can be searched for.
    std::string troff(const std::string &text)
    {
      std::string escaped;
      for (const char c : text)
        {
          const bool begins_line = escaped.empty() || escaped.back() == '\n';
          if (begins_line && (c == '.' || c == '\''))
            escaped += "\\&";
          escaped += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
        }
      return escaped;
    }

    std::string bold(const std::string &text) { return "\\fB" + troff(text) + "\\fR"; }

    /// "--set PATH=VALUE", "SCENE.xml".
    std::string spelled(const CLI::Option &option)
    {
      const std::string value = option.get_type_name();
      if (option.get_positional())
        return "\\fI" + troff(value) + "\\fR";
      std::string text = bold(option.get_name());
      if (option.get_items_expected_max() > 0 && !value.empty())
        text += " \\fI" + troff(value) + "\\fR";
      return text;
    }

    void write_options(const CLI::App &command, std::ostream &out)
    {
      for (const CLI::Option *option : command.get_options(all_options))
        {
          out << ".TP\n" << spelled(*option) << "\n" << troff(option->get_description());
          if (!option->get_default_str().empty())
            out << " (default: " << troff(option->get_default_str()) << ")";
          out << "\n";
        }
    }

    void write_command(const CLI::App &command, const std::string &before, std::ostream &out)
    {
      const std::string name = before + command.get_name();
      out << ".SS " << troff(name) << "\n" << troff(command.get_description()) << ".\n";
      write_options(command, out);
      for (const CLI::App *nested : command.get_subcommands(all_commands))
        write_command(*nested, name + " ", out);
    }

    // Lists of words have one a line, as words may have blanks.

    /// Names between braces, as CLI11 describes a set of values.
    std::string words_of_set(const std::string &type)
    {
      const std::size_t begin = type.find('{'), end = type.find('}');
      if (begin == std::string::npos || end == std::string::npos)
        return "";
      std::string words = type.substr(begin + 1, end - begin - 1);
      std::replace(words.begin(), words.end(), ',', '\n');
      return words;
    }

    using Pairs = std::vector<std::pair<std::string, std::string>>;

    /// Options of @p command and of those below it, each once; with sets of values, these go to @p values under "COMMAND OPTION".
    void find_options(const CLI::App &command, const std::string &name, std::vector<std::string> &words, Pairs &values)
    {
      for (const CLI::Option *option : command.get_options(all_options))
        for (const std::string &spelling : option->get_lnames())
          {
            if (std::find(words.begin(), words.end(), "--" + spelling) == words.end())
              words.push_back("--" + spelling);
            if (const std::string set = words_of_set(option->get_type_name()); !set.empty())
              values.push_back({name + " --" + spelling, set});
          }
      for (const CLI::App *nested : command.get_subcommands(all_commands))
        find_options(*nested, name, words, values);
    }

    std::vector<std::string> names_of_commands(const CLI::App &app)
    {
      std::vector<std::string> names;
      for (const CLI::App *command : app.get_subcommands(all_commands))
        names.push_back(command->get_name());
      return names;
    }

    void write_case(const std::string &variable, const Pairs &branches, std::ostream &out)
    {
      out << "    case $" << variable << " in\n";
      for (const auto &[pattern, words] : branches)
        out << "      \"" << pattern << "\") words=\"" << words << "\" ;;\n";
      out << "    esac\n";
    }
  } // namespace

  void write_manual(const CLI::App &app, std::ostream &out)
  {
    out << ".TH MYOLINES 1 \"\" \"Myolines " << version << "\" \"User commands\"\n"
        << ".SH NAME\nmyolines \\- " << troff(app.get_description().substr(app.get_description().find(": ") + 2)) << "\n"
        << ".SH SYNOPSIS\n.B myolines\n\\fICOMMAND\\fR [\\fIARGUMENTS\\fR]\n.br\n.B mpirun \\-np\n\\fIRANKS\\fR\n.B myolines\n"
        << "\\fICOMMAND\\fR [\\fIARGUMENTS\\fR]\n"
        << ".SH OPTIONS\n";
    write_options(app, out);
    out << ".SH COMMANDS\n";
    for (const CLI::App *command : app.get_subcommands(all_commands))
      write_command(*command, "", out);
    out << ".SH ENVIRONMENT\n.TP\n"
        << bold("MYOLINES_PLUGIN_PATH") << "\nFolders in which plug-ins are looked for first, with colons between them.\n";
    out << ".SH EXIT STATUS\n" << troff(app.get_footer()) << "\n";
  }

  void write_bash_completion(const CLI::App &app, const std::map<std::string, std::vector<std::string>> &arguments, std::ostream &out)
  {
    Pairs first, options, values;
    for (const CLI::App *command : app.get_subcommands(all_commands))
      {
        const std::string        name = command->get_name();
        std::vector<std::string> spellings;
        find_options(*command, name, spellings, values);
        options.push_back({name, join(spellings, "\n")});
        if (const std::vector<std::string> nested = names_of_commands(*command); !nested.empty())
          first.push_back({name, join(nested, "\n")});
      }
    for (const auto &[name, words] : arguments)
      first.push_back({name, join(words, "\n")});
    out << "# Completion of myolines for bash, printed by: myolines completion\n"
        << "_myolines() {\n"
        << "  local word=$2 typed=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} here=\"${COMP_WORDS[1]} $3\" words= IFS=$'\\n'\n"
        << "  COMPREPLY=()\n"
        << "  if [ \"$COMP_CWORD\" = 1 ]; then\n"
        << "    words=\"" << join(names_of_commands(app), "\n") << "\n--help\n--version\"\n"
        << "  elif [[ $word == -* ]]; then\n";
    write_case("command", options, out);
    out << "  elif [ \"$COMP_CWORD\" = 2 ]; then\n";
    write_case("command", first, out);
    out << "  else\n";
    write_case("here", values, out);
    out << "  fi\n"
        << "  [ -n \"$words\" ] || return 0\n"
        << "  word=${word//\\\\/} word=${word#[\\\"\\']}\n"
        << "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
        << "  # a blank in a word needs a backslash, but not between quotation marks\n"
        << "  [[ $typed == [\\\"\\']* ]] || COMPREPLY=(\"${COMPREPLY[@]// /\\\\ }\")\n"
        << "}\n"
        << "complete -o default -F _myolines myolines\n";
  }
} // namespace myolines
