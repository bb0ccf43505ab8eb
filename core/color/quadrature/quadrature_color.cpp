#include "core/color/quadrature/quadrature_color.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>

#include "core/coherent/fringe_mean.hpp"
#include "core/coherent/media.hpp"
#include "core/color/held_stack.hpp"
#include "core/color/quadrature/fixed_layers_cache.hpp"
#include "core/color/quadrature/integration.hpp"
#include "core/color/quadrature/left_out_fringes.hpp"
#include "core/color/quadrature/stack_path.hpp"
#include "core/error.hpp"
#include "core/math/pool.hpp"
#include "core/spectrum/spectrum.hpp"
#include "core/spectrum/stack_power.hpp"

namespace irido {

namespace {

/// Layers computed for one spectrum before it is given up, about a second's worth of either kernel,
/// and points that any stack may have.
/// Means may take longer: where they are tried, points do not resolve the fringes.
constexpr double kMostVectorWork = 1e9, kMostPlainWork = 2e7, kMostMeanWork = 1e8,
                 kFewestPoints = 4096;

/// Points of a panel that is not cut any further.
constexpr std::size_t kPanelPoints = 129;

/// Optical paths are rounded up to kShortestPath_nm 2^(k/2), k < kPathClasses.
constexpr double kShortestPath_nm = 125;
constexpr std::size_t kPathClasses = 128;

std::size_t path_class(double path_nm) {
    const double k = std::ceil(2 * std::log2(path_nm / kShortestPath_nm));
    return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(kPathClasses - 1)));
}

double path_of_class(std::size_t k) {
    return kShortestPath_nm * std::exp2(static_cast<double>(k) / 2);
}

/// Fringes of longer paths than kFine_nm, and those that the evaluations do not resolve at
/// kPointsPerPath a nm, may be left out. A period's mean is as rich as fringes of a path of
/// kPeriodsOfMean periods.
constexpr double kFine_nm = 4e6, kPointsPerPath = 0.032, kPeriodsOfMean = 4;

/// Layers of a path below this share of the fringes' have no lines as narrow as these.
constexpr double kSlow = 0.01;

/// Stacks of as many layers get their spectra from interpolated denominators: points of fewer take
/// no longer than interpolation.
constexpr double kFollowedWork = 16;

/// Smaller tolerances are within reach of the roundings of interpolation.
constexpr double kFollowedTolerance = 1e-8;

/// What R or T may be off from flux / |D|^2 where it is that.
constexpr double kRoundingOfFlux = 1e-10;
constexpr std::size_t kFluxStep = 5;  ///< between points where that is checked

/// Part of a wavelength within which the slope of a table jumps.
constexpr double kKinkStep = 1e-7;

/// Squares of normal indices below this part of the index' own are taken to be that.
constexpr double kLeastNormal = 1e-6;

std::vector<SpectralPanel> panels_of(const std::vector<double>& ends, double path_nm) {
    std::vector<SpectralPanel> panels;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
        panels.push_back(
            {{ends[i], ends[i + 1]}, std::numbers::pi * path_nm * (1 / ends[i] - 1 / ends[i + 1])});
    return panels;
}

/// Wavelengths at which paths are as long as anywhere, more or less.
std::vector<double> path_wavelengths(bool constant, WavelengthRange support) {
    if (constant) return {support.first_nm, support.last_nm};
    std::vector<double> wavelengths;
    for (int i = 0; i <= 4; ++i)
        wavelengths.push_back(support.first_nm + (support.last_nm - support.first_nm) * i / 4);
    return wavelengths;
}

/// Whether a material's k is known between the wavelengths of the survey from what it is there.
bool is_surveyed(const Material& material) {
    const std::span<const Material> parts = parts_of(material);
    if (!parts.empty()) return std::ranges::all_of(parts, is_surveyed);
    const auto* index = std::get_if<RefractiveIndex>(&material.model);
    return index != nullptr && !std::holds_alternative<Formula>(index->k);
}

/// The elements that hold varied layers, ascending.
std::vector<std::size_t> varied_elements(const Stack& stack, std::span<const LayerPlace> varied) {
    std::vector<std::size_t> elements;
    for (const LayerPlace& place : varied) {
        if (place.empty() || place[0] >= stack.elements.size())
            throw DomainError("varied layers must be layers of the stack");
        elements.push_back(place[0]);
    }
    std::ranges::sort(elements);
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
    return elements;
}

