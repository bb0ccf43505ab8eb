#include "core/periodic/bragg_mirror.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/spectrum/spectrum.hpp"

namespace irido {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kLargestK = 0.1;

/// Elements with every group of one repetition dissolved into its layers.
std::vector<Element> without_single_groups(const std::vector<Element>& elements) {
    std::vector<Element> result;
    for (const Element& element : elements) {
        const Group* group = std::get_if<Group>(&element.value);
        if (!group) {
            result.push_back(element);
            continue;
        }
        std::vector<Element> inside = without_single_groups(group->elements);
        if (group->repeat == 1) {
            std::ranges::move(inside, std::back_inserter(result));
        } else {
            result.push_back({Group{group->repeat, std::move(inside)}});
        }
    }
    return result;
}

}  // namespace

BraggMirror::BraggMirror(Stack stack, double first_nm, double last_nm) : stack_(std::move(stack)) {
    stack_.elements = without_single_groups(stack_.elements);
    find_pair();
    if (first_uniaxial(stack_.materials))
        throw DomainError("a Bragg mirror needs isotropic media (got a uniaxial one)");
    check_indices(first_nm, last_nm);
    for (Material& material : stack_.materials) material.outside = Outside::clamp;
}

void BraggMirror::find_pair() {
    const DomainError none("a Bragg mirror needs one repeated group of two coherent layers");
    std::size_t groups = 0;
    for (std::size_t i = 0; i < stack_.elements.size(); ++i) {
        const Group* group = std::get_if<Group>(&stack_.elements[i].value);
        if (!group) continue;
        if (++groups > 1 || group->elements.size() != 2) throw none;
        const Layer* first = std::get_if<Layer>(&group->elements[0].value);
        const Layer* second = std::get_if<Layer>(&group->elements[1].value);
        if (!first || !second || !first->coherent || !second->coherent) throw none;
        place_ = i;
        pair_ = {*first, *second};
    }
    if (groups == 0) throw none;
}

void BraggMirror::check_indices(double first_nm, double last_nm) {
    constexpr int kSamples = 64;
    std::vector<double> wavelengths{first_nm};
    for (int i = 1; i < kSamples; ++i)
        wavelengths.push_back(first_nm + (last_nm - first_nm) * i / kSamples);
    wavelengths.push_back(last_nm);
    const IndexTable table(stack_, std::move(wavelengths));
    for (const Layer& layer : pair_)
        for (std::size_t w = 0; w < table.wavelength_nm().size(); ++w)
            left_out_k_ = std::max(left_out_k_, std::abs(table.k(layer.material, w)));
    if (left_out_k_ > kLargestK)
        throw DomainError(
            "the two layers of a Bragg mirror must be transparent, k in [-0.1, 0.1] "
            "(got " +
            to_text(left_out_k_) + ")");
}

double BraggMirror::index(std::size_t material, double omega) const {
    const double wavelength_nm =
        std::clamp(kTurn / omega, kAllWavelengths.first_nm, kAllWavelengths.last_nm);
    return index_at(stack_.materials[material], wavelength_nm).real();
}

BraggPeriod BraggMirror::period(double angle_deg, Polarization polarization, double omega) const {
    try {
        const RealLayer first{index(pair_[0].material, omega), pair_[0].thickness_nm};
        const RealLayer second{index(pair_[1].material, omega), pair_[1].thickness_nm};
        return bragg_period(first, second, index(stack_.incident, omega), incident_angle(angle_deg),
                            polarization);
    } catch (const DomainError& error) {
        throw DomainError(std::string(error.what()) + ", at " + to_text(angle_deg) + " degrees");
    }
}

PeriodAt BraggMirror::period_at(double angle_deg, Polarization polarization) const {
    const std::array used{pair_[0].material, pair_[1].material, stack_.incident};
    if (std::ranges::all_of(used, [&](std::size_t m) { return is_constant(stack_.materials[m]); }))
        return [same = period(angle_deg, polarization, kTurn)](double) { return same; };
    return [this, angle_deg, polarization](double omega) {
        return period(angle_deg, polarization, omega);
    };
}

std::function<double(std::uint64_t)> BraggMirror::reflectances(double angle_deg,
                                                               Polarization polarization,
                                                               double omega) const {
    const bool is_s = polarization == Polarization::s;
    Needs needs;
    needs.s = is_s;
    needs.p = !is_s;
    needs.T = needs.A = false;
    const IndexTable table(stack_, {kTurn / omega});
    const IncidentAngle at = incident_angle(angle_deg);
    return [=, stack = stack_, place = place_](std::uint64_t repeat) mutable {
        if (repeat > 0) std::get<Group>(stack.elements[place].value).repeat = repeat;
        const Spectra result =
            spectra(StackPower(stack), table, {&at, 1}, needs, {1, SimdLevel::plain});
        return (is_s ? result.s : result.p).R[0];
    };
}

double BraggMirror::reflectance(double angle_deg, Polarization polarization, double omega) const {
    return reflectances(angle_deg, polarization, omega)(0);
}

BraggMirror::Periods BraggMirror::periods_needed(double angle_deg, Polarization polarization,
                                                 double omega) const {
    constexpr std::uint64_t kOneByOne = 64, kMost = kMostRepeats;
    Periods needed{};
    std::size_t level = 0;
    const std::function<double(std::uint64_t)> R = reflectances(angle_deg, polarization, omega);
    for (std::uint64_t n = 1; n <= kOneByOne && level < needed.size(); ++n)
        for (const double r = R(n); level < needed.size() && r >= kReflectances[level]; ++level)
            needed[level] = static_cast<double>(n);
    std::uint64_t low = kOneByOne;
    for (; level < needed.size(); ++level) {
        std::uint64_t high = low;
        try {
            while (high < kMost && R(high) < kReflectances[level]) high = std::min(2 * high, kMost);
            if (R(high) < kReflectances[level]) break;
        } catch (const DomainError&) {
            break;  // with a thickness distribution, so many periods have no mean
        }
        while (high - low > 1) {
            const std::uint64_t middle = low + (high - low) / 2;
            (R(middle) < kReflectances[level] ? low : high) = middle;
        }
        needed[level] = static_cast<double>(high);
    }
    return needed;
}

bool BraggMirror::is_omnidirectional(double order) const {
    const double omega = band_gap(period_at(0, Polarization::s), order).centre_per_nm();
    const double n1 = index(pair_[0].material, omega), n2 = index(pair_[1].material, omega);
    const double n0 = index(stack_.incident, omega);
    if (reaches_brewster(n1, n2, n0)) return false;
    const auto turns = [&](double angle_deg) {
        const BraggPeriod at = period(angle_deg, Polarization::s, omega);
        return order * at.path1_nm / (at.path1_nm + at.path2_nm);
    };
    const auto [few, many] = std::minmax({turns(0), turns(kLargestAngle_deg)});
    if (std::floor(many) >= std::ceil(few)) return false;
    double low = 0, high = std::numeric_limits<double>::infinity();
    constexpr int kAngles = 360;
    for (const Polarization polarization : {Polarization::s, Polarization::p}) {
        for (int i = 0; i <= kAngles && low < high; ++i) {
            const double angle_deg = kLargestAngle_deg * i / kAngles;
            const BandGap gap = band_gap(period_at(angle_deg, polarization), order);
            low = std::max(low, gap.low_per_nm);
            high = std::min(high, gap.high_per_nm);
        }
    }
    return low < high;
}

}  // namespace irido
