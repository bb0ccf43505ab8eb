#include "core/rough/layered/layered_color.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/coherent/coherent.hpp"
#include "core/color/held_stack.hpp"
#include "core/color/stack_color.hpp"
#include "core/keep_once.hpp"
#include "core/math/constants.hpp"
#include "core/rough/layered/adding.hpp"
#include "core/rough/layered/lobe.hpp"

namespace irido {

namespace {

/// Optical path difference, nm, of the fringes that survive averaging over roughness, in light that
/// a layer transmits or reflects into all directions: initial sampling, refined if necessary.
constexpr double kSmoothPath_nm = 4000;

/// Items integrated together.
constexpr std::size_t kColorsTogether = 64;

/// Smallest tolerance passed to the adding method.
constexpr double kAddingTolerance = 1e-3;

/// Most wavelengths for one colour.
constexpr std::size_t kMostWavelengths = 1U << 14U;

/// Boundaries of the ranges in which all materials and the base are smooth.
std::vector<double> pieces_of(const LayeredSurface& surface, WavelengthRange support) {
    std::vector<double> ends{support.first_nm, support.last_nm};
    for (const RoughLayer& layer : surface.layers) {
        const std::vector<double> pieces = smooth_pieces(layer.stack, support);
        ends.insert(ends.end(), pieces.begin(), pieces.end());
    }
    if (const auto* table = std::get_if<Table>(&surface.base_albedo))
        for (const double nm : table->wavelength_nm)
            if (nm > support.first_nm && nm < support.last_nm) ends.push_back(nm);
    keep_once(ends);
    return ends;
}

/// Twice the optical thickness of a stack at one wavelength, repetitions included.
double path_of(std::span<const Element> elements, const IndexTable& indices) {
    double path = 0;
    for (const Element& element : elements) {
        if (const Layer* layer = std::get_if<Layer>(&element.value))
            path += 2 * layer->thickness_nm * indices.n(layer->material, 0);
        else
            path += static_cast<double>(std::get<Group>(element.value).repeat) *
                    path_of(std::get<Group>(element.value).elements, indices);
    }
    return std::min(path, 1e6);
}

/// Wavelengths of all the points together.
std::vector<double> wavelengths_of(std::span<const SpectralPoints* const> parts) {
    std::vector<double> all;
    for (const SpectralPoints* part : parts)
        all.insert(all.end(), part->wavelength_nm.begin(), part->wavelength_nm.end());
    return all;
}

}  // namespace

std::vector<Triple> sampled_colors(const Sensitivity& sensitivity, const SampleRule& rule,
                                   std::span<const double> spectra) {
    const std::size_t W = rule.wavelength_nm.size();
    std::vector<Triple> colors(spectra.size() / W);
    for (std::size_t c = 0; c < 3; ++c) {
        double light = 0;
        for (const double weight : rule.weight[c]) light += weight;
        for (std::size_t k = 0; k < colors.size(); ++k) {
            double sum = 0;
            for (std::size_t w = 0; w < W; ++w) sum += rule.weight[c][w] * spectra[k * W + w];
            colors[k][c] = sensitivity.white()[c] * sum / light;
        }
    }
    return colors;
}

LayeredColor::LayeredColor(const ColorTables& tables, LayeredSurface surface, Crossings crossings,
                           double tolerance, const Execution& execution, const ColorMethod& method)
    : tables_(tables),
      tolerance_(tolerance),
      execution_(execution),
      method_(method),
      scattering_(held_surface(std::move(surface), tables.sensitivity()), crossings, execution),
      pieces_(pieces_of(scattering_.surface(), tables.sensitivity().support())) {}

std::vector<SpectralPanel> LayeredColor::panels(double path_nm) const {
    std::vector<SpectralPanel> all;
    for (std::size_t i = 0; i + 1 < pieces_.size(); ++i)
        all.push_back(
            {{pieces_[i], pieces_[i + 1]}, kPi * path_nm * (1 / pieces_[i] - 1 / pieces_[i + 1])});
    return all;
}

std::vector<SurfaceColor> LayeredColor::integrated(std::size_t count, double tolerance,
                                                   const SpectraAt& spectra_at) const {
    PanelTree tree(tables_, [](std::vector<double> wavelength_nm, const IndexFit*) {
        return SpectralPoints{std::move(wavelength_nm), nullptr, 0};
    });
    const PanelTree::Start start = tree.start(panels(kSmoothPath_nm), tolerance);
    const SampleAt sample = [&](std::span<const SpectralPoints* const> parts, Samples& samples) {
        const std::vector<double> values = spectra_at(wavelengths_of(parts));
        for (std::size_t k = 0; k < count; ++k)
            std::copy_n(values.data() + k * samples.points(), samples.points(), samples.row(k));
    };
    IntegrationMemory memory;
    std::vector<ColorIntegral> integrals(count);
    integrate_color(tables_.sensitivity(), start, 0, sample,
                    {std::max(1e-12, tolerance / 2), kMostWavelengths, execution_.simd}, memory,
                    integrals);
    std::vector<SurfaceColor> colors;
    for (const ColorIntegral& integral : integrals)
        colors.push_back({integral.xyz, integral.error});
    return colors;
}

void LayeredColor::add_first_layer(std::span<const ScatterPair> pairs,
                                   std::span<const double> factors,
                                   std::span<SurfaceColor> colors) const {
    const LayerTransport& layer = scattering_.layer(0);
    std::vector<double> angles;
    std::vector<MirrorFacet> facets;
    for (const ScatterPair& pair : pairs) {
        facets.push_back(mirror_facet(pair.theta_i_deg, pair.theta_o_deg, pair.phi_deg));
        angles.push_back(facets.back().theta_d_deg);
    }
    keep_once(angles);
    ColorRequest request;
    request.tolerance = std::max(kSmallestTolerance, tolerance_ / 2);
    request.colors = angles.size();
    request.simd = execution_.simd;
    const Stack& stack = layer.facets().stack();
    const auto algorithm = color_algorithm(tables_, stack, method_, request);
    const std::vector<StackColor> found =
        stack_color(*algorithm, stack, 1, angles, execution_.threads);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        const auto place = std::ranges::lower_bound(angles, facets[p].theta_d_deg) - angles.begin();
        const StackColor& color = found[static_cast<std::size_t>(place)];
        const double scale = kPi * factors[p] * lobe(layer.alpha(), facets[p]);
        for (std::size_t c = 0; c < 3; ++c) colors[p].xyz[c] += scale * color.xyz[c];
        if (scale > 0) colors[p].error += color.error * std::min(1.0, scale);
    }
}

