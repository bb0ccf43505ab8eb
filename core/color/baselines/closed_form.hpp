#pragma once

#include <string>

#include "core/coherent/fresnel.hpp"
#include "core/color/color_method.hpp"
#include "core/color/fourier/one_film.hpp"

namespace irido {

/// Indices at 550 nm, where closed forms take them. Throws DomainError if the film absorbs there.
///   method  for the message
///   held    one film, its materials clamped
FilmIndex middle_index(const std::string& method, const Stack& held);

/// A formula for the light that one film reflects. Where the film reflects totally it gives the
/// white, as glTF does.
class ClosedForm : public ColorAlgorithm {
public:
    /// index   of the three media, for all wavelengths
    /// white   of the illuminant
    /// method  its name
    ClosedForm(const FilmIndex& index, const Triple& white, std::string_view method)
        : index_(index), white_(white), method_(method) {}

    void operator()(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const override;

protected:
    FilmIndex index_;
    Triple white_;

private:
    /// path_nm  optical path difference 2 d n2 cos(theta2)
    virtual Triple xyz(double cos_theta, const Medium& film, double thickness_nm,
                       double path_nm) const = 0;

    std::string_view method_;
};

}  // namespace irido
