#include "core/color/quadrature/optical_path.hpp"

#include <algorithm>
#include <cmath>

#include "core/coherent/media.hpp"

namespace irido {

namespace {

/// Periods that light of a group sees at once where it does not see its end: those that make a
/// band gap. Edges of the gaps are found by halving panels.
constexpr double kOpaquePeriods = 32;

constexpr double kShortestPath_nm = 125;

}  // namespace

std::size_t path_class(double path_nm) {
    const double k = std::ceil(2 * std::log2(path_nm / kShortestPath_nm));
    return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(kPathClasses - 1)));
}

double path_of_class(std::size_t k) {
    return kShortestPath_nm * std::exp2(static_cast<double>(k) / 2);
}

std::vector<double> path_wavelengths(bool constant, WavelengthRange support) {
    if (constant) return {support.first_nm, support.last_nm};
    std::vector<double> wavelengths;
    for (int i = 0; i <= 4; ++i)
        wavelengths.push_back(support.first_nm + (support.last_nm - support.first_nm) * i / 4);
    return wavelengths;
}

double opaque_exponent(double tolerance) {
    return std::log(100 / tolerance);
}

void add_path(std::span<const Element> elements, std::span<const Complex> normal, double k0,
              double opaque, Gaps gaps, Path& path) {
    for (const Element& element : elements) {
        if (path.exponent() >= opaque) return;
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            const Complex kz = normal[layer->material];
            const double exponent = 2 * k0 * std::abs(kz.imag()) * layer->thickness_nm;
            if (layer->coherent && exponent < opaque)
                path.length_nm += 2 * layer->thickness_nm * std::abs(kz.real());
            (kz.real() == 0 ? path.tunnelled : path.absorbed) += exponent;
        } else {
            const Group& group = std::get<Group>(element.value);
            Path period;
            add_path(group.elements, normal, k0, opaque, gaps, period);
            const auto repeat = static_cast<double>(group.repeat);
            const double absorbed = repeat * period.absorbed;
            const double tunnelled = (gaps == Gaps::attenuate ? repeat : 1) * period.tunnelled;
            const bool has_end = absorbed + tunnelled < opaque;
            path.length_nm +=
                (has_end ? repeat : std::min(repeat, kOpaquePeriods)) * period.length_nm;
            path.absorbed += absorbed;
            path.tunnelled += tunnelled;
        }
    }
}

namespace {

bool has_groups(std::span<const Element> elements) {
    return std::ranges::any_of(
        elements, [](const Element& e) { return std::holds_alternative<Group>(e.value); });
}

}  // namespace

PathLengths longest_paths(std::span<const Element> elements, const IndexTable& table,
                          IncidentAngle incidence, double opaque, std::vector<Complex>& normal) {
    const bool groups = has_groups(elements);
    normal.resize(table.materials());
    bool varies = false;
    for (std::size_t m = 0; m < normal.size(); ++m) varies = varies || !table.is_constant(m);
    const bool all_vary = !table.is_constant(table.incident());
    PathLengths longest;
    for (std::size_t w = 0; w < table.wavelength_nm().size(); ++w) {
        for (std::size_t m = 0; m < normal.size(); ++m)
            if (w == 0 || all_vary || !table.is_constant(m))
                normal[m] = longest_normal(table, m, w, incidence);
        const auto path_of = [&](Gaps gaps) {
            Path path;
            add_path(elements, normal, table.k0()[w], opaque, gaps, path);
            return path;
        };
        const Path bands = path_of(Gaps::have_bands);
        longest.with_bands_nm = std::max(longest.with_bands_nm, bands.length_nm);
        // exponents alone make later wavelengths differ where media are constant
        if (w == 0 || varies)
            longest.attenuated_nm =
                std::max(longest.attenuated_nm,
                         groups ? path_of(Gaps::attenuate).length_nm : bands.length_nm);
        if (!varies && bands.exponent() == 0) break;
    }
    return longest;
}

double work_of(std::span<const Element> elements) {
    double work = 1;
    for (const Element& element : elements) {
        const Group* group = std::get_if<Group>(&element.value);
        const double doublings = group ? std::log2(static_cast<double>(group->repeat)) : 0;
        work += group ? work_of(group->elements) + 4 * doublings : 1;
    }
    return work;
}

namespace {

/// kz/k0 from its square, where a library's square root would care for overflow and NaN.
Complex normal_of(const Medium& medium) {
    const Complex q2 = medium.q2;
    const double size = q2.imag() == 0 ? std::abs(q2.real()) : std::sqrt(std::norm(q2));
    if (size == 0) return 0;
    const double larger = std::sqrt((size + std::abs(q2.real())) / 2);
    const double smaller = q2.imag() / (2 * larger);
    return q2.real() >= 0 ? Complex(larger, smaller)
                          : Complex(std::abs(smaller), std::copysign(larger, q2.imag()));
}

}  // namespace

Complex longest_normal(const IndexTable& table, std::size_t material, std::size_t wavelength,
                       IncidentAngle incidence) {
    const Complex s = normal_of(medium_of(table, material, wavelength, incidence, Polarization::s));
    if (table.extraordinary(material) == material) return s;
    const Complex p = normal_of(medium_of(table, material, wavelength, incidence, Polarization::p));
    return std::abs(p.real()) > std::abs(s.real()) ? p : s;
}

void add_lengths(const Element& element, double repeat, std::vector<double>& length_nm) {
    if (const Layer* layer = std::get_if<Layer>(&element.value)) {
        length_nm[layer->material] += repeat * layer->thickness_nm;
        return;
    }
    const Group& group = std::get<Group>(element.value);
    for (const Element& inner : group.elements)
        add_lengths(inner, repeat * static_cast<double>(group.repeat), length_nm);
}

double quadrature_work(const Stack& stack, const IndexTable& indices, std::size_t pieces,
                       IncidentAngle incidence) {
    constexpr double kPointsOfPiece = 20;  // as --stats says
    constexpr double kUsualTolerance = 1e-6;
    std::vector<Complex> normal(indices.materials());
    for (std::size_t m = 0; m < normal.size(); ++m)
        normal[m] = longest_normal(indices, m, 0, incidence);
    Path path;
    add_path(stack.elements, normal, indices.k0()[0], opaque_exponent(kUsualTolerance),
             Gaps::attenuate, path);
    return (kPointsOfPiece * static_cast<double>(pieces) + kPointsPerPath * path.length_nm) *
           work_of(stack.elements);
}

}  // namespace irido
