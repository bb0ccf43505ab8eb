#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <concepts>
#include <cstddef>

#include "core/complex.hpp"

namespace irido {

/// Complex product without the standard library's special handling of infinities.
inline Complex product(const Complex& a, const Complex& b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}
inline double product(double a, double b) {
    return a * b;
}

/// Power series f(x) = c[0] + c[1] x + c[2] x^2 + c[3] x^3, truncated after x^3: arithmetic on
/// series differentiates exactly. c[m] is the m-th derivative at 0 over m!.
/// Source: A. Griewank and A. Walther, Evaluating Derivatives (2008), chapter 13.
template <class T>
struct Series {
    static constexpr std::size_t kTerms = 4;
    std::array<T, kTerms> c{};

    Series() = default;
    template <class U>
    requires std::convertible_to<U, T> Series(const U& constant) { c[0] = constant; }
    explicit Series(const std::array<T, kTerms>& coefficients) : c(coefficients) {}

    T& operator[](std::size_t i) { return c[i]; }
    const T& operator[](std::size_t i) const { return c[i]; }

    friend Series operator-(const Series& a) {
        Series result;
        for (std::size_t i = 0; i < kTerms; ++i) result[i] = -a[i];
        return result;
    }
    friend Series operator+(const Series& a, const Series& b) {
        Series sum;
        for (std::size_t i = 0; i < kTerms; ++i) sum[i] = a[i] + b[i];
        return sum;
    }
    friend Series operator-(const Series& a, const Series& b) {
        Series difference;
        for (std::size_t i = 0; i < kTerms; ++i) difference[i] = a[i] - b[i];
        return difference;
    }
    friend Series operator*(const Series& a, const Series& b) {
        Series result;
        for (std::size_t i = 0; i < kTerms; ++i)
            for (std::size_t j = 0; i + j < kTerms; ++j) result[i + j] += product(a[i], b[j]);
        return result;
    }
    friend Series operator/(const Series& a, const Series& b) {
        Series quotient;
        for (std::size_t i = 0; i < kTerms; ++i) {
            T rest = a[i];
            for (std::size_t j = 0; j < i; ++j) rest -= product(quotient[j], b[i - j]);
            quotient[i] = rest / b[0];
        }
        return quotient;
    }
    Series& operator+=(const Series& more) { return *this = *this + more; }
    Series& operator*=(const Series& factor) { return *this = *this * factor; }
};

/// Square root of a series whose leading term is `first`, a root of square[0], not 0.
template <class T>
Series<T> root_of(const Series<T>& square, const T& first) {
    Series<T> root(first);
    for (std::size_t i = 1; i < Series<T>::kTerms; ++i) {
        T rest = square[i];
        for (std::size_t j = 1; j < i; ++j) rest -= product(root[j], root[i - j]);
        root[i] = rest / (2.0 * first);
    }
    return root;
}

inline Series<double> sqrt(const Series<double>& square) {
    return root_of(square, std::sqrt(square[0]));
}

/// base^exponent with leading term `first`; base[0] is not 0.
template <class T>
Series<T> power_series(const Series<T>& base, double exponent, const T& first) {
    Series<T> power(first);
    for (std::size_t k = 1; k < Series<T>::kTerms; ++k) {
        T sum = 0;
        for (std::size_t i = 1; i <= k; ++i)
            sum += (exponent * static_cast<double>(i) - static_cast<double>(k - i)) *
                   product(base[i], power[k - i]);
        power[k] = sum / (static_cast<double>(k) * base[0]);
    }
    return power;
}

/// base^exponent, base[0] > 0
inline Series<double> pow(const Series<double>& base, double exponent) {
    return power_series(base, exponent, std::pow(base[0], exponent));
}

}  // namespace irido
