#include "core/color/stack_color.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/interference/spectrum.hpp"

namespace irido {

namespace {

/// Every material must be known here, or say what it does outside its range.
constexpr WavelengthRange kEssential{400, 700};

/// Past this exponent of attenuation nothing below returns a fringe.
constexpr double kOpaqueExponent = 35;

constexpr double kLargestHalfTurn = 70;

/// Layers computed for one spectrum before it is given up, and points that any stack may have.
constexpr double kMostWork = 2e7, kFewestPoints = 4096;

/// Points of a panel that is not cut any further.
constexpr double kPanelPoints = 129;

/// Twice the optical thickness that light passes before it is lost, nm, and the exponent of its
/// loss.
struct Path {
    double length_nm = 0;
    double exponent = 0;
};

void add_path(std::span<const Element> elements, std::span<const Medium> media, double k0,
              Path& path) {
    for (const Element& element : elements) {
        if (path.exponent >= kOpaqueExponent) return;
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            const Complex normal = std::sqrt(media[layer->material].q2);
            const double loss = 2 * k0 * std::abs(normal.imag());  // a nm
            double depth = layer->thickness_nm;
            if (loss * depth > kOpaqueExponent) depth = kOpaqueExponent / loss;
            if (layer->coherent) path.length_nm += 2 * depth * std::abs(normal.real());
            path.exponent += loss * depth;
        } else {
            const Group& group = std::get<Group>(element.value);
            Path period;
            add_path(group.elements, media, k0, period);
            double repeat = static_cast<double>(group.repeat);
            if (period.exponent > 0)
                repeat = std::min(repeat, kOpaqueExponent / period.exponent + 1);
            path.length_nm += repeat * period.length_nm;
            path.exponent += repeat * period.exponent;
        }
    }
}

/// Layers whose matrices one evaluation takes, a doubling of an absorbing group among them.
double work_of(std::span<const Element> elements) {
    double work = 1;
    for (const Element& element : elements) {
        const Group* group = std::get_if<Group>(&element.value);
        const double doublings = group ? std::log2(static_cast<double>(group->repeat)) : 0;
        work += group ? work_of(group->elements) + 4 * doublings : 1;
    }
    return work;
}

/// Longest optical path over a few wavelengths and the steepest and flattest angle.
double optical_path_nm(const Stack& stack, WavelengthRange support,
                       std::span<const double> angles_deg) {
    std::vector<double> wavelengths;
    for (int i = 0; i <= 4; ++i)
        wavelengths.push_back(support.first_nm + (support.last_nm - support.first_nm) * i / 4);
    const IndexTable table(stack, wavelengths);
    const auto [flat, steep] = std::ranges::minmax(angles_deg);
    double longest = 0;
    for (const double angle : {flat, steep}) {
        for (std::size_t w = 0; w < wavelengths.size(); ++w) {
            std::vector<Medium> media;
            for (std::size_t m = 0; m < table.materials(); ++m)
                media.push_back(medium(table.index(m, w), table.n(table.incident())[w],
                                       cos_of_incidence(angle)));
            Path path;
            add_path(stack.elements, media, 2 * std::numbers::pi / wavelengths[w], path);
            longest = std::max(longest, path.length_nm);
        }
    }
    return longest;
}

/// The ends of the support and every kink of the materials between them.
std::vector<double> smooth_pieces(const Stack& stack, WavelengthRange support) {
    std::vector<double> ends{support.first_nm, support.last_nm};
    const auto add = [&](double wavelength) {
        if (wavelength > support.first_nm && wavelength < support.last_nm)
            ends.push_back(wavelength);
    };
    for (const Material& material : stack.materials) {
        for (const double kink : kinks(material, support)) add(kink);
        const WavelengthRange range = range_of(material);
        add(range.first_nm);
        add(range.last_nm);
    }
    std::ranges::sort(ends);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
}

std::vector<SpectralPanel> first_panels(const Stack& stack, WavelengthRange support,
                                        std::span<const double> angles_deg,
                                        std::size_t evaluations) {
    const double path = 1.1 * optical_path_nm(stack, support, angles_deg);
    const std::vector<double> ends = smooth_pieces(stack, support);
    // more panels than can be afforded do not help: the fringes stay unresolved
    const double wanted_in_all =
        std::numbers::pi * path * (1 / support.first_nm - 1 / support.last_nm) / kLargestHalfTurn;
    const double affordable = static_cast<double>(evaluations) / kPanelPoints / 4;
    const double scale = std::min(1.0, affordable / wanted_in_all);
    std::vector<SpectralPanel> panels;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const double nu_first = 1 / ends[i], nu_last = 1 / ends[i + 1];
        const double half_turn = std::numbers::pi * path * (nu_first - nu_last);
        const auto count = static_cast<std::size_t>(
            std::max(1.0, std::ceil(scale * half_turn / kLargestHalfTurn)));
        double from = ends[i];
        for (std::size_t k = 1; k <= count; ++k) {
            const double part = static_cast<double>(k) / static_cast<double>(count);
            const double to =
                k == count ? ends[i + 1] : 1 / (nu_first + (nu_last - nu_first) * part);
            panels.push_back({{from, to}, half_turn / static_cast<double>(count)});
            from = to;
        }
    }
    return panels;
}

