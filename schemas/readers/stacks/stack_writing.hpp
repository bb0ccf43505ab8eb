#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/stack/stack.hpp"

namespace irido::schemas {

/// Losses, each named once.
class Losses {
public:
    void add(const std::string& what);
    std::vector<std::string> take() { return std::move(all_); }

private:
    std::vector<std::string> all_;
};

/// The layers of a stack from the incident side on, groups written out. Throws InputError for more
/// than 10,000 of them. Distributions of thicknesses are a loss, and so are groups.
std::vector<Layer> layers_written_out(const Stack& stack, Losses& losses);

/// Whether light does not come through a medium that has no end.
bool is_opaque(const Material& material);

/// Rows of wavelength in nm, n and k, one for a constant, between which a line is within 1e-5 of a
/// formula. Rows of tables stay as they are.
/// range  where they are wanted; where the material is not known there are none
/// Throws InputError if it is known nowhere there.
std::vector<std::array<double, 3>> index_rows_within(const Material& material,
                                                     WavelengthRange range);

/// Names for the materials of a stack, in its order: letters, digits and `_`, at most `longest`,
/// no two the same in capitals, beginning with a letter.
std::vector<std::string> plain_names(const Stack& stack, std::size_t longest);

/// A name that is not the material's own is a loss.
void note_name(const Material& material, const std::string& name, Losses& losses);

/// Any text as such a name.
std::string plain_name(const std::string& text, std::size_t longest);

/// A number without an exponent, which not every program reads: 1000000, 0.0585.
std::string plain_number(double value);

/// What a material is called in messages.
std::string name_in_words(const Material& material);

}  // namespace irido::schemas
