#pragma once

#include <string>

#include "cli/manual/command_page.hpp"

namespace irido::cli {

/// The manual page of a command, for troff's macros man. `program` is the page of all commands, of
/// which `page` is one; `version` as the page's foot shows it.
std::string man_page(const CommandPage& program, const CommandPage& page,
                     const std::string& version);

/// The name of a command's manual page: irido-lut-color.
std::string page_name(const CommandPage& page);

// Completions of a program's commands, options and words, as functions of a shell that run nothing.
std::string bash_completion(const CommandPage& program);
std::string zsh_completion(const CommandPage& program);
std::string fish_completion(const CommandPage& program);

}  // namespace irido::cli
