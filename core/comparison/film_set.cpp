#include "core/comparison/film_set.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/coherent/coherent.hpp"
#include "core/color/held_stack.hpp"
#include "core/color/stack_color.hpp"
#include "core/error.hpp"
#include "core/material/library.hpp"
#include "core/math/parallel.hpp"
#include "core/math/random.hpp"

namespace irido {

namespace {

constexpr std::array<std::string_view, 3> kBaseKinds{"dielectric", "conductor", "colored"};

constexpr std::array<std::string_view, 4> kColoredBases{"Au", "Cu", "brass", "TiN"};

Material constant_material(double n, double k) {
    Material material;
    material.model = RefractiveIndex{Constant{n}, Constant{k}};
    return material;
}

/// A film in air on a base.
Stack film_stack(const EngineFilm& film, Material base) {
    Layer layer;
    layer.material = 1;
    layer.thickness_nm = film.thickness_nm;
    return {{Material(), constant_material(film.film_n, 0), std::move(base)}, 0, {{layer}}, 2};
}

bool is_gray(const EngineFilm& film) {
    const auto is_one = [](const Triple& t) { return t[0] == t[1] && t[1] == t[2]; };
    return is_one(film.base_n) && is_one(film.base_k);
}

/// Draws films; the indices of coloured bases are computed once.
class RandomFilms {
public:
    RandomFilms(const ColorTables& tables, std::uint64_t seed) : tables_(tables), random_(seed) {}

    ComparedFilm operator()(const std::optional<BaseKind>& asked) {
        const BaseKind base =
            asked ? *asked : static_cast<BaseKind>(random_.below(kBaseKinds.size()));
        EngineFilm film;
        film.film_n = drawn(1.2, 2.6, 1000);
        film.thickness_nm = drawn(5, 1000, 10);
        const double angle_deg = drawn(0, 85, 10);
        const auto id = [&](const std::string& base_text) {
            return "1 | " + to_text(film.film_n) + "@" + to_text(film.thickness_nm) + " | " +
                   base_text + "; " + to_text(angle_deg) + " deg";
        };
        if (base == BaseKind::colored) return colored(film, angle_deg, id);
        const bool conducts = base == BaseKind::conductor;
        const double n = conducts ? drawn(0.1, 4, 1000) : drawn(1, 2.6, 1000);
        const double k = conducts ? drawn(0.5, 6, 1000) : 0;
        film.base_n = {n, n, n};
        film.base_k = {k, k, k};
        return compared_film(id(to_text(n) + (conducts ? "+" + to_text(k) + "i" : "")), angle_deg,
                             film);
    }

private:
    /// Uniform, rounded to 1/steps.
    double drawn(double from, double to, double steps) {
        return std::round(random_.uniform(from, to) * steps) / steps;
    }

    template <class Id>
    ComparedFilm colored(EngineFilm film, double angle_deg, const Id& id) {
        const std::size_t which = random_.below(kColoredBases.size());
        const std::string name(kColoredBases[which]);
        Stack stack = film_stack(film, find_material(name).value().material);
        std::optional<EngineFilm>& base = bases_[which];
        if (!base) base = given_film(tables_, held_stack(stack, tables_.sensitivity())).film;
        film.base_n = base->base_n;
        film.base_k = base->base_k;
        film.base_f0 = base->base_f0;
        film.base_f82_tint = base->base_f82_tint;
        film.cos_theta = cos_of_incidence(angle_deg);
        return {id(name), angle_deg, film, std::move(stack)};
    }

