#include "core/comparison/engine_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "core/coherent/coherent.hpp"
#include "core/colorimetry/difference.hpp"
#include "core/error.hpp"
#include "core/math/parallel.hpp"
#include "core/math/random.hpp"
#include "core/math/simplex_search.hpp"

namespace irido {

namespace {

/// The inputs that parameters act on.
struct EngineSetting {
    EngineFilm film;
    double factor = 1;
};

struct FormParameter {
    std::string_view name;
    double first, last, step;  ///< range and rounding
    void (*set)(EngineSetting& setting, double value);
    double (*get)(const EngineSetting& setting);
};

/// One material type of an engine.
struct EngineForm {
    std::string_view name;
    bool conducts;  ///< for engines that recognize metals by their k
    std::vector<FormParameter> parameters;
};

constexpr double kColorStep = 1e-4, kIndexStep = 1e-4, kThicknessStep_nm = 0.01;
constexpr double kThickest_nm = 1500;

template <std::size_t channel>
FormParameter base_color(std::string_view name) {
    return {name,
            0,
            1,
            kColorStep,
            [](EngineSetting& s, double value) { s.film.base_f0[channel] = value; },
            [](const EngineSetting& s) { return s.film.base_f0[channel]; }};
}

template <std::size_t channel>
FormParameter tint(std::string_view name) {
    return {name,
            0,
            1,
            kColorStep,
            [](EngineSetting& s, double value) { s.film.base_f82_tint[channel] = value; },
            [](const EngineSetting& s) { return s.film.base_f82_tint[channel]; }};
}

template <std::size_t channel>
FormParameter base_n(std::string_view name) {
    return {name,
            0.05,
            5,
            kIndexStep,
            [](EngineSetting& s, double value) { s.film.base_n[channel] = value; },
            [](const EngineSetting& s) { return s.film.base_n[channel]; }};
}

template <std::size_t channel>
FormParameter base_k(std::string_view name) {
    return {name,
            0,
            7,
            kIndexStep,
            [](EngineSetting& s, double value) { s.film.base_k[channel] = value; },
            [](const EngineSetting& s) { return s.film.base_k[channel]; }};
}

/// Index of a dielectric base.
FormParameter base_ior(std::string_view name) {
    return {name,
            1,
            3,
            kIndexStep,
            [](EngineSetting& s, double value) {
                s.film.base_n = {value, value, value};
                const double f0 = base_f0(value, 0);
                s.film.base_f0 = {f0, f0, f0};
            },
            [](const EngineSetting& s) { return s.film.base_n[1]; }};
}

FormParameter film_index(std::string_view name) {
    return {name,
            1,
            3,
            kIndexStep,
            [](EngineSetting& s, double value) { s.film.film_n = value; },
            [](const EngineSetting& s) { return s.film.film_n; }};
}

FormParameter thickness_nm(std::string_view name) {
    return {name,
            0,
            kThickest_nm,
            kThicknessStep_nm,
            [](EngineSetting& s, double value) { s.film.thickness_nm = value; },
            [](const EngineSetting& s) { return s.film.thickness_nm; }};
}

FormParameter thickness_um(std::string_view name) {
    return {name,
            0,
            kThickest_nm / 1000,
            kThicknessStep_nm / 1000,
            [](EngineSetting& s, double value) { s.film.thickness_nm = 1000 * value; },
            [](const EngineSetting& s) { return s.film.thickness_nm / 1000; }};
}

/// Unity's slider, expressed as the optical thickness of a film of index 1.5.
FormParameter slider(std::string_view name) {
    return {name,
            0,
            1,
            kColorStep,
            [](EngineSetting& s, double value) {
                s.film.film_n = 1.5;
                s.film.thickness_nm = 1000 * value;
            },
            [](const EngineSetting& s) { return unity_slider(s.film); }};
}

FormParameter factor(std::string_view name) {
    return {name,
            0,
            1,
            kColorStep,
            [](EngineSetting& s, double value) { s.factor = value; },
            [](const EngineSetting& s) { return s.factor; }};
}

std::vector<EngineForm> forms_of(std::string_view engine) {
    const EngineForm conductor{
        "",
        true,
        {base_n<0>("ior_r"), base_n<1>("ior_g"), base_n<2>("ior_b"), base_k<0>("extinction_r"),
         base_k<1>("extinction_g"), base_k<2>("extinction_b"), film_index("thinfilm_ior"),
         thickness_nm("thinfilm_thickness")}};
    if (engine == "gltf")
        return {{"",
                 true,
                 {base_color<0>("baseColorFactor_r"), base_color<1>("baseColorFactor_g"),
                  base_color<2>("baseColorFactor_b"), film_index("iridescenceIor"),
                  thickness_nm("iridescenceThicknessMaximum"), factor("iridescenceFactor")}}};
    if (engine == "three")
        return {{"",
                 true,
                 {base_color<0>("color_r"), base_color<1>("color_g"), base_color<2>("color_b"),
                  film_index("iridescenceIOR"), thickness_nm("iridescenceThicknessRange_1")}}};
    if (engine == "babylon")
        return {{"",
                 true,
                 {base_color<0>("albedoColor_r"), base_color<1>("albedoColor_g"),
                  base_color<2>("albedoColor_b"), film_index("indexOfRefraction"),
                  thickness_nm("maximumThickness")}}};
    if (engine == "unity")
        return {{"",
                 true,
                 {base_color<0>("baseColor_r"), base_color<1>("baseColor_g"),
                  base_color<2>("baseColor_b"), slider("iridescenceThickness")}}};
    if (engine == "materialx") return {conductor};
    if (engine == "materialx-gltf")
        return {{"",
                 true,
                 {base_color<0>("base_color_r"), base_color<1>("base_color_g"),
                  base_color<2>("base_color_b"), film_index("iridescence_ior"),
                  thickness_nm("iridescence_thickness")}}};
    if (engine == "openpbr")
        return {{"metal",
                 true,
                 {base_color<0>("base_color_r"), base_color<1>("base_color_g"),
                  base_color<2>("base_color_b"), tint<0>("specular_color_r"),
                  tint<1>("specular_color_g"), tint<2>("specular_color_b"),
                  film_index("thin_film_ior"), thickness_um("thin_film_thickness")}},
                {"dielectric",
                 false,
                 {base_ior("specular_ior"), film_index("thin_film_ior"),
                  thickness_um("thin_film_thickness")}}};
    if (engine == "cycles") {
        EngineForm form = conductor;
        form.parameters[6].name = "thin_film_ior";
        form.parameters[7].name = "thin_film_thickness";
        return {form};
    }
    return {{"metal",
             true,
             {base_color<0>("base_color_r"), base_color<1>("base_color_g"),
              base_color<2>("base_color_b"), tint<0>("specular_tint_r"), tint<1>("specular_tint_g"),
              tint<2>("specular_tint_b"), film_index("thin_film_ior"),
              thickness_nm("thin_film_thickness")}},
            {"dielectric",
             false,
             {base_ior("ior"), film_index("thin_film_ior"), thickness_nm("thin_film_thickness")}}};
}

/// One form of one engine, with its parameters scaled to the unit cube.
class FitProblem {
public:
    FitProblem(const ComparedEngine& engine, const EngineForm& form,
               const EngineDifference& difference, const FitTarget& target)
        : engine_(engine), form_(form), difference_(difference) {
        double sum = 0;
        for (const double weight : target.weights) sum += weight;
        for (std::size_t a = 0; a < target.angles_deg.size(); ++a) {
            cosines_.push_back(cos_of_incidence(target.angles_deg[a]));
            exact_lab_.push_back(difference.lab_of_exact(target.xyz[a]));
            weights_.push_back(target.weights[a] / sum);
        }
        // metals given by F0 and tint have no n and k, but must count as conductors
        const double k = form.conducts ? 1 : 0;
        plain_.film.base_k = {k, k, k};
    }

