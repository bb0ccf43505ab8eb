#include <limits>
#include <memory>

#include "core/coherent/coherent.hpp"
#include "core/error.hpp"
#include "core/rough/ggx.hpp"
#include "core/rough/transmissivity.hpp"
#include "schemas/documents/canonical_stack.hpp"
#include "tables/lut/kind_parts.hpp"

namespace irido::tables {

namespace {

constexpr double kWorstError = 1e-6;  ///< of any value, as estimated by the integration

Light light_of(const LutRequest& request) {
    if (!request.has("polarization")) return Light::unpolarized;
    const std::string& letter = request.word("polarization");
    return letter == "s" ? Light::s : letter == "p" ? Light::p : Light::unpolarized;
}

/// Appends the values [theta_i][wavelength]. Throws DomainError if they are not accurate enough.
void append_transmissivities(const RoughTransmissivity& layer, double alpha,
                             const std::vector<double>& theta_i_deg,
                             const std::vector<double>& wavelength_nm,
                             std::vector<double>& values) {
    for (const auto& [value, error] : layer(alpha, theta_i_deg, wavelength_nm)) {
        if (!(error <= kWorstError))
            throw DomainError("the transmissivity at alpha " + to_text(alpha) + " has error " +
                              to_text(error) + ", tables require " + to_text(kWorstError));
        values.push_back(value);
    }
}

LutPlan plan(const LutRequest& request) {
    LutPlan plan;
    plan.axes.push_back(alpha_axis(request));
    plan.axes.push_back(angles_axis(request, "theta-i", "theta_i_deg"));
    plan.axes.push_back(listed_axis(request, "wavelengths",
                                    {"wavelength_nm", "nm", equally_spaced(380, 780, 401)}));
    plan.channels = {"ft_cos"};
    plan.split_axis = 1;
    const auto layer = std::make_shared<const RoughTransmissivity>(
        request.document.stack, light_of(request), request.execution.simd);
    const std::vector<double>& wavelengths = plan.axes[2].axis.values;
    plan.facts["stack"] = schemas::canonical_stack(request.document.stack);
    plan.facts["request"]["integration_error"] = kWorstError;
    plan.facts["request"]["polarization"] = letter_of(light_of(request));
    if (amplifies(request.document.stack, wavelengths)) plan.facts["request"]["amplifies"] = true;
    layer->prepare(wavelengths, request.execution.threads);
    plan.evaluate = [layer](const std::vector<LutAxis>& axes) {
        std::vector<double> values;
        values.reserve(axes[0].count() * axes[1].count() * axes[2].count());
        for (const double alpha_value : axes[0].values)
            append_transmissivities(*layer, alpha_value, axes[1].values, axes[2].values, values);
        return values;
    };
    // too many fringes are seen at any angle: a plan fails where its table would
    const std::vector<double>& thetas = plan.axes[1].axis.values;
    std::vector<double> ignored;
    for (const double alpha_value :
         {plan.axes[0].axis.values.front(), plan.axes[0].axis.values.back()})
        append_transmissivities(*layer, alpha_value, {thetas.front(), thetas.back()}, wavelengths,
                                ignored);
    plan.measure = relative_to("relative to G1", [](double alpha, double theta_i_deg) {
        return smith_masking(alpha, cos_of_incidence(theta_i_deg));
    });
    return plan;
}

std::vector<std::string> problems(const Lut& lut) {
    const bool is_passive = !lut.facts.at("request").contains("amplifies");
    const double slack = 1 + rounding_of(lut.type);
    return out_of_range(lut, [&](std::size_t sample) {
        if (!is_passive || lut.axes.size() != 3) return std::numeric_limits<double>::max();
        const std::size_t row = sample / lut.axes[2].count();
        const double theta_i = lut.axes[1].values[row % lut.axes[1].count()];
        const double alpha = lut.axes[0].values[row / lut.axes[1].count()];
        return slack * smith_masking(alpha, cos_of_incidence(theta_i));
    });
}

}  // namespace

extern const LutKind lut_kind_transmissivity = {
    .name = "transmissivity",
    .summary = "Light that passes straight through a rough layer of the stack, by wavelength.",
    .axes = "alpha, theta_i_deg, wavelength_nm",
    .notes =
        "Each facet of the layer is the stack, whose outer media should be the same, so that\n"
        "light is not refracted:\n"
        "    ft_cos(theta_i) = integral of T(theta_d) F_alpha(theta_i, theta_d) dtheta_d,\n"
        "with an error below 1e-9 of G1(theta_i), its value where T = 1. The rest is\n"
        "reflected, absorbed or shadowed. The error is relative to G1. FPB24: Fourneau,\n"
        "Pacanowski and Barla, CGF 43(2), 2024, eq. 28; p_trans and sample weights follow\n"
        "by eqs. 31 to 33.",
    .examples = {"transmissivity \"1 | (1@250 | 1.5@250)^10 | 1\" --alpha 0.05,0.1 -o bragg.npy",
                 "transmissivity mirror.json --theta-i 0:85:5 --wavelengths 450,550,650"},
    .stack = true,
    .options = {alpha_option(),
                angles_option("theta-i", "angles of incidence, degrees, [0, 90] [0:89.75:0.25]"),
                {.name = "wavelengths",
                 .help = "vacuum wavelengths, nm, [1, 1e7] [380:780:1]",
                 .lowest = kAllWavelengths.first_nm,
                 .highest = kAllWavelengths.last_nm,
                 .letter = 'w'},
                {.name = "polarization",
                 .type = LutOption::Type::word,
                 .help = "s, p or u (unpolarized: the mean of both) [u]",
                 .fallback = "u",
                 .words = {"s", "p", "u"},
                 .letter = 'p'}},
    .plan = plan,
    .problems = problems,
};

}  // namespace irido::tables
