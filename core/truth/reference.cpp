#include "core/truth/reference.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/truth/textbook.hpp"

namespace irido {

namespace {

/// Largest double below 90.
constexpr double kLargestReferenceAngle_deg = 0x1.67fffffffffffp+6;

/// Perturbation of the inputs at which conditions are evaluated, in 2^-53: a kernel rounds a few
/// times. q2 is built from squares, which change twice as much.
constexpr double kShift = 4, kShiftOfSquares = 2 * kShift;

using Transfer = textbook::Transfer<textbook::Digits<50>>;

template <class R>
Power as_power(const std::array<R, 2>& rt) {
    return {static_cast<double>(rt[0]), static_cast<double>(rt[1]),
            static_cast<double>(R(1 - rt[0] - rt[1]))};
}

void check(double wavelength_nm, double angle_deg) {
    require_in_range("wavelength_nm", wavelength_nm, kAllWavelengths.first_nm,
                     kAllWavelengths.last_nm);
    require_in_range("angle_deg", angle_deg, 0, kLargestReferenceAngle_deg);
}

Condition larger(const Condition& a, const Condition& b) {
    return {std::max(a.R, b.R), std::max(a.T, b.T), std::max(a.log_T, b.log_T), std::max(a.A, b.A)};
}

template <class R>
Power evaluated(const Stack& stack, double wavelength_nm, double angle_deg,
                Polarization polarization) {
    textbook::Transfer<R> transfer(stack, wavelength_nm, angle_deg);
    transfer.set_layers(stack.elements);
    return as_power(transfer.powers(polarization));
}

}  // namespace

Power reference_power(const Stack& stack, double wavelength_nm, double angle_deg,
                      Polarization polarization, Precision precision) {
    check(wavelength_nm, angle_deg);
    switch (precision) {
        case Precision::double_:
            return evaluated<double>(stack, wavelength_nm, angle_deg, polarization);
        case Precision::extended:
            return evaluated<long double>(stack, wavelength_nm, angle_deg, polarization);
        case Precision::digits50:
            return evaluated<textbook::Digits<50>>(stack, wavelength_nm, angle_deg, polarization);
        case Precision::digits100:
            break;
    }
    return evaluated<textbook::Digits<100>>(stack, wavelength_nm, angle_deg, polarization);
}

std::array<ConditionedPower, 2> conditioned_power(const Stack& stack, double wavelength_nm,
                                                  double angle_deg) {
    constexpr std::array kPolarizations{Polarization::s, Polarization::p};
    check(wavelength_nm, angle_deg);
    std::array<ConditionedPower, 2> result;
    const auto take_condition = [&](const Transfer& at) {
        for (std::size_t i = 0; i < 2; ++i)
            result[i].condition = larger(result[i].condition, at.condition(kPolarizations[i]));
    };
    Transfer exact(stack, wavelength_nm, angle_deg);
    exact.set_layers(stack.elements);
    for (std::size_t i = 0; i < 2; ++i) result[i].power = as_power(exact.powers(kPolarizations[i]));
    if (!exact.is_near_branch_point(kShiftOfSquares)) take_condition(exact);
    for (const double roundings : {kShift, -kShift}) {
        Transfer shifted(stack, wavelength_nm, angle_deg, textbook::Shift::along(roundings));
        shifted.set_layers(stack.elements);
        take_condition(shifted);
    }
    return result;
}

namespace {

/// Layers of the elements, each group listed once.
void add_layers(std::span<const Element> elements, std::vector<Layer>& layers) {
    for (const Element& element : elements) {
        if (const Layer* layer = std::get_if<Layer>(&element.value)) {
            layers.push_back(*layer);
        } else {
            add_layers(std::get<Group>(element.value).elements, layers);
        }
    }
}

}  // namespace

std::vector<LayerPowerSlopes> reference_slopes(const Stack& stack, double wavelength_nm,
                                               double angle_deg, Polarization polarization) {
    check(wavelength_nm, angle_deg);
    Transfer transfer(stack, wavelength_nm, angle_deg);
    transfer.set_layers(stack.elements);
    const auto by_input = transfer.slopes(polarization);
    std::vector<Layer> layers;
    add_layers(stack.elements, layers);
    layers.push_back({stack.substrate});
    std::vector<LayerPowerSlopes> slopes;
    std::size_t input = 0;
    const auto slope = [&](double x, std::size_t i) {
        const auto& [R, log_T] = by_input[i];
        if (x == 0) return PowerSlope{};
        return PowerSlope{static_cast<double>(R / x), static_cast<double>(log_T / x)};
    };
    for (std::size_t l = 0; l < layers.size(); ++l) {
        const Complex index = index_at(stack.materials[layers[l].material], wavelength_nm);
        const bool is_layer = l + 1 < layers.size();
        const std::size_t first = is_layer ? input + 2 : input;
        slopes.push_back({is_layer ? slope(layers[l].thickness_nm, input) : PowerSlope{},
                          slope(index.real(), first), slope(index.imag(), first + 1)});
        input = first + 4;
    }
    return slopes;
}

namespace {

/// Whether f, positive at three successive points with its smallest value at the middle one, drops
/// to 0 between them; by golden-section search.
template <class F>
bool reaches_zero(const F& f, double low, double middle, double high, double least) {
    constexpr double kShare = 0.3819660112501051;
    constexpr int kSections = 60;
    for (int i = 0; i < kSections; ++i) {
        const bool up = high - middle > middle - low;
        const double next = middle + kShare * ((up ? high : low) - middle);
        const double value = f(next);
        if (value <= 0) return true;
        if (value < least) {
            (up ? low : high) = middle;
            middle = next;
            least = value;
        } else {
            (up ? high : low) = next;
        }
    }
    return false;
}

}  // namespace

bool is_answer_nearby(const Stack& stack, double wavelength_nm, double angle_deg,
                      Polarization polarization, double Power::*quantity, double value,
                      double roundings) {
    check(wavelength_nm, angle_deg);
    constexpr int kSteps = 400;
    const auto away = [&](int i) { return roundings * (2.0 * i / kSteps - 1); };
    const auto excess = [&](double at) {
        Transfer moved(stack, wavelength_nm, angle_deg, textbook::Shift::along(at));
        moved.set_layers(stack.elements);
        return as_power(moved.powers(polarization)).*quantity - value;
    };
    std::vector<double> above;
    for (int i = 0; i <= kSteps; ++i) {
        above.push_back(excess(away(i)));
        if (above.back() * above.front() <= 0) return true;
    }
    const double sign = std::copysign(1.0, above.front());
    for (std::size_t i = 1; i + 1 < above.size(); ++i) {
        const double least = sign * above[i];
        if (least > sign * above[i - 1] || least > sign * above[i + 1]) continue;
        const int at = static_cast<int>(i);
        if (reaches_zero([&](double x) { return sign * excess(x); }, away(at - 1), away(at),
                         away(at + 1), least))
            return true;
    }
    return false;
}

}  // namespace irido
