#include "core/color/quadrature/quadrature_color.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>

#include "core/coherent/fringe_mean.hpp"
#include "core/coherent/media.hpp"
#include "core/color/held_stack.hpp"
#include "core/color/quadrature/fixed_layers_cache.hpp"
#include "core/color/quadrature/flux.hpp"
#include "core/color/quadrature/fringe_sums.hpp"
#include "core/color/quadrature/integration.hpp"
#include "core/color/quadrature/left_out_fringes.hpp"
#include "core/color/quadrature/optical_path.hpp"
#include "core/color/quadrature/panel_starts.hpp"
#include "core/color/quadrature/point_indices.hpp"
#include "core/color/quadrature/sampled_fringes.hpp"
#include "core/error.hpp"
#include "core/math/pool.hpp"
#include "core/spectrum/spectrum.hpp"
#include "core/spectrum/stack_power.hpp"

namespace irido {

namespace {

/// Layers computed for one spectrum before it is given up, some seconds of either kernel, and
/// points that any stack may have. Means, where points do not resolve the fringes, may take longer.
constexpr double kMostVectorWork = 1e10, kMostPlainWork = 2e7, kMostMeanWork = 1e8,
                 kFewestPoints = 4096;

/// Colours of a structure times its rows from which on the tables are fitted: that takes 2 ms, a
/// row that ends a panel 0.4 us of each colour.
constexpr double kFitsRepaid = 6000;

/// Points at which the waves that means leave out may be looked at.
constexpr std::size_t kFewestWavePoints = 1U << 15;

/// Points of a panel that is not cut any further.
constexpr std::size_t kPanelPoints = 129;

/// Fringes of longer paths than kFine_nm, and those that the evaluations do not resolve at
/// kPointsPerPath a nm, may be left out. A period's mean is as rich as fringes of a path of
/// kPeriodsOfMean periods.
constexpr double kFine_nm = 4e6, kPeriodsOfMean = 4;

/// Fringes of longer paths are cheaper left out, and added as waves, than followed one by one, if
/// the rest of the stack has less than kRest of the path.
constexpr double kWaves_nm = 4e5, kRest = 0.1;

/// Parts of the tolerance: of the means, if what they leave out is bounded or added as waves, and
/// of the waves. Next to gap edges the means follow a dozen fringes, which may hide between points:
/// their error is up to kMeanDoubt times the estimate, which such bounds outweigh and waves do not.
constexpr double kOfMeans = 0.5, kOfMeansWithWaves = 0.01, kOfWaves = 0.1, kMeanDoubt = 40;

/// Larger tolerances leave narrow features of the waves unseen, and their errors with them.
constexpr double kResolved = 1e-6;

/// Layers of a path below this share of the fringes' have no lines as narrow as these.
constexpr double kSlow = 0.01;

/// Stacks of as many layers get their spectra from interpolated denominators: points of fewer take
/// no longer than interpolation.
constexpr double kFollowedWork = 16;

/// Smaller tolerances are within reach of the roundings of interpolation.
constexpr double kFollowedTolerance = 1e-8;

/// Fringes of a path are sampled if there may be so many points for each; and the points that there
/// may be, by the layers computed and by the limit on evaluations.
constexpr double kSamplesOfFringe = 16, kMostSampledWork = 4e8;
constexpr std::size_t kSamplesOfEvaluation = 8;

/// Samples are of means over an element whose path is longer than all others by this factor: its
/// phase may be a multiple of others', and their waves of that order are too weak to beat with it.
constexpr double kFarBeats = 1000;

class QuadratureColor : public ColorAlgorithm {
public:
    QuadratureColor(const ColorTables& tables, const Stack& stack, const ColorRequest& request)
        : tables_(tables),
          sensitivity_(tables.sensitivity()),
          request_(request),
          held_(held_stack(stack, sensitivity_)),
          constant_(std::ranges::all_of(held_.materials,
                                        [](const Material& m) { return is_constant(m); })),
          smooth_(held_, sensitivity_),
          has_gaps_(has_incoherent_layers(held_.elements)),
          keeps_rows_(has_gaps_ || !are_fits_repaid()),
          on_path_(held_, path_wavelengths(constant_, sensitivity_.support())),
          needs_(needs_of(request)),
          varied_(varied_elements(held_, request.varied)),
          fixed_layers_(request.kept_numbers),
          starts_(constant_ && varied_.empty() ? tables.constant_starts() : own_starts()) {
        survey();
        needs_.denominators = true;
        is_lossless_ = constant_ && !has_gaps_ && std::ranges::none_of(absorbs_, std::identity()) &&
                       std::ranges::none_of(amplifies_, std::identity());
    }

