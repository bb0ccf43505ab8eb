#pragma once

#include <string>

#include "cli/manual/command_page.hpp"

namespace irido::cli {

/// The manual page of a command, in troff's man macros.
/// program  the page of the program, with all commands
/// page     the command's page
/// version  as shown in the footer
std::string man_page(const CommandPage& program, const CommandPage& page,
                     const std::string& version);

/// The name of a command's manual page: irido-lut-color.
std::string page_name(const CommandPage& page);

// Completions of a program's commands, options and words, as shell functions that run no program.
std::string bash_completion(const CommandPage& program);
std::string zsh_completion(const CommandPage& program);
std::string fish_completion(const CommandPage& program);

}  // namespace irido::cli
