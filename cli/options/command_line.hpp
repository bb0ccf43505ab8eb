#pragma once

#include <CLI/CLI.hpp>
#include <span>

namespace irido::cli {

/// Adds -j and --quiet to the commands that lack them: every command takes both.
void add_missing_options(CLI::App& program);

/// Reads the words of a command line, the program's name first, as CLI11 will, and refuses what it
/// would refuse: the first wrong word, then what is missing. Nothing is refused where help is asked
/// for. Throws UsageError.
void check_command_line(const CLI::App& program, std::span<char* const> words);

/// Says what was asked for and cannot be had, for a command that has been parsed: more threads than
/// irido starts, instructions that this machine lacks. Throws UsageError for a level of IRIDO_SIMD
/// that there is not.
void note_fallbacks(const CLI::App& program);

}  // namespace irido::cli
