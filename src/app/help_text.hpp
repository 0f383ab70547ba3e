// What --help says: of the program, and of each command.
#pragma once

#include <span>
#include <string>

#include "src/app/command_line.hpp"

namespace rockfold {

struct CommandHelp {
  Command command;
  const char* name;
  const char* input;  ///< what follows it, "" = nothing
  const char* brief;  ///< one line in the list of commands
  const char* text;   ///< what the command does, in lines of at most 100 columns
  const char* example;
};

std::span<const CommandHelp> command_helps();
const CommandHelp& command_help(Command command);

/// Whether it reads a model file.
bool takes_model(Command command);
bool writes_results(Command command);
/// Whether it has --table.
bool lists_keyblocks(Command command);
/// Whether it may be told to write none.
bool may_leave_result(Command command);
/// Whether it has --report.
bool makes_report(Command command);

std::string program_help();
std::string command_help_text(const CommandHelp& help);

}  // namespace rockfold