    std::size_t size() const { return form_.parameters.size(); }

    EngineSetting setting(std::span<const double> x) const {
        EngineSetting setting = plain_;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const FormParameter& p = form_.parameters[i];
            p.set(setting, p.first + x[i] * (p.last - p.first));
        }
        return setting;
    }

    std::vector<double> point_of(const EngineFilm& film) const {
        const EngineSetting setting{film, 1};
        std::vector<double> x;
        for (const FormParameter& p : form_.parameters)
            x.push_back(std::clamp((p.get(setting) - p.first) / (p.last - p.first), 0.0, 1.0));
        return x;
    }

    Triple rgb(EngineSetting& setting, std::size_t angle) const {
        setting.film.cos_theta = cosines_[angle];
        return engine_.engine == &kGltfEngine ? gltf_reflectance(setting.film, setting.factor)
                                              : engine_.engine->reflectance(setting.film);
    }

    /// Engine Lab minus exact Lab, weighted so that the sum of squares is the weighted mean square.
    void residuals(std::span<const double> x, Eigen::VectorXd& out) const {
        EngineSetting at = setting(x);
        out.resize(static_cast<Eigen::Index>(3 * cosines_.size()));
        for (std::size_t a = 0; a < cosines_.size(); ++a) {
            const Triple lab = difference_.lab_of_engine(engine_, rgb(at, a));
            const double scale = std::sqrt(weights_[a]);
            for (std::size_t c = 0; c < 3; ++c)
                out[static_cast<Eigen::Index>(3 * a + c)] = scale * (lab[c] - exact_lab_[a][c]);
        }
    }