/// Integral of R of a layer's facets times the transmission of the layers above on both ways.
SurfaceColor LayeredColor::lower_layer(std::size_t l, const ScatterPair& inside) const {
    const LayerTransport& layer = scattering_.layer(l);
    const Stack& stack = layer.facets().stack();
    const MirrorFacet facet = mirror_facet(inside.theta_i_deg, inside.theta_o_deg, inside.phi_deg);
    const IncidentAngle incidence = incident_angle(facet.theta_d_deg);
    const std::size_t polarizations = incidence.cos < 1 ? 2 : 1;
    const StackPower power(stack);
    Needs needs{.s = true, .p = true, .p_at_normal = false, .R = true, .T = false, .A = false};
    needs.denominators = true;
    PanelTree tree(tables_, [](std::vector<double> wavelength_nm, const IndexFit*) {
        return SpectralPoints{std::move(wavelength_nm), nullptr, 0};
    });
    const double path = path_of(stack.elements, IndexTable(stack, {550}));
    const PanelTree::Start start = tree.start(panels(path), tolerance_);
    Spectra out;
    const SampleAt sample = [&](std::span<const SpectralPoints* const> parts, Samples& samples) {
        const std::vector<double> wavelengths = wavelengths_of(parts);
        const IndexTable table(stack, wavelengths);
        spectra(power, table, {&incidence, 1}, needs, {1, execution_.simd}, out);
        const std::vector<double> through =
            scattering_.through(l, inside.theta_i_deg, inside.theta_o_deg, wavelengths);
        for (std::size_t j = 0; j < wavelengths.size(); ++j) {
            const double R = polarizations == 2 ? 0.5 * (out.s.R[j] + out.p.R[j]) : out.s.R[j];
            samples.row(0)[j] = R * through[j];
        }
        std::size_t row = 1;
        for (std::size_t k = 0; k < polarizations; ++k) {
            const Spectrum& of = k == 0 ? out.s : out.p;
            std::ranges::copy(of.denominator_re, samples.row(row++));
            std::ranges::copy(of.denominator_im, samples.row(row++));
            std::ranges::copy(of.log_scale, samples.row(row++));
        }
    };
    IntegrationMemory memory;
    ColorIntegral integral;
    integrate_color(tables_.sensitivity(), start, polarizations, sample,
                    {std::max(1e-12, tolerance_ / 2), 1U << 18U, execution_.simd}, memory,
                    {&integral, 1});
    return {integral.xyz, integral.error};
}

