#include "tables/shaders/scene/scene_error.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/color/held_stack.hpp"
#include "core/color/stack_color.hpp"
#include "core/film/film.hpp"
#include "core/math/angle_of_cosine.hpp"
#include "core/math/parallel.hpp"
#include "core/math/random.hpp"
#include "schemas/documents/varied_stack.hpp"
#include "tables/lut/color_values.hpp"

namespace irido::tables {

namespace {

constexpr std::uint64_t kSeeds = 0x9e3779b97f4a7c15U;  ///< distance between seeds
constexpr std::size_t kChunk = 64;                     ///< points that one thread takes at a time

double within(const LutAxis& axis, Random& random) {
    return random.uniform(axis.values.front(), axis.values.back());
}

double one_of(const LutAxis& axis, Random& random) {
    return axis.values[random.below(axis.count())];
}

double level_of(const LutAxis& axis, bool all, Random& random) {
    return all ? one_of(axis, random) : axis.values[0];
}

double worst_of(const RandomPoints& points, const std::function<double(Random&)>& difference) {
    const std::size_t chunks = (points.count + kChunk - 1) / kChunk;
    std::vector<double> worst(chunks, 0.0);
    parallel_for(chunks, points.threads, [&](std::size_t chunk) {
        const std::size_t last = std::min(points.count, (chunk + 1) * kChunk);
        for (std::size_t i = chunk * kChunk; i < last; ++i) {
            Random random((points.seed + i) * kSeeds);
            worst[chunk] = std::max(worst[chunk], difference(random));
        }
    });
    return *std::ranges::max_element(worst);
}

std::vector<LutAxis> axes_at(const LutPlan& plan, const std::vector<double>& place) {
    std::vector<LutAxis> axes;
    for (std::size_t a = 0; a < place.size(); ++a) {
        axes.push_back(plan.axes[a].axis);
        axes.back().values = {place[a]};
    }
    return axes;
}

bool is_list(const LutPlan& plan, std::size_t a) {
    return plan.axes[a].fixed;
}

/// The level of a standard deviation in the table, as computed by the snippet fourier.
double level_of_spread(const std::vector<double>& sigmas, double sigma_nm) {
    const auto fade = [](double sigma) {
        const double waves = sigma / 550;
        return std::exp(-2 * std::numbers::pi * std::numbers::pi * waves * waves);
    };
    if (sigmas.size() < 2 || sigma_nm <= 0) return 0;
    std::size_t low = 0;
    while (low + 2 < sigmas.size() && sigma_nm > sigmas[low + 1]) ++low;
    const double from = fade(sigmas[low]), to = fade(sigmas[low + 1]);
    return static_cast<double>(low) +
           std::clamp((from - fade(sigma_nm)) / std::max(from - to, 1e-9), 0.0, 1.0);
}

/// H_j from a sensitivity table.
class TableOfSensitivity {
public:
    explicit TableOfSensitivity(const Lut& lut) : lut_(lut) {
        const auto& request = lut.facts.at("request");
        if (const auto carrier = request.find("carrier_nm"); carrier != request.end())
            for (std::size_t j = 0; j < 3; ++j) carrier_nm_[j] = (*carrier)[j].get<double>();
    }

    double longest_nm() const { return lut_.axes.back().values.back(); }
    const std::vector<double>& sigmas() const { return lut_.axes.front().values; }

    std::array<Complex, 3> at(double opd_nm, double level) const {
        const double low = std::floor(level);
        std::array<Complex, 3> h = of_level(opd_nm, static_cast<std::size_t>(low));
        if (level > low) {
            const auto high = of_level(opd_nm, static_cast<std::size_t>(low) + 1);
            for (std::size_t j = 0; j < 3; ++j) h[j] += (high[j] - h[j]) * (level - low);
        }
        return h;
    }

private:
    std::array<Complex, 3> of_level(double opd_nm, std::size_t level) const {
        const std::vector<double> values =
            lut_.mips ? sampled(lut_, level, {opd_nm})
                      : sampled(lut_, 0, {lut_.axes.front().values[level], opd_nm});
        std::array<Complex, 3> h;
        for (std::size_t j = 0; j < 3; ++j) {
            h[j] = {values[j], values.size() > 3 ? values[3 + j] : 0};
            if (carrier_nm_[j] > 0)
                h[j] *= std::polar(1.0, 2 * std::numbers::pi * opd_nm / carrier_nm_[j]);
        }
        return h;
    }

