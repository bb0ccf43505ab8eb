#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/math/constants.hpp"

namespace irido {

/// Cosines of the angle theta_d between light and half vector, low < high.
struct CosineRange {
    double low, high;
};

/// Functions of a cosine, one a wavelength, by their values at Chebyshev's points between two ends.
class CosineSeries {
public:
    static constexpr std::size_t kCount = 33;

    CosineSeries() = default;
    /// values  [node][wavelength]
    CosineSeries(const CosineRange& range, std::span<const double> values)
        : middle_((range.low + range.high) / 2),
          half_((range.high - range.low) / 2),
          size_(values.size() / kCount) {
        constexpr double kLeast = 1e-13;
        for (std::size_t k = 0; k < kCount; ++k) {
            std::vector<double>& of_order = coefficients_.emplace_back(size_, 0.0);
            for (std::size_t j = 0; j < kCount; ++j) {
                const double part = (k == 0 ? 1.0 : 2.0) / kCount * wave(k, j);
                for (std::size_t i = 0; i < size_; ++i) of_order[i] += part * values[j * size_ + i];
            }
        }
        while (coefficients_.size() > 1 && std::ranges::all_of(coefficients_.back(), [](double c) {
                   return std::abs(c) < kLeast;
               }))
            coefficients_.pop_back();
    }

    /// Where the values are wanted, in [0, 1].
    static std::vector<double> nodes(const CosineRange& range) {
        std::vector<double> cosines;
        for (std::size_t j = 0; j < kCount; ++j)
            cosines.push_back(std::clamp(
                (range.low + range.high) / 2 + (range.high - range.low) / 2 * std::cos(angle(j)),
                0.0, 1.0));
        return cosines;
    }

    /// T_k at node j.
    static double wave(std::size_t k, std::size_t j) {
        return std::cos(angle(j) * static_cast<double>(k));
    }

    bool is_empty() const { return size_ == 0; }

    /// At one wavelength.
    double operator()(double cosine, std::size_t wavelength) const {
        const double x = place_of(cosine);
        double first = 0, second = 0;
        for (std::size_t k = coefficients_.size(); k-- > 1;) {
            const double next = 2 * x * first - second + coefficients_[k][wavelength];
            second = first;
            first = next;
        }
        return x * first - second + coefficients_[0][wavelength];
    }

    /// At all wavelengths; `work` holds twice as many numbers.
    void at(double cosine, std::span<double> values, std::span<double> work) const {
        const double x = place_of(cosine);
        const std::span<double> first = work.first(size_), second = work.subspan(size_, size_);
        std::ranges::fill(work, 0.0);
        for (std::size_t k = coefficients_.size(); k-- > 1;)
            for (std::size_t i = 0; i < size_; ++i) {
                const double next = 2 * x * first[i] - second[i] + coefficients_[k][i];
                second[i] = first[i];
                first[i] = next;
            }
        for (std::size_t i = 0; i < size_; ++i)
            values[i] = x * first[i] - second[i] + coefficients_[0][i];
    }

private:
    static double angle(std::size_t j) {
        return kPi * (static_cast<double>(j) + 0.5) / static_cast<double>(kCount);
    }
    double place_of(double cosine) const {
        return std::clamp((cosine - middle_) / half_, -1.0, 1.0);
    }

    double middle_ = 0, half_ = 1;
    std::size_t size_ = 0;
    std::vector<std::vector<double>> coefficients_;  ///< [order][wavelength]
};

}  // namespace irido
