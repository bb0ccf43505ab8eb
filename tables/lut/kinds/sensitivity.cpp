#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/colorimetry/sensitivity_transform.hpp"
#include "core/error.hpp"
#include "tables/lut/light_facts.hpp"
#include "tables/lut/lut_kind.hpp"

namespace irido::tables {

namespace {

constexpr double kAccuracy = 1e-13;

/// H_j at optical path differences, for each standard deviation of the difference.
class SensitivityFunction {
public:
    SensitivityFunction(const LutRequest& request, double opd_max_nm)
        : sigmas_(request.list("sigma")), is_real_(request.has("real")) {
        for (const double sigma : sigmas_)
            transforms_.push_back(std::make_shared<const SensitivityTransform>(
                *request.sensitivity, opd_max_nm, kAccuracy, sigma * sigma));
        if (request.has("carrier")) {
            const auto points = channel_points(*request.sensitivity);
            for (std::size_t j = 0; j < 3; ++j) carrier_[j] = points[j].centroid();
        }
    }

    const std::array<double, 3>& carrier() const { return carrier_; }

    std::vector<double> operator()(const std::vector<LutAxis>& axes) const {
        std::vector<double> values;
        for (const double sigma : axes[0].values) {
            const auto level = std::ranges::find(sigmas_, sigma) - sigmas_.begin();
            const SensitivityTransform& transform = *transforms_[static_cast<std::size_t>(level)];
            for (const double opd_nm : axes[1].values) {
                ComplexTriple h = transform(opd_nm);
                for (std::size_t j = 0; j < 3; ++j)
                    h[j] *= std::polar(1.0, -2 * std::numbers::pi * carrier_[j] * opd_nm);
                for (const Complex& part : h) values.push_back(part.real());
                if (is_real_) continue;
                for (const Complex& part : h) values.push_back(part.imag());
            }
        }
        return values;
    }

private:
    std::vector<double> sigmas_;
    bool is_real_;
    std::vector<std::shared_ptr<const SensitivityTransform>> transforms_;
    std::array<double, 3> carrier_{};
};

std::vector<double> paths(const LutRequest& request) {
    constexpr std::size_t usual_count = 1024, usual_count_without_carrier = 128;
    if (request.has("opd")) return request.list("opd");
    return equally_spaced(0, request.number("opd-max"),
                          request.has("carrier") ? usual_count_without_carrier : usual_count);
}

LutPlan plan(const LutRequest& request) {
    const std::vector<double> opd_nm = paths(request);
    if (!std::ranges::is_sorted(opd_nm, std::ranges::less_equal()))
        throw DomainError("opd must ascend");
    if (!std::ranges::is_sorted(request.list("sigma"), std::ranges::less_equal()))
        throw DomainError("sigma must ascend");
    if (request.has("real") && request.has("carrier"))
        throw DomainError("--real cannot be combined with --carrier");
    LutPlan result;
    result.axes = {{{"opd_sigma_nm", "nm", request.list("sigma")}, true},
                   {{"opd_nm", "nm", opd_nm}, false, true, "no fringes are left"}};
    result.axes[1].fixed = !result.axes[1].axis.is_linear();
    result.channels = {"X_re", "Y_re", "Z_re"};
    if (!request.has("real"))
        result.channels.insert(result.channels.end(), {"X_im", "Y_im", "Z_im"});
    result.mips = true;
    result.split_axis = 1;
    const SensitivityFunction function(request, opd_nm.back());
    result.evaluate = function;
    result.measure = absolute_measure(result.channels.size());
    result.facts = light_facts(request);
    if (request.has("carrier")) {
        const auto& nu = function.carrier();
        result.facts["request"]["carrier_nm"] = {1 / nu[0], 1 / nu[1], 1 / nu[2]};
    }
    return result;
}

/// |H_j| is at most its value at zero path difference, the white.
std::vector<std::string> problems(const Lut& lut) {
    constexpr double rounding = 1e-3;
    const auto& white = lut.facts.at("request").at("white_xyz");
    for (std::size_t i = 0; i < lut.values.size(); ++i) {
        const double most = white[i % lut.channels.size() % 3].get<double>();
        if (std::abs(lut.values[i]) > most * (1 + rounding))
            return {lut.channels[i % lut.channels.size()] + " exceeds the white at value " +
                    std::to_string(i)};
    }
    return {};
}

}  // namespace

extern const LutKind lut_kind_sensitivity = {
    .name = "sensitivity",
    .summary =
        "Fourier transform of the weighted colour-matching functions over optical path "
        "differences.",
    .axes = "opd_sigma_nm, opd_nm",
    .notes =
        "H_j(D) = integral s_j(L) exp(2 pi i D / L) exp(-2 pi^2 sigma^2 / L^2) dL, j = X, Y, Z,\n"
        "the white at D = 0: the contribution to a colour of a fringe of optical path\n"
        "difference D. Each sigma is exact; in KTX2 files they are mip levels, each half as\n"
        "wide. With --carrier the values are H_j(D) exp(-2 pi i D / carrier_nm_j), which need\n"
        "far fewer samples. The error is absolute.",
    .examples = {"sensitivity --carrier --opd 0:30000/512 -o h.ktx2 --dtype f16",
                 "sensitivity --sigma 0,50,100,150 --tolerance 1e-3 -o h.npy"},
    .light = true,
    .options = {{.name = "opd",
                 .type = LutOption::Type::list,
                 .help = "optical path differences D, nm, [0, 1e7]\n[0:OPD-MAX/1024, with "
                         "--carrier 0:OPD-MAX/128]",
                 .lowest = 0,
                 .highest = 1e7},
                {.name = "opd-max",
                 .type = LutOption::Type::number,
                 .help = "largest optical path difference, nm, [1, 1e7] [10000]",
                 .fallback = "10000",
                 .lowest = 1,
                 .highest = 1e7},
                {.name = "sigma",
                 .type = LutOption::Type::list,
                 .help = "standard deviations of D, nm, ascending, [0, 1e7] [0]",
                 .fallback = "0",
                 .lowest = 0,
                 .highest = 1e7},
                {.name = "carrier",
                 .type = LutOption::Type::flag,
                 .help = "divide out each channel's carrier"},
                {.name = "real",
                 .type = LutOption::Type::flag,
                 .help = "store the real part only: sufficient over a base that does not absorb"}},
    .plan = plan,
    .problems = problems,
};

}  // namespace irido::tables
