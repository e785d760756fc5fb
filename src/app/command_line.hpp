// What the user asked for on the command line.
#pragma once

#include <string>
#include <vector>

#include "app/case.hpp"
#include "app/study_meshes.hpp"

namespace cobasis {

struct CommandLine {
  enum class Command {
    run,    ///< the case `file`
    check,  ///< the case `file`
    study,  ///< the case `file` on meshes of different size
    info,   ///< on the mesh `file`
    make,   ///< the case `file` like the template `like`
    print   ///< `text`, and be done: help, version, the keys of a case
  };
  Command command = Command::print;
  std::string file;
  CaseOverrides overrides;
  bool trust_geo = false;  ///< let a .geo run commands and read other files
  bool quiet = false;
  std::string like;  ///< of make
  bool restart = false;  ///< from the newest checkpoint
  StudyOptions study;
  std::string text;
};

/// `arguments` without the program's name. Throws InputError on wrong usage.
CommandLine read_command_line(const std::vector<std::string>& arguments);

}  // namespace cobasis