std::vector<SurfaceColor> LayeredColor::brdf(std::span<const ScatterPair> pairs,
                                             Paths paths) const {
    const Coating& coating = scattering_.coating();
    std::vector<ScatterPair> inside;
    std::vector<double> factors;
    for (const ScatterPair& pair : pairs) {
        const Coating::Crossing i = coating.inward(pair.theta_i_deg);
        const Coating::Crossing o = coating.inward(pair.theta_o_deg);
        inside.push_back({i.theta_deg, o.theta_deg, pair.phi_deg});
        factors.push_back(i.T * o.T * coating.dilution());
    }
    std::vector<SurfaceColor> colors(pairs.size());
    if (scattering_.layers() > 0) add_first_layer(inside, factors, colors);
    for (std::size_t l = 1; l < scattering_.layers(); ++l)
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            const MirrorFacet facet =
                mirror_facet(inside[p].theta_i_deg, inside[p].theta_o_deg, inside[p].phi_deg);
            const double scale = kPi * factors[p] * lobe(scattering_.layer(l).alpha(), facet);
            const SurfaceColor below = lower_layer(l, inside[p]);
            for (std::size_t c = 0; c < 3; ++c) colors[p].xyz[c] += scale * below.xyz[c];
            colors[p].error += below.error * std::min(1.0, scale);
        }
    const bool is_added = paths == Paths::all && !scattering_.is_closed();
    if (is_added) add_rest_of(pairs, colors);
    if (!scattering_.has_base()) return colors;
    if (is_added) paths = Paths::single;
    for (std::size_t begin = 0; begin < pairs.size(); begin += kColorsTogether) {
        const std::size_t count = std::min(kColorsTogether, pairs.size() - begin);
        const std::vector<SurfaceColor> base =
            integrated(count, tolerance_, [&](const std::vector<double>& wavelengths) {
                return scattering_.base_brdf(pairs.subspan(begin, count), wavelengths, paths, kPi);
            });
        for (std::size_t p = 0; p < count; ++p) {
            for (std::size_t c = 0; c < 3; ++c) colors[begin + p].xyz[c] += base[p].xyz[c];
            colors[begin + p].error += base[p].error;
        }
    }
    return colors;
}

/// Adds the multiply reflected light, computed by Adding.
void LayeredColor::add_rest_of(std::span<const ScatterPair> pairs,
                               std::span<SurfaceColor> colors) const {
    const double tolerance = std::max(tolerance_, kAddingTolerance);
    const Adding adding(scattering_, tolerance, execution_);
    // one level for all wavelengths: what it leaves is smooth, too
    constexpr std::array kJudged_nm{430.0, 460.0, 500.0, 540.0, 570.0, 600.0, 640.0};
    const Adding::Level level = adding.level_of(pairs, {kJudged_nm.begin(), kJudged_nm.end()});
    const double error = level.error;
    const std::vector<SurfaceColor> rest =
        integrated(pairs.size(), tolerance, [&](const std::vector<double>& wavelengths) {
            std::vector<double> values = adding.brdf_rest(pairs, wavelengths, level.level);
            for (double& value : values) value *= kPi;
            return values;
        });
    for (std::size_t p = 0; p < colors.size(); ++p) {
        for (std::size_t c = 0; c < 3; ++c) colors[p].xyz[c] += rest[p].xyz[c];
        const double whole = std::ranges::max(colors[p].xyz);
        colors[p].error += rest[p].error + error * std::min(1.0, whole);
    }
}

std::vector<SurfaceColor> LayeredColor::albedo(std::span<const double> theta_i_deg,
                                               Paths paths) const {
    if (paths == Paths::all && !scattering_.is_closed()) {
        std::vector<SurfaceColor> colors = albedo(theta_i_deg, Paths::single);
        const double tolerance = std::max(tolerance_, kAddingTolerance);
        const Adding adding(scattering_, tolerance, execution_);
        double error = 0;
        const std::vector<SurfaceColor> rest =
            integrated(theta_i_deg.size(), tolerance, [&](const std::vector<double>& wavelengths) {
                Adding::Values values = adding.albedo_rest(theta_i_deg, wavelengths);
                error = std::max(error, values.error);
                return values.values;
            });
        for (std::size_t i = 0; i < colors.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) colors[i].xyz[c] += rest[i].xyz[c];
            colors[i].error += rest[i].error + error;
        }
        return colors;
    }
    std::vector<SurfaceColor> colors;
    for (std::size_t begin = 0; begin < theta_i_deg.size(); begin += kColorsTogether) {
        const std::size_t count = std::min(kColorsTogether, theta_i_deg.size() - begin);
        const std::vector<SurfaceColor> some =
            integrated(count, tolerance_, [&](const std::vector<double>& wavelengths) {
                return scattering_.albedo(theta_i_deg.subspan(begin, count), wavelengths, paths);
            });
        colors.insert(colors.end(), some.begin(), some.end());
    }
    return colors;
}

}  // namespace irido
