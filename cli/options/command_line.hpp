#pragma once

#include <CLI/CLI.hpp>
#include <span>

namespace irido::cli {

/// Adds -j and --quiet to the commands that lack them: every command takes both.
void add_missing_options(CLI::App& program);

/// Checks a command line, starting with the program's name, before CLI11 parses it, so that errors
/// are in irido's own words: about the first wrong word, or else about a missing one. Does nothing
/// if help is requested. Throws UsageError.
void check_command_line(const CLI::App& program, std::span<char* const> words);

/// Notes limits applied to a parsed command: fewer threads than requested, or a lower SIMD level
/// because this machine lacks the one requested. Throws UsageError for an unknown level in
/// IRIDO_SIMD.
void note_fallbacks(const CLI::App& program);

}  // namespace irido::cli
