#include "core/colorimetry/cumulative_sensitivity.hpp"
#include "tables/lut/light_facts.hpp"
#include "tables/lut/lut_kind.hpp"

namespace irido::tables {

namespace {

LutPlan plan(const LutRequest& request) {
    LutPlan result;
    result.axes = {{{"wavelength_nm", "nm", request.list("wavelengths")}}};
    result.axes[0].fixed = !result.axes[0].axis.is_linear();
    result.channels = {"X", "Y", "Z"};
    result.evaluate = [cumulative = CumulativeSensitivity(*request.sensitivity)](
                          const std::vector<LutAxis>& axes) {
        std::vector<double> values;
        for (const double wavelength_nm : axes[0].values) {
            const Triple sum = cumulative(wavelength_nm);
            values.insert(values.end(), sum.begin(), sum.end());
        }
        return values;
    };
    result.measure = absolute_measure(3);
    result.facts = light_facts(request);
    return result;
}

std::vector<std::string> problems(const Lut& lut) {
    for (std::size_t i = 3; i < lut.values.size(); ++i)
        if (lut.values[i] < lut.values[i - 3])
            return {"the cumulative integral of " + lut.channels[i % 3] + " falls at sample " +
                    std::to_string(i / 3)};
    return {};
}

}  // namespace

extern const LutKind lut_kind_cumulative = {
    .name = "cumulative",
    .summary =
        "Cumulative integrals of the weighted colour-matching functions over the wavelength.",
    .axes = "wavelength_nm",
    .notes =
        "X, Y, Z of a stack that reflects all light up to this wavelength and none beyond it;\n"
        "white Y = 1. The colour of a band of reflectance 1 is the difference of the samples\n"
        "at its edges. The error is absolute.",
    .examples = {"cumulative -o cumulative.ktx2", "cumulative -w 380:780:5 --illuminant E"},
    .light = true,
    .options = {{.name = "wavelengths",
                 .type = LutOption::Type::list,
                 .help = "vacuum wavelengths, nm, [1, 1e7] [360:830:1]",
                 .fallback = "360:830:1",
                 .lowest = kAllWavelengths.first_nm,
                 .highest = kAllWavelengths.last_nm,
                 .letter = 'w'}},
    .plan = plan,
    .problems = problems,
};

}  // namespace irido::tables