class QuadratureColor : public ColorAlgorithm {
public:
    QuadratureColor(const ColorTables& tables, const Stack& stack, const ColorRequest& request)
        : tables_(tables),
          sensitivity_(tables.sensitivity()),
          request_(request),
          held_(held_stack(stack, sensitivity_)),
          keeps_rows_(has_incoherent_layers(held_.elements)),
          pieces_(smooth_pieces(held_, sensitivity_.support(), keeps_rows_)),
          constant_(std::ranges::all_of(held_.materials,
                                        [](const Material& m) { return is_constant(m); })),
          on_path_(held_, path_wavelengths(constant_, sensitivity_.support())),
          needs_(needs_of(request)),
          varied_(varied_elements(held_, request.varied)),
          fixed_layers_(request.kept_numbers),
          smooth_(held_, sensitivity_),
          tree_(
              tables,
              [this](std::vector<double> wavelength_nm, const IndexFit* fit) {
                  SpectralPoints points{std::move(wavelength_nm), nullptr};
                  if (constant_) return points;
                  auto indices = std::make_unique<IndexTable>(held_, points.wavelength_nm);
                  if (fit) fit->replace(*indices);
                  points.indices = std::move(indices);
                  return points;
              },
              keeps_rows_ ? nullptr : &smooth_) {
        const IndexTable survey(held_, smooth_pieces(held_, sensitivity_.support()));
        absorbs_ = survey.absorbs();
        amplifies_ = survey.amplifies();
        for (std::size_t m = 0; m < held_.materials.size(); ++m) {
            if (is_surveyed(held_.materials[m])) continue;
            absorbs_[m] = true;
            amplifies_[m] = true;
        }
        needs_.denominators = true;
        const auto is_true = [](bool is) { return is; };
        is_lossless_ = constant_ && !keeps_rows_ && std::ranges::none_of(absorbs_, is_true) &&
                       std::ranges::none_of(amplifies_, is_true);
    }

