#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/material/material.hpp"

namespace irido {

/// Coefficients numbered c1, c2, ... as in the definitions; missing ones are 0.
class Coefficients {
public:
    explicit Coefficients(const Formula& formula) : values_(formula.coefficients) {}

    std::size_t count() const { return values_.size(); }
    double operator()(std::size_t number) const {
        return number <= values_.size() ? values_[number - 1] : 0.0;
    }

private:
    const std::vector<double>& values_;
};

/// The nine dispersion formulas of Formula at a wavelength in um, a number or a series.
template <class Number>
class FormulaAt {
public:
    FormulaAt(const Formula& formula, const Number& um)
        : number_(formula.number), c_(formula), um_(um), l2_(um * um) {}

    /// Whether value() is n^2 rather than n.
    bool is_square() const { return number_ <= 4 || number_ >= 8; }

    /// n, or n^2; 0 for an unknown formula number.
    Number value() const {
        switch (number_) {
            case 1:
                return sellmeier(false);
            case 2:
                return sellmeier(true);
            case 3:
            case 5:
                return c_(1) + power_terms(2);
            case 4:
                return rational();
            case 6:
                return gas();
            case 7:
                return herzberger();
            case 8:
                return retro();
            case 9:
                return exotic();
            default:
                return 0.0;
        }
    }

private:
    Number power(double exponent) const {
        using std::pow;
        return pow(um_, exponent);
    }

    /// Sum of term(j) over j = first, first + step, ... with a nonzero coefficient c_j.
    template <class Term>
    Number sum_of_terms(std::size_t first, std::size_t step, Term term) const {
        Number sum = 0.0;
        for (std::size_t j = first; j <= c_.count(); j += step)
            if (c_(j) != 0) sum += term(j);
        return sum;
    }

    /// c_j L^c_(j+1) over j = first, first + 2, ...
    Number power_terms(std::size_t first) const {
        return sum_of_terms(first, 2, [&](std::size_t j) { return c_(j) * power(c_(j + 1)); });
    }

    /// 1 + c1 + c2 L^2 / (L^2 - c3^p) + c4 L^2 / (L^2 - c5^p) + ..., p = 2 or 1.
    Number sellmeier(bool squared_poles) const {
        return 1 + c_(1) + sum_of_terms(2, 2, [&](std::size_t j) {
                   const double pole = c_(j + 1);
                   return c_(j) * l2_ / (l2_ - (squared_poles ? pole : pole * pole));
               });
    }

    /// c1 + c2 L^c3 / (L^2 - c4^c5) + c6 L^c7 / (L^2 - c8^c9) + c10 L^c11 + c12 L^c13 + ...
    Number rational() const {
        Number sum = c_(1) + power_terms(10);
        for (const std::size_t j : {std::size_t{2}, std::size_t{6}})
            if (c_(j) != 0)
                sum += c_(j) * power(c_(j + 1)) / (l2_ - std::pow(c_(j + 2), c_(j + 3)));
        return sum;
    }

    /// 1 + c1 + c2 / (c3 - L^-2) + c4 / (c5 - L^-2) + ...
    Number gas() const {
        return 1 + c_(1) +
               sum_of_terms(2, 2, [&](std::size_t j) { return c_(j) / (c_(j + 1) - 1.0 / l2_); });
    }

    /// c1 + c2 u + c3 u^2 + c4 L^2 + c5 L^4 + c6 L^6 with u = 1 / (L^2 - 0.028)
    Number herzberger() const {
        const Number u = 1.0 / (l2_ - 0.028);
        return c_(1) + c_(2) * u + c_(3) * u * u + ((c_(6) * l2_ + c_(5)) * l2_ + c_(4)) * l2_;
    }

    /// (n^2 - 1) / (n^2 + 2) = r = c1 + c2 L^2 / (L^2 - c3) + c4 L^2
    Number retro() const {
        Number r = c_(1);
        if (c_(2) != 0) r += c_(2) * l2_ / (l2_ - c_(3));
        r += c_(4) * l2_;
        return (1 + 2 * r) / (1 - r);
    }

    /// c1 + c2 / (L^2 - c3) + c4 (L - c5) / ((L - c5)^2 + c6)
    Number exotic() const {
        const Number shifted = um_ - c_(5);
        Number sum = c_(1);
        if (c_(2) != 0) sum += c_(2) / (l2_ - c_(3));
        if (c_(4) != 0) sum += c_(4) * shifted / (shifted * shifted + c_(6));
        return sum;
    }

    int number_;
    Coefficients c_;
    Number um_, l2_;
};

}  // namespace irido
