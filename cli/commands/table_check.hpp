#pragma once

#include <string>

namespace irido::cli {

/// Reads a table of text that is none of a material as the command that takes it would: films of
/// `compare --films`, directions of `brdf --directions`, combinations of `sweep --points`,
/// measurements of `fit` and spectra of lamps; its columns' names tell which. Throws InputError and
/// DomainError.
/// text  the file's content
/// path  the file
/// Returns false if the names are none of these.
bool check_other_table(const std::string& text, const std::string& path);

}  // namespace irido::cli
