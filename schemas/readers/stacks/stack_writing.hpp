#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/stack/stack.hpp"

namespace irido::schemas {

/// A list of losses without duplicates.
class Losses {
public:
    void add(const std::string& what);
    std::vector<std::string> take() { return std::move(all_); }

private:
    std::vector<std::string> all_;
};

/// The layers of a stack from the incident side, groups expanded. Throws InputError for more than
/// 10,000. Thickness distributions and groups are recorded as losses.
std::vector<Layer> layers_written_out(const Stack& stack, Losses& losses);

/// Whether a semi-infinite medium of this material transmits no light.
bool is_opaque(const Material& material);

/// Rows of wavelength in nm, n and k (one row for a constant) such that linear interpolation is
/// within 1e-5 of a formula. Rows of tables are kept as they are. Throws InputError if the material
/// is defined nowhere in the range.
/// range  the wavelengths to cover; parts where the material is undefined are skipped
std::vector<std::array<double, 3>> index_rows_within(const Material& material,
                                                     WavelengthRange range);

/// Distinct names for the materials of a stack, in its order: letters, digits and `_`, at most
/// `longest` characters, beginning with a letter, distinct even ignoring case.
std::vector<std::string> plain_names(const Stack& stack, std::size_t longest);

/// Records a loss if `name` is not the material's own name.
void note_name(const Material& material, const std::string& name, Losses& losses);

/// Turns any text into such a name.
std::string plain_name(const std::string& text, std::size_t longest);

/// A number without an exponent, which some programs cannot read: 1000000, 0.0585.
std::string plain_number(double value);

/// The name of a material in messages.
std::string name_in_words(const Material& material);

}  // namespace irido::schemas