SpectrumSample sample_of(const Spectra& at, std::size_t point, Side side, Light light) {
    const auto value = [&](const Spectrum& spectrum) {
        return side == Side::reflected ? spectrum.R[point] : spectrum.T[point];
    };
    const auto denominator = [&](const Spectrum& spectrum) {
        return spectrum.denominator.empty()
                   ? ScaledComplex{}
                   : ScaledComplex{spectrum.denominator[point], spectrum.log_scale[point]};
    };
    return {light == Light::s   ? value(at.s)
            : light == Light::p ? value(at.p)
                                : (value(at.s) + value(at.p)) / 2,
            {denominator(at.s), denominator(at.p)}};
}

}  // namespace

std::vector<HeldRange> held_ranges(const Stack& stack, const Sensitivity& sensitivity) {
    const WavelengthRange support = sensitivity.support();
    std::vector<HeldRange> held;
    for (std::size_t m = 0; m < stack.materials.size(); ++m) {
        const Material& material = stack.materials[m];
        const WavelengthRange range = range_of(material);
        if (material.outside == Outside::clamp ||
            (range.first_nm <= support.first_nm && range.last_nm >= support.last_nm))
            continue;
        HeldRange entry{m, range, true, {}};
        entry.usable = range.first_nm <= kEssential.first_nm && range.last_nm >= kEssential.last_nm;
        const WavelengthRange inside{std::max(range.first_nm, support.first_nm),
                                     std::min(range.last_nm, support.last_nm)};
        const Triple known =
            inside.first_nm < inside.last_nm ? sensitivity.integral(inside) : Triple{};
        for (std::size_t c = 0; c < 3; ++c)
            entry.weight[c] = std::max(0.0, 1 - known[c] / sensitivity.white()[c]);
        held.push_back(entry);
    }
    return held;
}

std::vector<ColorIntegral> stack_color(const Stack& stack, const Sensitivity& sensitivity,
                                       std::span<const double> angles_deg,
                                       std::span<const Side> sides, const IntegrationLimits& limits,
                                       const Execution& execution, Light light) {
    for (const HeldRange& entry : held_ranges(stack, sensitivity))
        if (!entry.usable)
            throw DomainError(
                stack.materials[entry.material].name + " must be known from 400 to 700 nm (got " +
                to_text(entry.range.first_nm) + " to " + to_text(entry.range.last_nm) + " nm)");
    Stack held = stack;
    for (Material& material : held.materials) material.outside = Outside::clamp;
    const StackPower power(held);
    const std::size_t per_angle = sides.size();
    const bool reflected = std::ranges::find(sides, Side::reflected) != sides.end();
    const bool transmitted = std::ranges::find(sides, Side::transmitted) != sides.end();
    const Needs needs{.s = light != Light::p,
                      .p = light != Light::s,
                      .R = reflected,
                      .T = transmitted,
                      .A = false,
                      .denominators = true};
    IntegrationLimits bounded = limits;
    bounded.evaluations = std::min(
        limits.evaluations,
        static_cast<std::size_t>(std::max(kFewestPoints, kMostWork / work_of(held.elements))));

    const SpectraAt spectra = [&](std::span<const double> wavelength_nm,
                                  std::span<const std::size_t> items,
                                  std::span<SpectrumSample> samples) {
        const std::size_t points = wavelength_nm.size();
        const IndexTable table(held, {wavelength_nm.begin(), wavelength_nm.end()});
        std::vector<std::size_t> starts;  // where in `items` each angle begins
        for (std::size_t i = 0; i < items.size(); ++i)
            if (i == 0 || items[i] / per_angle != items[i - 1] / per_angle) starts.push_back(i);
        std::vector<double> cosines;
        for (const std::size_t start : starts)
            cosines.push_back(cos_of_incidence(angles_deg[items[start] / per_angle]));
        const Spectra at = irido::spectra(power, table, cosines, needs, execution);
        for (std::size_t k = 0; k < starts.size(); ++k) {
            const std::size_t end = k + 1 < starts.size() ? starts[k + 1] : items.size();
            for (std::size_t i = starts[k]; i < end; ++i) {
                const Side side = sides[items[i] % per_angle];
                for (std::size_t w = 0; w < points; ++w)
                    samples[i * points + w] = sample_of(at, k * points + w, side, light);
            }
        }
    };
    const std::vector<SpectralPanel> panels =
        first_panels(held, sensitivity.support(), angles_deg, bounded.evaluations);
    return integrate_color(sensitivity, panels, angles_deg.size() * per_angle, spectra, bounded);
}

}  // namespace irido