    const Lut& lut_;
    Triple carrier_nm_{};
};

/// The equivalent of the shader's irido_film().
Triple film_xyz(const Film& film, double cos_theta, int orders, double sigma_nm,
                const Triple& white, const TableOfSensitivity* table) {
    Triple xyz{};
    for (const Polarization p : {Polarization::s, Polarization::p}) {
        const auto series = film_series(film, cos_theta, p);
        if (!series) return white;
        Triple sum;
        for (std::size_t j = 0; j < 3; ++j) sum[j] = (1 - series->T) * white[j];
        Complex power = 1;
        for (int m = 1; m <= orders && table; ++m) {
            const double path = m * series->opd_nm;
            if (path > table->longest_nm()) break;
            power *= series->bounce;
            const double q2 = std::sqrt(film.film * film.film - film.incident * film.incident *
                                                                    (1 - cos_theta * cos_theta));
            const double level = level_of_spread(table->sigmas(), 2 * m * q2 * sigma_nm);
            const auto h = table->at(path, level);
            for (std::size_t j = 0; j < 3; ++j) sum[j] -= 2 * series->T * (power * h[j]).real();
        }
        for (std::size_t j = 0; j < 3; ++j) xyz[j] += 0.5 * sum[j];
    }
    return xyz;
}

RefractiveIndex constant_index(Complex index) {
    return {Constant{index.real()}, Constant{index.imag()}};
}

/// The stack with the indices that shaders use, at every wavelength.
Stack without_dispersion(Stack stack, const Sensitivity& sensitivity) {
    const Stack held = held_stack(stack, sensitivity);
    for (std::size_t m = 0; m < stack.materials.size(); ++m) {
        const Material& material = held.materials[m];
        stack.materials[m].model = constant_index(index_at(material, kShaderIndices_nm));
        if (!is_uniaxial(material)) continue;
        Uniaxial medium{{Material{material.name, stack.materials[m].model},
                         Material{material.name, constant_index(extraordinary_index_at(
                                                     material, kShaderIndices_nm))}}};
        stack.materials[m].model = std::move(medium);
    }
    return stack;
}

/// A few samples of a range, or its only one.
std::vector<double> few_of(const std::vector<double>& samples) {
    constexpr std::size_t few = 9;
    return samples.size() < 2 ? samples : equally_spaced(samples.front(), samples.back(), few);
}

}  // namespace

std::vector<double> sampled(const Lut& lut, std::size_t level, const std::vector<double>& place) {
    struct Corner {
        std::size_t index;
        double weight;
    };
    const std::vector<LutAxis> axes = lut.mips ? lut.axes_of_level(level) : lut.axes;
    std::size_t start = 0;
    for (std::size_t l = 0; lut.mips && l < level; ++l) start += lut.values_of_level(l);
    std::vector<Corner> corners{{0, 1}};
    for (std::size_t a = 0; a < axes.size(); ++a) {
        const std::vector<double>& x = axes[a].values;
        const std::size_t i = axes[a].cell_of(place[a]);
        const double w =
            x.size() > 1 ? std::clamp((place[a] - x[i]) / (x[i + 1] - x[i]), 0.0, 1.0) : 0;
        std::vector<Corner> next;
        for (const Corner& corner : corners) {
            next.push_back({corner.index * x.size() + i, corner.weight * (1 - w)});
            if (w > 0) next.push_back({corner.index * x.size() + i + 1, corner.weight * w});
        }
        corners = std::move(next);
    }
    const std::size_t channels = lut.channels.size();
    std::vector<double> values(channels, 0.0);
    for (const Corner& corner : corners)
        for (std::size_t c = 0; c < channels; ++c)
            values[c] += corner.weight * lut.values[start + corner.index * channels + c];
    return values;
}

double worst_difference(const LutPlan& plan, const Lut& lut, const RandomPoints& points) {
    return worst_of(points, [&](Random& random) {
        std::vector<double> place;
        for (std::size_t a = 0; a < plan.axes.size(); ++a) {
            const LutAxis& axis = plan.axes[a].axis;
            place.push_back(plan.mips && a == 0 ? level_of(axis, points.all_levels, random)
                            : is_list(plan, a)  ? one_of(axis, random)
                                                : within(axis, random));
        }
        std::vector<double> approximate;
        if (lut.mips) {
            const auto& levels = lut.axes.front().values;
            const auto level = std::ranges::find(levels, place.front()) - levels.begin();
            approximate =
                sampled(lut, static_cast<std::size_t>(level), {place.begin() + 1, place.end()});
        } else {
            approximate = sampled(lut, 0, place);
        }
        const std::vector<LutAxis> axes = axes_at(plan, place);
        return plan.measure.differences(axes, plan.evaluate(axes), approximate).front();
    });
}

double worst_fourier_difference(const schemas::Scene& scene, const schemas::SceneMaterial& material,
                                const MaterialPlan& plan, const Lut* sensitivity,
                                const Execution& execution, const RandomPoints& points) {
    LutRequest request = color_request_of(scene, material, execution);
    const bool has_spread = material.thickness_spread_nm > 0 && !request.vary.empty();
    if (has_spread)
        request.options["sigma"] =
            std::vector{0.0, material.thickness_spread_nm / 3, material.thickness_spread_nm};
    const LutPlan exact = find_lut_kind("color")->plan(request);
    const ColorValues values(request);
    const std::vector<std::string> paths = paths_of(request.vary);
    const schemas::VariedStack stack(request.source, paths);
    const auto table = sensitivity ? std::make_unique<TableOfSensitivity>(*sensitivity) : nullptr;
    return worst_of(points, [&](Random& random) {
        std::vector<double> place;
        for (std::size_t a = 0; a < exact.axes.size(); ++a) {
            const LutAxis& axis = exact.axes[a].axis;
            place.push_back(exact.mips && a == 0 ? level_of(axis, points.all_levels, random)
                                                 : within(axis, random));
        }
        const auto varied = place.end() - static_cast<std::ptrdiff_t>(paths.size());
        const Film film = shader_film(stack.at(std::vector<double>(varied, place.end())));
        const double sigma_nm = has_spread ? place.front() : 0, cos_theta = *(varied - 1);
        const Triple seen = values(film_xyz(film, cos_theta, plan.constants["orders"].get<int>(),
                                            sigma_nm, request.sensitivity->white(), table.get()));
        const std::vector<LutAxis> axes = axes_at(exact, place);
        return exact.measure.differences(axes, exact.evaluate(axes), seen).front();
    });
}

double dispersion_difference(const schemas::Scene& scene, const schemas::SceneMaterial& material,
                             const Execution& execution) {
    const LutRequest request = color_request_of(scene, material, execution);
    const ColorTables tables(*request.sensitivity);
    const ColorValues values(request);
    const schemas::VariedStack varied(request.source, paths_of(request.vary));
    const LutMeasure measure = color_measure(request);
    std::vector<double> angles_deg;
    for (const double cosine : few_of(request.list("cos")))
        angles_deg.push_back(angle_of_cosine(cosine));
    const auto colors = [&](const Stack& stack) {
        std::vector<double> all;
        for (const StackColor& color :
             stack_color(tables, stack, {}, request.color, angles_deg, execution.threads))
            std::ranges::copy(values(color.xyz), std::back_inserter(all));
        return all;
    };
    std::vector<std::vector<double>> places{{}};
    for (const VariedValue& vary : request.vary) {
        std::vector<std::vector<double>> more;
        for (const auto& place : places)
            for (const double value : few_of(vary.values)) {
                more.push_back(place);
                more.back().push_back(value);
            }
        places = std::move(more);
    }
    double worst = 0;
    for (const auto& place : places) {
        const Stack stack = varied.at(place);
        const std::vector<double> exact = colors(stack),
                                  seen = colors(without_dispersion(stack, *request.sensitivity));
        worst = std::max(worst, std::ranges::max(measure.differences({}, exact, seen)));
    }
    return worst;
}

}  // namespace irido::tables