    double mean_difference(std::span<const double> x) const {
        EngineSetting at = setting(x);
        double sum = 0;
        for (std::size_t a = 0; a < cosines_.size(); ++a)
            if (weights_[a] > 0) sum += weights_[a] * difference_at(at, a);
        return sum;
    }

    double difference_at(EngineSetting& at, std::size_t angle) const {
        return ciede2000(difference_.lab_of_engine(engine_, rgb(at, angle)), exact_lab_[angle]);
    }

    /// The rounded parameters and their differences.
    EngineFit result(std::span<const double> x) const {
        EngineFit fit;
        fit.form = form_.name;
        EngineSetting at = plain_;
        for (std::size_t i = 0; i < x.size(); ++i) {
            const FormParameter& p = form_.parameters[i];
            const double steps = std::round(1 / p.step);
            const double value = std::round((p.first + x[i] * (p.last - p.first)) * steps) / steps;
            p.set(at, value);
            fit.parameters.push_back({std::string(p.name), value});
        }
        for (std::size_t a = 0; a < cosines_.size(); ++a) {
            const double difference = difference_at(at, a);
            fit.delta_e_mean += weights_[a] * difference;
            if (weights_[a] > 0) fit.delta_e_max = std::max(fit.delta_e_max, difference);
            fit.rgb.push_back(rgb(at, a));
        }
        return fit;
    }

private:
    const ComparedEngine& engine_;
    const EngineForm& form_;
    const EngineDifference& difference_;
    std::vector<double> cosines_, weights_;
    std::vector<Triple> exact_lab_;
    EngineSetting plain_;
};

/// Levenberg-Marquardt descent of the sum of squared residuals in the unit cube; a parameter at an
/// end of its range with the gradient pointing outwards stays fixed.
void descend(const FitProblem& problem, std::vector<double>& x, int iterations) {
    constexpr double kStep = 1e-6;
    const auto n = static_cast<Eigen::Index>(x.size());
    Eigen::VectorXd r, moved;
    problem.residuals(x, r);
    Eigen::MatrixXd J(r.size(), n);
    double damping = 1e-2;
    for (int i = 0; i < iterations; ++i) {
        for (Eigen::Index j = 0; j < n; ++j) {
            std::vector<double> y = x;
            double& value = y[static_cast<std::size_t>(j)];
            const double step = value + kStep <= 1 ? kStep : -kStep;
            value += step;
            problem.residuals(y, moved);
            J.col(j) = (moved - r) / step;
        }
        const Eigen::VectorXd gradient = J.transpose() * r;
        Eigen::MatrixXd normal = J.transpose() * J;
        for (Eigen::Index j = 0; j < n; ++j) {
            const double at = x[static_cast<std::size_t>(j)];
            if ((at > 0 || gradient[j] < 0) && (at < 1 || gradient[j] > 0)) continue;
            normal.row(j).setZero();
            normal.col(j).setZero();
            normal(j, j) = 1;
        }
        bool is_better = false;
        for (int attempt = 0; attempt < 6 && !is_better; ++attempt) {
            Eigen::MatrixXd damped = normal;
            damped.diagonal() += damping * (normal.diagonal().array() + 1e-9).matrix();
            const Eigen::VectorXd step = damped.ldlt().solve(-gradient);
            std::vector<double> y = x;
            for (Eigen::Index j = 0; j < n; ++j) {
                double& value = y[static_cast<std::size_t>(j)];
                if (std::isfinite(step[j])) value = std::clamp(value + step[j], 0.0, 1.0);
            }
            problem.residuals(y, moved);
            is_better = moved.squaredNorm() < r.squaredNorm();
            damping *= is_better ? 0.3 : 4;
            if (!is_better) continue;
            const bool is_done = r.squaredNorm() - moved.squaredNorm() < 1e-5 * r.squaredNorm();
            x = std::move(y);
            r = moved;
            if (is_done) return;
        }
        if (!is_better) return;
    }
}

struct RatedPoint {
    std::vector<double> x;
    double value;
};

constexpr std::size_t kDrawn = 6000, kDescents = 60, kPolished = 8;
constexpr int kIterations = 40;
constexpr std::size_t kPolishing = 2000;

/// The best of the rated points, no two of them close together.
std::vector<RatedPoint> spread_out(std::vector<RatedPoint> rated, std::size_t count, double apart) {
    std::ranges::stable_sort(rated, {}, &RatedPoint::value);
    std::vector<RatedPoint> chosen;
    for (RatedPoint& point : rated) {
        const bool is_near = std::ranges::any_of(chosen, [&](const RatedPoint& other) {
            double most = 0;
            for (std::size_t i = 0; i < point.x.size(); ++i)
                most = std::max(most, std::abs(point.x[i] - other.x[i]));
            return most < apart;
        });
        if (!is_near) chosen.push_back(std::move(point));
        if (chosen.size() == count) break;
    }
    return chosen;
}

EngineFit fit_form(const FitProblem& problem, const EngineFilm& start, unsigned threads) {
    Random random(1);
    std::vector<RatedPoint> rated(kDrawn);
    for (RatedPoint& point : rated)
        for (std::size_t i = 0; i < problem.size(); ++i) point.x.push_back(random.uniform(0, 1));
    rated.front().x = problem.point_of(start);
    parallel_for(rated.size(), threads, [&](std::size_t i) {
        Eigen::VectorXd r;
        problem.residuals(rated[i].x, r);
        rated[i].value = r.squaredNorm();
    });
    std::vector<RatedPoint> starts{rated.front()};
    for (RatedPoint& point : spread_out(std::move(rated), kDescents, 0.1))
        starts.push_back(std::move(point));
    parallel_for(starts.size(), threads, [&](std::size_t i) {
        descend(problem, starts[i].x, kIterations);
        starts[i].value = problem.mean_difference(starts[i].x);
    });
    std::vector<RatedPoint> best = spread_out(std::move(starts), kPolished, 1e-3);
    parallel_for(best.size(), threads, [&](std::size_t i) {
        const auto function = [&](std::span<const double> x) { return problem.mean_difference(x); };
        SimplexMinimum minimum = simplex_search(function, best[i].x, 0.02, kPolishing);
        best[i] = {std::move(minimum.x), minimum.value};
    });
    return problem.result(std::ranges::min_element(best, {}, &RatedPoint::value)->x);
}

}  // namespace

double EngineFit::value_of(std::string_view name) const {
    const auto found = std::ranges::find(parameters, name, &FittedParameter::name);
    if (found == parameters.end())
        throw DomainError("parameter '" + std::string(name) + "' must be one of the fit's");
    return found->value;
}

bool has_parameters(const ComparedEngine& engine) {
    return engine.engine != nullptr;
}

EngineFit fit_engine(const ComparedEngine& engine, const EngineDifference& difference,
                     const FitTarget& target, const EngineFilm& start, unsigned threads) {
    if (!has_parameters(engine)) throw DomainError(engine.name + " has no parameters to fit");
    EngineFit best;
    bool is_first = true;
    for (const EngineForm& form : forms_of(engine.name)) {
        EngineFit fit = fit_form(FitProblem(engine, form, difference, target), start, threads);
        if (is_first || fit.delta_e_mean < best.delta_e_mean) best = std::move(fit);
        is_first = false;
    }
    return best;
}

}  // namespace irido
