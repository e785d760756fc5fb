#include "app/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/case_keys.hpp"
#include "app/material_help.hpp"
#include "app/new_case.hpp"
#include "math/errors.hpp"
#include "math/suggestion.hpp"

namespace cobasis {
namespace {

using Command = CommandLine::Command;

const std::vector<std::string> commands{"run", "check", "study", "info", "new", "help", "--help", "-h", "--version"};

const std::vector<std::string> topics{"case", "materials"};

/// What a command works on, in words.
const char* operand_of(Command command) {
  return command == Command::info ? "MESH" : command == Command::make ? "NAME" : "CASE";
}

/// At the first = outside quotes, which a key may need: boundary."a=b".
std::pair<std::string, std::string> key_and_value(const std::string& text) {
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quote ? text[i] == quote : text[i] == '"' || text[i] == '\'')
      quote = quote ? 0 : text[i];
    else if (text[i] == '=' && !quote && i > 0)
      return {text.substr(0, i), text.substr(i + 1)};
  }
  throw InputError(fmt::format("--set {}: found no key and =; allowed: --set key=value", text));
}

/// --set takes all words up to the next option, so that `--set a=1 b=2` works; the case may be among them.
void sort_out_settings(CommandLine& line, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (line.file.empty() && word.find('=') == std::string::npos)
      line.file = word;
    else
      line.overrides.set.push_back(key_and_value(word));
  }
}

[[noreturn]] void refuse_extras(const CLI::App& app, const std::string& word) {
  std::vector<std::string> options;
  for (const CLI::Option* option : app.get_options())
    if (option->nonpositional()) options.push_back(option->get_name());
  throw InputError(
      fmt::format("cobasis {}: \"{}\" is not expected; {}", app.get_name(), word,
                  word.starts_with("-") ? allowed_names(word, options) : "allowed: one file, see cobasis --help"));
}

}  // namespace

CommandLine read_command_line(const std::vector<std::string>& arguments) {
  CommandLine line;
  std::vector<std::string> settings;
  std::string topic;

  CLI::App app{"Cobasis: solids and fluids with interfaces on unstructured meshes", "cobasis"};
  app.set_version_flag("--version", "cobasis " COBASIS_VERSION);
  const auto add = [&](const char* name, const char* meaning, const char* file, const char* file_meaning) {
    CLI::App* command = app.add_subcommand(name, meaning);
    command->add_option(file, line.file, file_meaning)->type_name("");
    command->add_flag("--trust-geo", line.trust_geo, "let a .geo run commands and read other files");
    return command;
  };
  const auto add_set = [&](CLI::App* command) {
    command->add_option("--set", settings, "change a key of the case, e.g. region.0.pressure=2e5")
        ->type_name("key=value");
  };
  CLI::App* run = add("run", "compute a case", "CASE", "case file (TOML)");
  run->add_option("--output", line.overrides.output, "output directory instead of the case's")->type_name("DIR");
  run->add_flag("--quiet", line.quiet, "no progress, only the last line");
  run->add_flag("--restart", line.restart, "go on from the newest checkpoint in the output directory");
  add_set(run);
  CLI::App* check = add("check", "validate a case and its mesh, and say what the scene requires", "CASE", "case file");
  add_set(check);
  CLI::App* study =
      add("study",
          "compute a case on a sequence of meshes: its integrals and probes with error bars, their order, "
          "and what an accuracy costs",
          "CASE", "case file");
  study->add_option("--meshes", line.study.meshes, "how many; the finest is the case's own")
      ->check(CLI::Range(3, 8))
      ->type_name("N")
      ->capture_default_str();
  study->add_option("--ratio", line.study.ratio, "of the sizes of cells of two meshes")
      ->check(CLI::Range(1.2, 4.0))
      ->type_name("R")
      ->capture_default_str();
  study
      ->add_option("--refine", line.study.refine,
                   "which mesh_parameters make the mesh finer, with commas: NAME is a count, 1/NAME a size; or split: "
                   "Gmsh cuts every cell, and the case's mesh is the coarsest. Default: n, else 1/h")
      ->type_name("NAMES");
  study->add_option("--accuracy", line.study.accuracies, "relative accuracies to foretell the cost of, with commas")
      ->check(CLI::Range(1e-12, 1.0))
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("A,B")
      ->default_str("1e-2,1e-3,1e-4");
  study->add_option("--output", line.overrides.output, "directory; default: the case's and -study")->type_name("DIR");
  study->add_flag("--quiet", line.quiet, "no progress and no tables, only the last line");
  add_set(study);
  add("info", "cells, groups and quality of a mesh", "MESH", "mesh file (.geo, .msh)");
  CLI::App* make = app.add_subcommand("new", "write a commented case to start from, NAME.toml, and its mesh NAME.geo");
  make->add_option("NAME", line.file, "name of the case")->type_name("");
  make->add_option("--like", line.like, fmt::format("instead: {}", fmt::join(case_templates(), ", ")))
      ->type_name("CASE")
      ->default_val(case_templates().front());
  CLI::App* help = app.add_subcommand(
      "help",
      "help case: every key of a case file, its unit, default and allowed range; help materials: the built-in library");
  help->add_option("topic", topic, "case or materials")->type_name("");

  if (arguments.empty()) throw InputError(fmt::format("no command; {}", allowed_names("", commands)));
  if (std::ranges::find(commands, arguments[0]) == commands.end())
    throw InputError(fmt::format("unknown command \"{}\"; {}", arguments[0], allowed_names(arguments[0], commands)));
  for (CLI::App* command : app.get_subcommands({})) command->allow_extras();
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForHelp&) {
    line.text = app.help();
    return line;
  } catch (const CLI::CallForVersion&) {
    line.text = app.version() + "\n";
    return line;
  } catch (const CLI::ParseError& error) {
    throw InputError(fmt::format("{}; see cobasis --help", error.what()));
  }

  const CLI::App* command = app.get_subcommands().front();
  if (const auto extras = command->remaining(); !extras.empty()) refuse_extras(*command, extras.front());
  if (command == help) {
    if (topic.empty()) return read_command_line({"--help"});
    if (std::ranges::find(topics, topic) == topics.end())
      throw InputError(fmt::format("help on \"{}\"; {}", topic, allowed_names(topic, topics)));
    line.text = topic == "case" ? describe_case_keys() : describe_materials();
    return line;
  }
  line.command = command == run     ? Command::run
                 : command == check ? Command::check
                 : command == study ? Command::study
                 : command == make  ? Command::make
                                    : Command::info;
  sort_out_settings(line, settings);
  if (line.file.empty())
    throw InputError(fmt::format("cobasis {0}: no {1}; allowed: cobasis {0} {2}", command->get_name(),
                                 line.command == Command::make ? "name" : "file", operand_of(line.command)));
  return line;
}

}  // namespace cobasis