    void operator()(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const override {
        const Pool<Scratch>::Loan scratch = scratch_.borrow();
        const SpectrumKernel& kernel = kernel_of(stack, *scratch);
        const std::size_t sides = request_.sides.size();
        const double most = kernel.is_vectorized() ? kMostVectorWork : kMostPlainWork;
        const auto affordable =
            static_cast<std::size_t>(std::max(kFewestPoints, most / work_of(stack.elements)));
        const IntegrationLimits limits{request_.tolerance,
                                       std::min(request_.evaluations, affordable), request_.simd};
        for (std::size_t i = 0; i < angles_deg.size(); ++i)
            integrate(kernel, stack, incident_angle(angles_deg[i]), limits,
                      colors.subspan(i * sides, sides), *scratch);
    }

private:
    struct Scratch {
        std::optional<StackPower> power;
        std::optional<SpectrumKernel> kernel;
        FixedLayers fixed;
        std::vector<const FixedLayers*> fixed_parts;
        Spectra spectra;
        SpectrumMemory memory;
        std::vector<Complex> normal;
        std::vector<const IndexTable*> parts;
        std::vector<const std::vector<double>*> wavelengths;
        std::optional<IndexTable> indices;  ///< of several parts
        IntegrationMemory integration;
        std::vector<ColorIntegral> integrals;
        std::vector<Medium> media;
        std::vector<double> effects;
        std::array<LeftOutFringes, 2> left_out;  ///< of s and p
        std::vector<LeftOutFringes::Kink> kinks;
    };

    const SpectrumKernel& kernel_of(const Stack& stack, Scratch& scratch) const {
        if (!scratch.kernel) {
            scratch.power.emplace(held_);
            scratch.kernel.emplace(*scratch.power, absorbs_, amplifies_, needs_, request_.simd,
                                   varied_);
        }
        if (scratch.kernel->shares_layers() && !differs_in_varied_only(stack))
            throw DomainError("only varied layers may differ from stack to stack");
        scratch.power->assign(stack);
        scratch.kernel->update();
        return *scratch.kernel;
    }

    bool differs_in_varied_only(const Stack& stack) const {
        if (stack.elements.size() != held_.elements.size()) return false;
        auto varied = varied_.begin();
        for (std::size_t i = 0; i < stack.elements.size(); ++i) {
            if (varied != varied_.end() && *varied == i) {
                ++varied;
            } else if (stack.elements[i] != held_.elements[i]) {
                return false;
            }
        }
        return true;
    }

    double optical_path_nm(std::span<const Element> elements, IncidentAngle incidence, Gaps gaps,
                           std::vector<Complex>& normal) const {
        double longest = 0;
        normal.resize(on_path_.materials());
        // exponents alone make the last wavelength differ where media are constant
        const std::size_t count =
            constant_ && gaps == Gaps::attenuate ? 1 : on_path_.wavelength_nm().size();
        for (std::size_t w = 0; w < count; ++w) {
            for (std::size_t m = 0; m < normal.size(); ++m)
                normal[m] = longest_normal(on_path_, m, w, incidence);
            Path path;
            add_path(elements, normal, on_path_.k0()[w], opaque_exponent(request_.tolerance), gaps,
                     path);
            longest = std::max(longest, path.length_nm);
        }
        return longest;
    }

    /// Of IntegrationLimits.
    std::span<const double> index_effects(IncidentAngle incidence,
                                          std::vector<double>& effects) const {
        effects.assign(on_path_.materials(), 0);
        for (std::size_t m = 0; m < effects.size(); ++m) {
            if (!smooth_.is_tabulated(m)) continue;
            for (std::size_t w = 0; w < on_path_.wavelength_nm().size(); ++w) {
                const Medium here =
                    medium(on_path_.index(m, w), on_path_.n(on_path_.incident(), w), incidence);
                effects[m] = std::max(
                    effects[m], std::sqrt(std::abs(here.eps)) /
                                    std::max(std::abs(here.q2), kLeastNormal * std::abs(here.eps)));
            }
        }
        return effects;
    }

    void integrate(const SpectrumKernel& kernel, const Stack& stack, IncidentAngle incidence,
                   const IntegrationLimits& limits, std::span<StackColor> colors,
                   Scratch& scratch) const {
        if (incidence.cos == 0 && reflects_all(kernel, scratch)) return fill_with_white(colors);
        const auto path_of = [&](Gaps gaps) {
            return optical_path_nm(stack.elements, incidence, gaps, scratch.normal);
        };
        const bool follows = is_lossless_ && kernel.is_vectorized() &&
                             work_of(stack.elements) >= kFollowedWork &&
                             limits.tolerance >= kFollowedTolerance;
        const double path_nm = path_of(Gaps::attenuate), longest_nm = path_of(Gaps::have_bands);
        const bool is_fine = longest_nm > kFine_nm ||
                             kPointsPerPath * longest_nm > static_cast<double>(limits.evaluations);
        for (StackColor& color : colors) color.error = std::numeric_limits<double>::infinity();
        if (is_fine && try_mean(stack, incidence, longest_nm, limits, colors, scratch)) return;
        const PanelTree::Start& start = start_of(path_class(path_nm), follows);
        IntegrationLimits known = limits;
        Transmission through;
        through.sides = request_.sides;
        if (follows) known.transmission = &through;
        bool is_first = follows;
        if (!constant_) known.index_effects = index_effects(incidence, scratch.effects);
        // at normal incidence one polarization stands for both
        const bool with_s = needs_.s;
        const bool with_p = needs_.p && !(with_s && incidence.cos == 1);
        std::shared_ptr<FixedLayersCache::Angle> angle;
        if (kernel.shares_layers()) angle = fixed_layers_.at(incidence);
        const SampleAt sample = [&](std::span<const SpectralPoints* const> parts,
                                    Samples& samples) {
            const bool is_fixed = angle && fix_layers(kernel, parts, incidence, *angle, scratch);
            const IndexTable& indices = indices_at(parts, scratch);
            if (is_fixed) {
                kernel(indices, {&incidence, 1}, scratch.fixed_parts, scratch.spectra,
                       scratch.memory);
            } else {
                kernel(indices, {&incidence, 1}, scratch.spectra, scratch.memory);
            }
            const Spectra& at = scratch.spectra;
            const Spectrum& one = with_s ? at.s : at.p;
            const Spectrum* const other = with_s && with_p ? &at.p : nullptr;
            fill(one, other, samples);
            if (!is_first) return;
            is_first = false;
            through.holds =
                has_flux(one, through.flux[0]) && (!other || has_flux(*other, through.flux[1]));
        };
        scratch.integrals.resize(colors.size());
        integrate_color(sensitivity_, start, with_s && with_p ? 2 : 1, sample, known,
                        scratch.integration, scratch.integrals);
        for (std::size_t i = 0; i < colors.size(); ++i)
            take_better(colors[i], scratch.integrals[i], scratch.integrals[i].error);
        const bool done = std::ranges::all_of(
            colors, [&](const StackColor& c) { return c.error <= limits.tolerance; });
        if (!done && !is_fine) try_mean(stack, incidence, longest_nm, limits, colors, scratch);
    }

    /// Whether T is flux / |D|^2, as it is where all waves travel.
    static bool has_flux(const Spectrum& spectrum, double& flux) {
        const auto size_at = [&](std::size_t j) {
            return spectrum.denominator_re[j] * spectrum.denominator_re[j] +
                   spectrum.denominator_im[j] * spectrum.denominator_im[j];
        };
        const auto T_at = [&](std::size_t j) {
            return spectrum.T.empty() ? 1 - spectrum.R[j] : spectrum.T[j];
        };
        std::size_t clearest = 0;
        for (std::size_t j = 0; j < spectrum.log_scale.size(); ++j) {
            if (spectrum.log_scale[j] != 0) return false;
            if (size_at(j) < size_at(clearest)) clearest = j;
        }
        flux = T_at(clearest) * size_at(clearest);
        if (!(flux > 0)) return false;
        for (std::size_t j = 0; j < spectrum.log_scale.size(); j += kFluxStep)
            if (!(std::abs(T_at(j) - flux / size_at(j)) <= kRoundingOfFlux)) return false;
        return true;
    }

    static void take_better(StackColor& color, const ColorIntegral& integral, double error) {
        if (error < color.error || !std::isfinite(color.error))
            color = {integral.xyz, error, integral.evaluations, "quadrature"};
    }

    /// The mean over the phase of the element of the longest path, where its fringes are too fine
    /// to be seen; false if it is not known to the tolerance.
    bool try_mean(const Stack& stack, IncidentAngle incidence, double path_nm,
                  const IntegrationLimits& limits, std::span<StackColor> colors,
                  Scratch& scratch) const {
        if (keeps_rows_ || incidence.cos == 0 || !scratch.power->has_amplitudes() ||
            std::ranges::find(amplifies_, true) != amplifies_.end())
            return false;
        std::size_t fast = 0;
        double longest_nm = 0, period_nm = 0;
        for (std::size_t i = 0; i < stack.elements.size(); ++i) {
            const auto path_of = [&](std::span<const Element> elements) {
                return optical_path_nm(elements, incidence, Gaps::have_bands, scratch.normal);
            };
            const double nm = path_of({&stack.elements[i], 1});
            if (nm <= longest_nm) continue;
            fast = i;
            longest_nm = nm;
            const Group* group = std::get_if<Group>(&stack.elements[i].value);
            period_nm = group ? path_of(group->elements) : 0;
        }
        const PanelTree::Start& start =
            start_of(path_class(std::max(0.0, path_nm - longest_nm) + kPeriodsOfMean * period_nm));
        const bool only_edges = period_nm > 0 && path_nm - longest_nm < kSlow * longest_nm;
        const std::size_t polarizations = needs_.s && needs_.p && incidence.cos < 1 ? 2 : 1;
        for (LeftOutFringes& fringes : scratch.left_out) fringes.clear();
        const SampleAt sample = [&](std::span<const SpectralPoints* const> parts,
                                    Samples& samples) {
            fill_with_means(stack, fast, incidence, polarizations, indices_at(parts, scratch),
                            samples, scratch);
        };
        const auto affordable = static_cast<std::size_t>(
            std::max(kFewestPoints, kMostMeanWork / work_of(stack.elements)));
        scratch.integrals.resize(colors.size());
        IntegrationLimits half{limits.tolerance / 2, std::min(request_.evaluations, affordable),
                               limits.simd};
        if (!constant_) half.index_effects = index_effects(incidence, scratch.effects);
        integrate_color(sensitivity_, start, polarizations, sample, half, scratch.integration,
                        scratch.integrals);
        kinks_of(stack.elements[fast], 1, scratch.kinks);
        bool done = true;
        for (std::size_t i = 0; i < colors.size(); ++i) {
            double error = scratch.integrals[i].error;
            for (std::size_t k = 0; k < polarizations; ++k)
                error += (scratch.left_out[k].error(request_.sides[i], tables_, only_edges) +
                          scratch.left_out[k].at_kinks(request_.sides[i], tables_, scratch.kinks)) /
                         static_cast<double>(polarizations);
            done = done && error <= limits.tolerance;
            take_better(colors[i], scratch.integrals[i], error);
        }
        return done;
    }

    /// Rows of the tables of an element's materials.
    void kinks_of(const Element& element, double repeat,
                  std::vector<LeftOutFringes::Kink>& kinks) const {
        kinks.clear();
        if (constant_) return;
        std::vector<double> length_nm(held_.materials.size());
        add_lengths(element, repeat, length_nm);
        for (std::size_t m = 0; m < length_nm.size(); ++m) {
            if (length_nm[m] == 0) continue;
            const Material& material = held_.materials[m];
            for (const double nm : table_rows(material, sensitivity_.support())) {
                const double step = kKinkStep * nm;
                const double jump = index_at(material, nm + step).real() +
                                    index_at(material, nm - step).real() -
                                    2 * index_at(material, nm).real();
                kinks.push_back({nm, 2 * length_nm[m] * nm * std::abs(jump) / step});
            }
        }
    }

    static void add_lengths(const Element& element, double repeat, std::vector<double>& length_nm) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            length_nm[layer->material] += repeat * layer->thickness_nm;
            return;
        }
        const Group& group = std::get<Group>(element.value);
        for (const Element& inner : group.elements)
            add_lengths(inner, repeat * static_cast<double>(group.repeat), length_nm);
    }

    /// Means of the polarizations, and their denominators.
    void fill_with_means(const Stack& stack, std::size_t fast, IncidentAngle incidence,
                         std::size_t polarizations, const IndexTable& indices, Samples& samples,
                         Scratch& scratch) const {
        const std::size_t sides = request_.sides.size();
        std::vector<Medium>& media = scratch.media;
        for (std::size_t j = 0; j < samples.points(); ++j) {
            for (std::size_t side = 0; side < sides; ++side) samples.row(side)[j] = 0;
            for (std::size_t k = 0; k < polarizations; ++k) {
                const auto polarization = needs_.s && k == 0 ? Polarization::s : Polarization::p;
                set_media(indices, j, incidence, polarization, media);
                const FringeMean mean =
                    fringe_mean(stack, fast, media, indices.k0()[j], polarization);
                scratch.left_out[k].add(indices.wavelength_nm()[j], mean);
                for (std::size_t side = 0; side < sides; ++side)
                    samples.row(side)[j] +=
                        (request_.sides[side] == Side::reflected ? mean.R : mean.T) /
                        static_cast<double>(polarizations);
                const std::size_t row = sides + 3 * k;
                samples.row(row)[j] = mean.denominator.real();
                samples.row(row + 1)[j] = mean.denominator.imag();
                samples.row(row + 2)[j] = mean.log_scale;
            }
        }
    }

    /// Whether nothing enters the stack at 90 degrees, at any wavelength, as is so unless nothing
    /// reflects at any angle.
    bool reflects_all(const SpectrumKernel& kernel, Scratch& scratch) const {
        if (std::ranges::find(amplifies_, true) != amplifies_.end()) return false;
        const IncidentAngle grazing(0);
        kernel(on_path_, {&grazing, 1}, scratch.spectra, scratch.memory);
        const auto is_one = [](double R) { return R == 1; };
        const auto is_zero = [](double T) { return T == 0; };
        return std::ranges::all_of(
            std::array{&scratch.spectra.s, &scratch.spectra.p}, [&](const Spectrum* of) {
                return std::ranges::all_of(of->R, is_one) && std::ranges::all_of(of->T, is_zero);
            });
    }

    void fill_with_white(std::span<StackColor> colors) const {
        constexpr double rounding = 1e-15;
        for (std::size_t i = 0; i < colors.size(); ++i)
            colors[i] = {request_.sides[i] == Side::reflected ? sensitivity_.white() : Triple{},
                         rounding, on_path_.wavelength_nm().size(), "quadrature"};
    }

    const PanelTree::Start& start_of(std::size_t path, bool follows = false) const {
        const std::scoped_lock guard(lock_);
        std::unique_ptr<PanelTree::Start>& start = starts_[{path, follows}];
        if (start) return *start;
        start = std::make_unique<PanelTree::Start>(
            tree_.start(panels_of(pieces_, path_of_class(path)), request_.tolerance,
                        request_.evaluations / kPanelPoints / 4, follows));
        if (constant_)
            start->points.indices =
                std::make_unique<IndexTable>(held_, start->points.wavelength_nm);
        return *start;
    }

    const IndexTable& indices_at(std::span<const SpectralPoints* const> parts,
                                 Scratch& scratch) const {
        if (parts.size() == 1 && parts[0]->indices) return *parts[0]->indices;
        if (!scratch.indices) scratch.indices = on_path_;
        if (constant_) {
            scratch.wavelengths.clear();
            for (const SpectralPoints* part : parts)
                scratch.wavelengths.push_back(&part->wavelength_nm);
            scratch.indices->assign(on_path_, scratch.wavelengths);
        } else {
            scratch.parts.clear();
            for (const SpectralPoints* part : parts) scratch.parts.push_back(part->indices.get());
            scratch.indices->assign(scratch.parts);
        }
        return *scratch.indices;
    }

    /// Gathers what does not vary; false if there is no room for it.
    bool fix_layers(const SpectrumKernel& kernel, std::span<const SpectralPoints* const> parts,
                    IncidentAngle incidence, FixedLayersCache::Angle& angle,
                    Scratch& scratch) const {
        fixed_layers_.find(angle, parts, scratch.fixed_parts);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (scratch.fixed_parts[i]) continue;
            kernel.fix_layers(indices_at(parts.subspan(i, 1), scratch), incidence, scratch.fixed,
                              scratch.memory);
            scratch.fixed_parts[i] = fixed_layers_.add(angle, *parts[i], scratch.fixed);
            if (!scratch.fixed_parts[i]) return false;
        }
        return true;
    }

    /// Rows from one polarization, or the mean of two.
    void fill(const Spectrum& first, const Spectrum* second, Samples& samples) const {
        const std::size_t points = samples.points(), sides = request_.sides.size();
        for (std::size_t side = 0; side < sides; ++side) {
            const auto values =
                request_.sides[side] == Side::reflected ? &Spectrum::R : &Spectrum::T;
            const double* a = (first.*values).data();
            double* row = samples.row(side);
            std::copy_n(a, points, row);
            if (!second) continue;
            const double* b = (second->*values).data();
            for (std::size_t j = 0; j < points; ++j) row[j] = (a[j] + b[j]) / 2;
        }
        std::size_t row = sides;
        for (const Spectrum* spectrum : {&first, second}) {
            if (!spectrum) break;
            for (const auto values :
                 {&Spectrum::denominator_re, &Spectrum::denominator_im, &Spectrum::log_scale})
                std::copy_n((spectrum->*values).data(), points, samples.row(row++));
        }
    }

    const ColorTables& tables_;
    const Sensitivity& sensitivity_;
    ColorRequest request_;
    Stack held_;
    /// Rows of tables end panels: what an incoherent layer absorbs follows k however fast it
    /// changes, and no slope of the coherent denominators tells how much a fit of k would lose.
    bool keeps_rows_;
    std::vector<double> pieces_;  ///< ends of what is smooth
    bool constant_;               ///< all indices
    bool is_lossless_ = false;    ///< and without k
    IndexTable on_path_;          ///< at the wavelengths that tell how long the path is
    Needs needs_;
    std::vector<bool> absorbs_, amplifies_;
    std::vector<std::size_t> varied_;  ///< elements, if only these differ
    mutable FixedLayersCache fixed_layers_;
    SmoothIndices smooth_;
    mutable PanelTree tree_;
    mutable Pool<Scratch> scratch_;
    mutable std::mutex lock_;
    /// By path class, and whether spectra follow from denominators.
    mutable std::map<std::pair<std::size_t, bool>, std::unique_ptr<PanelTree::Start>> starts_;
};

}  // namespace

std::unique_ptr<ColorAlgorithm> quadrature_color(const ColorTables& tables, const Stack& stack,
                                                 const ColorRequest& request) {
    return std::make_unique<QuadratureColor>(tables, stack, request);
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
