#include "cli/queries/spectrum_average.hpp"

#include <algorithm>
#include <cmath>

#include "cli/options/list.hpp"
#include "cli/queries/spectrum_answers.hpp"
#include "cli/queries/stack_tables.hpp"
#include "core/colorimetry/illuminant.hpp"
#include "core/colorimetry/observer.hpp"
#include "core/keep_once.hpp"
#include "core/material/linear_value.hpp"
#include "core/math/adaptive_integral.hpp"
#include "core/math/constants.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/index_rows.hpp"
#include "schemas/readers/spectrum_csv.hpp"
#include "schemas/readers/text_file.hpp"

namespace irido::cli {

namespace {

/// Angles that are averaged together.
constexpr std::size_t kAnglesOfAverage = 16;

/// Linear between rows, 0 outside.
double weight_of(const Table& table, double nm) {
    const bool inside = nm >= table.wavelength_nm.front() && nm <= table.wavelength_nm.back();
    return inside ? linear_value(table, nm) : 0;
}

Table luminosity() {
    const Observer& eye = observer(2);
    Table table;
    for (std::size_t i = 0; i < eye.y.size(); ++i) {
        table.wavelength_nm.push_back(kFirstRow_nm + static_cast<double>(i));
        table.value.push_back(eye.y[i]);
    }
    return table;
}

/// Round-trip optical path, nm, at one wavelength.
double path_of(std::span<const Element> elements, const IndexTable& at) {
    double path = 0;
    for (const Element& element : elements) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            if (layer->coherent)
                path += 2 * std::abs(at.index(layer->material, 0)) * layer->thickness_nm;
            continue;
        }
        const Group& group = std::get<Group>(element.value);
        path += static_cast<double>(group.repeat) * path_of(group.elements, at);
    }
    return path;
}

/// Ends of panels on which the weight and the stack are smooth, each spanning at most half a
/// fringe.
std::vector<double> panel_ends(const Stack& stack, const IndexTable& first, WavelengthRange range,
                               const AverageWeight& weight) {
    std::vector<double> ends{range.first_nm, range.last_nm};
    for (const Material& material : stack.materials) {
        const std::vector<double> corners = kinks(material, range);
        ends.insert(ends.end(), corners.begin(), corners.end());
    }
    for (const Table& table : weight.factors)
        for (const double nm : table.wavelength_nm)
            if (nm > range.first_nm && nm < range.last_nm) ends.push_back(nm);
    constexpr double kLeast = 200, kMost = 8192;
    const double fringes =
        path_of(stack.elements, first) * (1 / range.first_nm - 1 / range.last_nm);
    const double parts = std::ceil(std::clamp(2 * fringes, kLeast, kMost));
    for (double i = 1; i < parts; ++i)
        ends.push_back(1 /
                       (1 / range.first_nm + i / parts * (1 / range.last_nm - 1 / range.first_nm)));
    keep_once(ends);
    return ends;
}

constexpr std::array kMeanQuantities{&Spectrum::R, &Spectrum::T, &Spectrum::A};

}  // namespace

double AverageWeight::at(double wavelength_nm) const {
    double product = 1;
    for (const Table& factor : factors) product *= weight_of(factor, wavelength_nm);
    return product;
}

AverageWeight parse_average(const std::string& text) {
    if (text == "flat") return {text, {}};
    if (text == "photopic") return {text, {illuminant("D65"), luminosity()}};
    try {
        return {text, {schemas::read_spectrum_csv(schemas::read_text(text), text)}};
    } catch (const schemas::InputError&) {
        if (text.find_first_of("./") != std::string::npos || text == "-") throw;
        constexpr std::array<std::string_view, 3> kKnown{"flat", "photopic",
                                                         "a file of rows nm,weight"};
        throw UsageError("--average: " + not_one_of(kKnown, text));
    }
}

Spectra average_power(const schemas::StackDocument& document, const Stack& stack,
                      WavelengthRange range, const AverageWeight& weight,
                      std::span<const double> angles_deg, const ConeSize& cone,
                      const Execution& execution) {
    const StackPower power = stack_power(document, stack);
    const std::vector<double> ends =
        panel_ends(stack, index_table(document, {range.first_nm}), range, weight);
    const auto weights = [&](std::span<const double> points, std::span<double> values) {
        std::ranges::transform(points, values.begin(), [&](double nm) { return weight.at(nm); });
    };
    const double total = (*integrals(ends, 1, kInfinity, weights))[0];
    if (!(total > 0))
        throw UsageError("--average: " + weight.name + " is 0 from " + to_text(range.first_nm) +
                         " to " + to_text(range.last_nm) + " nm");
    Spectra means;
    for (std::size_t first = 0; first < angles_deg.size(); first += kAnglesOfAverage) {
        const auto angles =
            angles_deg.subspan(first, std::min(kAnglesOfAverage, angles_deg.size() - first));
        const std::size_t components = 2 * kMeanQuantities.size() * angles.size();
        SpectrumAnswers at;
        const auto values_at = [&](std::span<const double> points, std::span<double> values) {
            const IndexTable table = index_table(document, {points.begin(), points.end()});
            answer(stack, power, table, angles, cone, {}, execution, at);
            double* to = values.data();
            for (std::size_t i = 0; i < points.size(); ++i)
                for (const Spectrum* spectrum : {&at.spectra.s, &at.spectra.p})
                    for (const auto quantity : kMeanQuantities)
                        for (std::size_t a = 0; a < angles.size(); ++a)
                            *to++ = weight.at(points[i]) / total *
                                    (spectrum->*quantity)[a * points.size() + i];
        };
        const auto found = integrals(ends, components, kAverageError, values_at);
        if (!found)
            throw ToleranceError(document.file +
                                 ": the average cannot be found to 1e-9: fringes or resonances "
                                 "are too narrow");
        const double* value = found->data();
        for (Spectrum* spectrum : {&means.s, &means.p})
            for (const auto quantity : kMeanQuantities)
                for (std::size_t a = 0; a < angles.size(); ++a)
                    (spectrum->*quantity).push_back(*value++);
    }
    return means;
}

}  // namespace irido::cli