    void operator()(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const override {
        const Pool<Scratch>::Loan scratch = scratch_of_all().borrow();
        if (varied_.empty())
            return compute(kernel_of(stack, scratch->prepared), stack, angles_deg, colors,
                           *scratch);
        const Pool<Prepared>::Loan prepared = prepared_.borrow();
        compute(kernel_of_varied(stack, *prepared), stack, angles_deg, colors, *scratch);
    }

private:
    struct Prepared {
        std::optional<StackPower> power;
        std::optional<SpectrumKernel> kernel;
    };
    struct Scratch;

    void compute(const SpectrumKernel& kernel, const Stack& stack,
                 std::span<const double> angles_deg, std::span<StackColor> colors,
                 Scratch& scratch) const {
        scratch.kernel = &kernel;
        const std::size_t sides = request_.sides.size();
        const double most = kernel.is_vectorized() ? kMostVectorWork : kMostPlainWork;
        const auto affordable =
            static_cast<std::size_t>(std::max(kFewestPoints, most / work_of(stack.elements)));
        const IntegrationLimits limits{request_.tolerance,
                                       std::min(request_.evaluations, affordable), request_.simd};
        for (std::size_t i = 0; i < angles_deg.size(); ++i)
            integrate(kernel, stack, incident_angle(angles_deg[i]), limits,
                      colors.subspan(i * sides, sides), scratch);
    }

    /// Memory for colours of any stacks.
    struct Scratch {
        Prepared prepared;
        const SpectrumKernel* kernel = nullptr;  ///< of the stack at hand
        PointIndices indices;
        const SpectralPoints* first = nullptr;  ///< with which its colour begins
        FixedLayers fixed;
        std::vector<const FixedLayers*> fixed_parts;
        Spectra spectra;
        SpectrumMemory memory;
        std::vector<Complex> normal;
        IntegrationMemory integration;
        std::vector<ColorIntegral> integrals;
        std::vector<Medium> media;
        std::vector<double> effects;
        std::array<LeftOutFringes, 2> left_out;  ///< of s and p
        std::vector<LeftOutFringes::Kink> kinks;
        std::vector<BranchPoint> branch_points;
    };

    std::shared_ptr<const PanelStarts> own_starts() const {
        return std::make_shared<const PanelStarts>(
            tables_, smooth_pieces(held_, sensitivity_.support(), keeps_rows_),
            [this](std::vector<double> wavelength_nm, const IndexFit* fit) {
                auto indices = std::make_unique<IndexTable>(held_, wavelength_nm);
                if (fit) fit->replace(*indices);
                return SpectralPoints{std::move(wavelength_nm), std::move(indices)};
            },
            keeps_rows_ ? nullptr : &smooth_);
    }

    /// Which materials absorb and amplify.
    void survey() {
        if (constant_) {
            absorbs_ = on_path_.absorbs();
            amplifies_ = on_path_.amplifies();
            return;
        }
        const IndexTable at_ends(held_, smooth_pieces(held_, sensitivity_.support()));
        absorbs_ = at_ends.absorbs();
        amplifies_ = at_ends.amplifies();
        branch_points_.emplace(held_, at_ends);
        for (std::size_t m = 0; m < held_.materials.size(); ++m) {
            if (is_surveyed(held_.materials[m])) continue;
            absorbs_[m] = true;
            amplifies_[m] = true;
        }
    }

    std::span<const BranchPoint> branch_points_at(IncidentAngle incidence, Scratch& scratch) const {
        if (!branch_points_) return {};
        branch_points_->find(incidence, scratch.branch_points);
        return scratch.branch_points;
    }

    bool are_fits_repaid() const {
        return static_cast<double>(request_.colors) * static_cast<double>(smooth_.rows()) >=
               kFitsRepaid * static_cast<double>(request_.structures);
    }

    static Pool<Scratch>& scratch_of_all() {
        static Pool<Scratch> pool;
        return pool;
    }

    const SpectrumKernel& kernel_of(const Stack& stack, Prepared& prepared) const {
        auto& [power, kernel] = prepared;
        if (kernel) {
            power->assign(stack);
            kernel->serve(absorbs_, amplifies_, needs_, request_.simd);
        } else {
            power.emplace(stack);
            kernel.emplace(*power, absorbs_, amplifies_, needs_, request_.simd);
        }
        return *kernel;
    }

    const SpectrumKernel& kernel_of_varied(const Stack& stack, Prepared& prepared) const {
        auto& [power, kernel] = prepared;
        if (!kernel) {
            power.emplace(held_);
            kernel.emplace(*power, absorbs_, amplifies_, needs_, request_.simd, varied_);
        }
        if (kernel->shares_layers() && !differs_in_varied_only(stack))
            throw DomainError("only varied layers may differ from stack to stack");
        power->assign(stack);
        kernel->update();
        return *kernel;
    }

    bool has_fits() const { return !constant_ && !keeps_rows_; }

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

    void integrate(const SpectrumKernel& kernel, const Stack& stack, IncidentAngle incidence,
                   const IntegrationLimits& limits, std::span<StackColor> colors,
                   Scratch& scratch) const {
        if (incidence.cos == 0 && reflects_all(kernel, scratch)) return fill_with_white(colors);
        const bool follows = is_lossless_ && kernel.is_vectorized() &&
                             work_of(stack.elements) >= kFollowedWork &&
                             limits.tolerance >= kFollowedTolerance;
        const double opaque = opaque_exponent(limits.tolerance);
        const auto [path_nm, longest_nm] =
            longest_paths(stack.elements, on_path_, incidence, opaque, scratch.normal);
        const bool has_mean = longest_nm > kWaves_nm || is_fine(longest_nm, limits);
        for (StackColor& color : colors) color.error = std::numeric_limits<double>::infinity();
        if (has_mean && try_mean(stack, incidence, longest_nm, limits, colors, scratch)) return;
        // more fringes than can be followed
        const bool has_samples = kPointsPerPath * path_nm > static_cast<double>(limits.evaluations);
        if (has_samples && try_samples(stack, incidence, longest_nm, limits, colors, scratch))
            return;
        const PanelTree::Start& start = start_of(path_class(path_nm), follows);
        scratch.first = &start.points;
        IntegrationLimits known = limits;
        Transmission through;
        through.sides = request_.sides;
        if (follows) known.transmission = &through;
        bool is_first = follows;
        if (has_fits()) known.index_effects = smooth_.effects(on_path_, incidence, scratch.effects);
        known.branch_points = branch_points_at(incidence, scratch);
        known.has_all_poles = scratch.kernel->spread_layers() == 0;
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
            fill_samples(request_.sides, one, other, samples);
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
        const auto is_done = [&] {
            return std::ranges::all_of(
                colors, [&](const StackColor& c) { return c.error <= limits.tolerance; });
        };
        if (!is_done() && !has_mean)
            try_mean(stack, incidence, longest_nm, limits, colors, scratch);
        if (!is_done() && has_mean && !has_samples)
            try_samples(stack, incidence, longest_nm, limits, colors, scratch);
    }

    static void take_better(StackColor& color, const ColorIntegral& integral, double error) {
        if (error < color.error || !std::isfinite(color.error))
            color = {integral.xyz, error, integral.evaluations, "quadrature"};
    }

    /// Elements of the longest paths, those of all others, and those of a period.
    struct FastElements {
        std::vector<std::size_t> indices;
        double rest_nm, period_nm;
    };
    FastElements fast_elements(const Stack& stack, IncidentAngle incidence, double path_nm,
                               const IntegrationLimits& limits, Scratch& scratch,
                               std::size_t most = 2) const {
        const double opaque = opaque_exponent(limits.tolerance);
        const auto path_of = [&](std::span<const Element> elements) {
            return longest_paths(elements, on_path_, incidence, opaque, scratch.normal)
                .with_bands_nm;
        };
        std::vector<double> paths_nm;
        for (const Element& element : stack.elements) paths_nm.push_back(path_of({&element, 1}));
        FastElements fast{{}, path_nm, 0};
        do {
            const auto i =
                static_cast<std::size_t>(std::ranges::max_element(paths_nm) - paths_nm.begin());
            fast.indices.push_back(i);
            fast.rest_nm = std::max(0.0, fast.rest_nm - paths_nm[i]);
            paths_nm[i] = 0;
            if (const Group* group = std::get_if<Group>(&stack.elements[i].value))
                fast.period_nm += path_of(group->elements);
        } while (fast.indices.size() < most && is_fine(fast.rest_nm, limits));
        std::ranges::sort(fast.indices);
        return fast;
    }

    /// Whether the stack has a fringe_form().
    bool has_forms(IncidentAngle incidence, const Scratch& scratch) const {
        return !has_gaps_ && incidence.cos > 0 && scratch.kernel->has_amplitudes() &&
               std::ranges::find(amplifies_, true) == amplifies_.end();
    }

    /// Sums over fringes that are too many to be followed one by one, of all elements or of all but
    /// the one of the longest path; false if they are not known to the tolerance.
    bool try_samples(const Stack& stack, IncidentAngle incidence, double path_nm,
                     const IntegrationLimits& limits, std::span<StackColor> colors,
                     Scratch& scratch) const {
        if (!has_forms(incidence, scratch)) return false;
        const double most =
            std::min(static_cast<double>(kSamplesOfEvaluation * request_.evaluations),
                     kMostSampledWork / work_of(stack.elements));
        const WavelengthRange range = sensitivity_.support();
        const double longest_nm =
            most / (kSamplesOfFringe * (1 / range.first_nm - 1 / range.last_nm));
        FastElements fast{{}, path_nm, 0};
        double left_out = 0;
        if (path_nm > longest_nm) {
            fast = fast_elements(stack, incidence, path_nm, limits, scratch, 1);
            if (kFarBeats * fast.rest_nm > path_nm) return false;
            left_out = tables_.decay()(path_nm - fast.rest_nm);
        }
        const double sampled_nm = fast.rest_nm + fast.period_nm;
        if (sampled_nm > longest_nm) return false;
        std::vector<Polarization> polarizations;
        if (needs_.s) polarizations.push_back(Polarization::s);
        if (needs_.p && (!needs_.s || incidence.cos < 1)) polarizations.push_back(Polarization::p);
        const std::vector<SampledSum> sums = sampled_fringes(
            sensitivity_, {held_, stack, incidence, polarizations, fast.indices}, request_.sides,
            {limits.tolerance - left_out, static_cast<std::size_t>(most), sampled_nm});
        bool is_met = true;
        for (std::size_t i = 0; i < colors.size(); ++i) {
            const double error = sums[i].error + left_out;
            take_better(colors[i], {sums[i].xyz, error, sums[i].evaluations}, error);
            is_met = is_met && error <= limits.tolerance;
        }
        return is_met;
    }

    static bool is_fine(double path_nm, const IntegrationLimits& limits) {
        return path_nm > kFine_nm ||
               kPointsPerPath * path_nm > static_cast<double>(limits.evaluations);
    }

    /// The mean over the phases of the elements of the longest paths, whose fringes are too fine to
    /// be seen or are added as waves; false if it is not known to the tolerance.
    bool try_mean(const Stack& stack, IncidentAngle incidence, double path_nm,
                  const IntegrationLimits& limits, std::span<StackColor> colors,
                  Scratch& scratch) const {
        if (!has_forms(incidence, scratch)) return false;
        const FastElements fast = fast_elements(stack, incidence, path_nm, limits, scratch);
        if (!is_fine(path_nm, limits) && fast.rest_nm > kRest * path_nm) return false;
        const auto affordable = static_cast<std::size_t>(
            std::max(kFewestPoints, kMostMeanWork / work_of(stack.elements)));
        const double mean_nm = fast.rest_nm + kPeriodsOfMean * fast.period_nm;
        if (kPointsPerPath * mean_nm > static_cast<double>(affordable)) return false;
        const PanelTree::Start& start = start_of(path_class(mean_nm));
        scratch.first = &start.points;
        const std::size_t polarizations = needs_.s && needs_.p && incidence.cos < 1 ? 2 : 1;
        for (LeftOutFringes& fringes : scratch.left_out) fringes.clear();
        const SampleAt sample = [&](std::span<const SpectralPoints* const> parts,
                                    Samples& samples) {
            fill_with_means(stack, fast.indices, incidence, polarizations,
                            indices_at(parts, scratch), samples, scratch);
        };
        scratch.integrals.resize(colors.size());
        const bool has_waves = fast.indices.size() > 1 || !is_fine(path_nm, limits);
        const double of_all = has_waves ? kOfMeansWithWaves * std::min(limits.tolerance, kResolved)
                                        : kOfMeans * limits.tolerance;
        IntegrationLimits of_means{std::max(kSmallestTolerance, of_all),
                                   std::min(request_.evaluations, affordable), limits.simd};
        if (has_fits())
            of_means.index_effects = smooth_.effects(on_path_, incidence, scratch.effects);
        of_means.branch_points = branch_points_at(incidence, scratch);
        integrate_color(sensitivity_, start, polarizations, sample, of_means, scratch.integration,
                        scratch.integrals);
        std::vector<double> errors(colors.size());
        for (std::size_t i = 0; i < colors.size(); ++i) errors[i] = scratch.integrals[i].error;
        std::vector<double> without_waves = errors;
        for (double& error : errors) error *= kMeanDoubt;
        const auto are_met = [&](const std::vector<double>& of) {
            return std::ranges::all_of(of, [&](double error) { return error <= limits.tolerance; });
        };
        const bool only_edges = fast.period_nm > 0 && fast.rest_nm < kSlow * path_nm;
        add_left_out(stack, fast.indices, polarizations, only_edges, scratch, without_waves);
        if (are_met(errors) && !are_met(without_waves)) {
            add_waves(stack, fast.indices, incidence, polarizations, limits, scratch, errors);
        } else {
            errors = without_waves;
        }
        for (std::size_t i = 0; i < colors.size(); ++i)
            take_better(colors[i], scratch.integrals[i], errors[i]);
        return are_met(errors);
    }

    /// Adds what fringes may do that are left out to the errors; of two elements it is not known.
    void add_left_out(const Stack& stack, std::span<const std::size_t> fast,
                      std::size_t polarizations, bool only_edges, Scratch& scratch,
                      std::vector<double>& errors) const {
        if (fast.size() > 1) {
            std::ranges::fill(errors, std::numeric_limits<double>::infinity());
            return;
        }
        scratch.kinks.clear();
        if (!constant_)
            kinks_of(stack.elements[fast[0]], held_, sensitivity_.support(), scratch.kinks);
        for (std::size_t i = 0; i < errors.size(); ++i)
            for (std::size_t k = 0; k < polarizations; ++k) {
                LeftOutFringes& fringes = scratch.left_out[k];
                errors[i] += (fringes.error(request_.sides[i], tables_, only_edges) +
                              fringes.at_kinks(request_.sides[i], tables_, scratch.kinks)) /
                             static_cast<double>(polarizations);
            }
    }

    /// Adds the waves that the means leave out.
    void add_waves(const Stack& stack, std::span<const std::size_t> fast, IncidentAngle incidence,
                   std::size_t polarizations, const IntegrationLimits& limits, Scratch& scratch,
                   std::vector<double>& errors) const {
        const std::vector<double> ends = smooth_pieces(held_, sensitivity_.support());
        for (std::size_t k = 0; k < polarizations; ++k) {
            const auto polarization = polarization_of(k);
            const FringeForms forms = [&](std::span<const double> nm, std::span<FringeForm> at) {
                const IndexTable indices(held_, {nm.begin(), nm.end()});
                for (std::size_t j = 0; j < nm.size(); ++j) {
                    set_media(indices, j, incidence, polarization, scratch.media);
                    at[j] = fringe_form(stack, fast, scratch.media, indices.k0()[j], polarization);
                }
            };
            const std::vector<FringeSum> sums =
                fringe_sums(sensitivity_, ends, fast.size(), request_.sides, forms,
                            {kOfWaves * std::min(limits.tolerance, kResolved),
                             std::max<std::size_t>(limits.evaluations / 8, kFewestWavePoints)});
            for (std::size_t i = 0; i < errors.size(); ++i) {
                for (std::size_t c = 0; c < 3; ++c)
                    scratch.integrals[i].xyz[c] +=
                        sums[i].xyz[c] / static_cast<double>(polarizations);
                errors[i] += sums[i].error / static_cast<double>(polarizations);
            }
        }
    }

    Polarization polarization_of(std::size_t k) const {
        return needs_.s && k == 0 ? Polarization::s : Polarization::p;
    }

    /// Means of the polarizations, and their denominators.
    void fill_with_means(const Stack& stack, std::span<const std::size_t> fast,
                         IncidentAngle incidence, std::size_t polarizations,
                         const IndexTable& indices, Samples& samples, Scratch& scratch) const {
        const std::size_t sides = request_.sides.size();
        std::vector<Medium>& media = scratch.media;
        for (std::size_t j = 0; j < samples.points(); ++j) {
            for (std::size_t side = 0; side < sides; ++side) samples.row(side)[j] = 0;
            for (std::size_t k = 0; k < polarizations; ++k) {
                const auto polarization = polarization_of(k);
                set_media(indices, j, incidence, polarization, media);
                const FringeMean mean =
                    fringe_mean(stack, fast, media, indices.k0()[j], polarization);
                scratch.left_out[k].add(indices.wavelength_nm()[j], mean);
                for (std::size_t side = 0; side < sides; ++side)
                    samples.row(side)[j] +=
                        (request_.sides[side] == Side::reflected ? mean.R : mean.T) /
                        static_cast<double>(polarizations);
                const std::size_t row = sides + 3 * k;
                samples.row(row)[j] = mean.form.denominator.real();
                samples.row(row + 1)[j] = mean.form.denominator.imag();
                samples.row(row + 2)[j] = mean.form.log_scale;
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
        return starts_->at(
            {path, follows, request_.tolerance, request_.evaluations / kPanelPoints / 4});
    }

    const IndexTable& indices_at(std::span<const SpectralPoints* const> parts,
                                 Scratch& scratch) const {
        const IndexTable* const constant = constant_ ? &on_path_ : nullptr;
        if (parts.size() == 1 && parts[0] == scratch.first)
            return scratch.indices.at_first(*parts[0], constant, id_);
        return scratch.indices.at(parts, constant);
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

    const ColorTables& tables_;
    const Sensitivity& sensitivity_;
    ColorRequest request_;
    Stack held_;
    bool constant_;             ///< all indices
    bool is_lossless_ = false;  ///< and without k
    SmoothIndices smooth_;
    bool has_gaps_;
    /// Rows of tables end panels, as they must with incoherent layers: what these absorb follows k
    /// however fast it changes, and no slope of the coherent denominators tells how much a fit of k
    /// would lose.
    bool keeps_rows_;
    IndexTable on_path_;  ///< at the wavelengths that tell how long the path is
    Needs needs_;
    std::vector<bool> absorbs_, amplifies_;
    std::optional<BranchPoints> branch_points_;
    std::vector<std::size_t> varied_;  ///< elements, if only these differ
    mutable FixedLayersCache fixed_layers_;
    mutable Pool<Prepared> prepared_;  ///< if only these differ
    std::shared_ptr<const PanelStarts> starts_;
    static inline std::atomic<std::size_t> made_ = 0;
    std::size_t id_ = ++made_;  ///< of this object alone
};

}  // namespace

std::unique_ptr<ColorAlgorithm> quadrature_color(const ColorTables& tables, const Stack& stack,
                                                 const ColorRequest& request) {
    return std::make_unique<QuadratureColor>(tables, stack, request);
}

}  // namespace irido
