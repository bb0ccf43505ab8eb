#pragma once

#include <CLI/CLI.hpp>
#include <span>

namespace irido::cli {

/// Adds -j and --quiet to the commands that lack them: every command takes both.
void add_missing_options(CLI::App& program);

/// Checks a command line, the program's name first, before CLI11 parses it, so that errors come in
/// irido's words: the first wrong word, else a missing one. Checks nothing if help is requested.
/// Throws UsageError.
void check_command_line(const CLI::App& program, std::span<char* const> words);

/// Notes limits applied to a parsed command: fewer threads than requested, or a lower SIMD level
/// because this machine lacks the one requested. Throws UsageError for an unknown level in
/// IRIDO_SIMD.
void note_fallbacks(const CLI::App& program);

}  // namespace irido::cli