    const ColorTables& tables_;
    Random random_;
    std::array<std::optional<EngineFilm>, kColoredBases.size()> bases_;
};

/// The naive method on one index per channel.
Triple naive_of_channels(const ColorTables& tables, const ComparedEngine& engine,
                         const ComparedFilm& film, const ColorRequest& request) {
    const RgbTransform transform(rgb_space("srgb"), tables.sensitivity().white(),
                                 Adaptation::bradford);
    Triple rgb{};
    for (std::size_t c = 0; c < 3; ++c) {
        const Stack stack =
            film_stack(film.film, constant_material(film.film.base_n[c], film.film.base_k[c]));
        StackColor color;
        (*color_algorithm(tables, stack, engine.method, request))(stack, {&film.angle_deg, 1},
                                                                  {&color, 1});
        rgb[c] = transform(color.xyz)[c];
    }
    return rgb;
}

void compare_film(const ColorTables& tables, std::span<const ComparedEngine> engines,
                  const EngineDifference& difference, const ComparedFilm& film,
                  const ColorRequest& request, std::span<EngineColor> out) {
    if (film.stack) {
        const StackComparison compare(tables, engines, difference, *film.stack, request,
                                      given_film(film.film, *film.stack));
        std::ranges::copy(compare(*film.stack, {&film.angle_deg, 1}), out.begin());
        return;
    }
    for (std::size_t e = 0; e < engines.size(); ++e) {
        if (engines[e].engine) {
            out[e].rgb = engines[e].engine->reflectance(film.film);
        } else if (engines[e].method.is("naive")) {
            out[e].rgb = naive_of_channels(tables, engines[e], film, request);
        }
    }
}

/// Quantile, interpolated between sorted values.
double quantile(const std::vector<double>& sorted, double part) {
    const double at = part * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(at);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

std::string_view name_of(BaseKind base) {
    return kBaseKinds[static_cast<std::size_t>(base)];
}

std::span<const std::string_view> base_kind_names() {
    return kBaseKinds;
}

BaseKind base_kind(std::string_view name) {
    const auto found = std::ranges::find(kBaseKinds, name);
    if (found == kBaseKinds.end()) throw DomainError("base " + not_one_of(kBaseKinds, name));
    return static_cast<BaseKind>(found - kBaseKinds.begin());
}

BaseKind ComparedFilm::base() const {
    if (!is_gray(film)) return BaseKind::colored;
    return film.is_conductor() ? BaseKind::conductor : BaseKind::dielectric;
}

ComparedFilm compared_film(std::string id, double angle_deg, EngineFilm film) {
    film.cos_theta = cos_of_incidence(angle_deg);
    film = with_base(film);
    ComparedFilm result{std::move(id), angle_deg, film};
    if (is_gray(film))
        result.stack = film_stack(film, constant_material(film.base_n[0], film.base_k[0]));
    return result;
}

std::vector<ComparedFilm> random_films(const ColorTables& tables, std::size_t count,
                                       std::uint64_t seed, const std::optional<BaseKind>& base) {
    RandomFilms draw(tables, seed);
    std::vector<ComparedFilm> films;
    films.reserve(count);
    for (std::size_t i = 0; i < count; ++i) films.push_back(draw(base));
    return films;
}

std::vector<EngineColor> compare_films(const ColorTables& tables,
                                       std::span<const ComparedEngine> engines,
                                       const EngineDifference& difference,
                                       std::span<const ComparedFilm> films,
                                       const ColorRequest& request, unsigned threads) {
    std::vector<EngineColor> result(films.size() * engines.size());
    parallel_for(films.size(), threads, [&](std::size_t i) {
        compare_film(tables, engines, difference, films[i], request,
                     std::span(result).subspan(i * engines.size(), engines.size()));
    });
    return result;
}

DifferenceSummary summary_of(std::span<const std::optional<double>> values) {
    DifferenceSummary summary;
    std::vector<double> sorted;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!values[i]) continue;
        if (sorted.empty() || *values[i] > summary.max) {
            summary.max = *values[i];
            summary.worst = i;
        }
        summary.mean += *values[i];
        sorted.push_back(*values[i]);
    }
    summary.count = sorted.size();
    if (sorted.empty()) return summary;
    std::ranges::sort(sorted);
    summary.mean /= static_cast<double>(sorted.size());
    summary.median = quantile(sorted, 0.5);
    summary.p95 = quantile(sorted, 0.95);
    return summary;
}

}  // namespace irido
