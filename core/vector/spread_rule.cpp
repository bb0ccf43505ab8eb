#include "core/vector/spread_rule.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace irido {

namespace {

/// Both coefficients of a harmonic, at most.
constexpr double kLargestHarmonic = 2 / std::numbers::pi;

/// Polynomials orthonormal under the standard normal distribution up to a degree: the last one, and
/// the sum of the squares of those before it.
struct Hermite {
    double last, squares;
};
Hermite hermite(std::size_t degree, double x) {
    double before = 0, now = 1, squares = 0;
    for (std::size_t k = 0; k < degree; ++k) {
        squares += now * now;
        const auto n = static_cast<double>(k);
        const double next = (x * now - std::sqrt(n) * before) / std::sqrt(n + 1);
        before = now;
        now = next;
    }
    return {now, squares};
}

/// The zero between two ends.
double zero_of_hermite(std::size_t degree, double low, double high) {
    const bool falls = hermite(degree, low).last > 0;
    for (;;) {
        const double middle = (low + high) / 2;
        if (!(middle > low && middle < high)) return middle;
        ((hermite(degree, middle).last > 0) == falls ? low : high) = middle;
    }
}

/// Rules of 1 to kMostHermiteNodes: the zeros of a degree lie between those of the one before.
std::vector<std::vector<HermiteNode>> all_hermite_rules() {
    std::vector<std::vector<HermiteNode>> rules(kMostHermiteNodes + 1);
    std::vector<double> positive;  // zeros of the degree before
    for (std::size_t degree = 1; degree <= kMostHermiteNodes; ++degree) {
        const bool has_middle = degree % 2 == 1;
        std::vector<double> ends = positive, zeros;
        if (has_middle) {
            zeros.push_back(0);
        } else {
            ends.insert(ends.begin(), 0);
        }
        ends.push_back(std::sqrt(4 * static_cast<double>(degree) + 2));
        for (std::size_t i = 0; i + 1 < ends.size(); ++i)
            zeros.push_back(zero_of_hermite(degree, ends[i], ends[i + 1]));
        for (const double x : zeros) rules[degree].push_back({x, 1 / hermite(degree, x).squares});
        positive.assign(zeros.begin() + (has_middle ? 1 : 0), zeros.end());
    }
    return rules;
}

/// Part of a Gaussian's k-th harmonic that is left of a full turn's: exp(-k^2 sigma^2/2), from one
/// k to the next.
struct Fall {
    explicit Fall(double sigma) : first(std::exp(-sigma * sigma / 2)), next(first) {}

    double first, next;  ///< next: factor from k to k + 1, 2k + 1 powers of the first
    double step() {
        const double factor = next;
        next *= first * first;
        return factor;
    }
};

/// Harmonics up to which phases that are equally spaced have to resolve.
std::optional<std::size_t> equal_harmonics(const SpreadPhase& phase, double error) {
    std::array<double, 2 * kMostSeriesTerms + 2> left{};  // of harmonics
    Fall fall(phase.least);
    left[0] = 1;
    for (std::size_t k = 1; k < left.size(); ++k) left[k] = left[k - 1] * fall.step();
    double power = 1;  // ratio^most
    for (std::size_t most = 1; most <= kMostSeriesTerms; ++most) {
        power *= phase.ratio;
        // harmonics k from most + 1 on are lost, and come back as count - k
        const std::size_t count = 2 * most + 1;
        double sum = 0, size = power;
        for (std::size_t k = most + 1; k <= count; ++k) {
            sum += size * (left[k] + left[count - k]);
            size *= phase.ratio;
        }
        sum += 2 * size / (1 - phase.ratio);
        if (kLargestHarmonic * sum <= error) return most;
    }
    return {};
}

/// Nodes of Gauss and Hermite's rule: its error for cos(kx) is at most n! k^(2n)/(2n)!, and 2.
std::optional<std::size_t> hermite_count(const SpreadPhase& phase, double error) {
    constexpr std::size_t kMost = 96;
    std::array<double, kMost> size{}, bound{};  // of harmonics, and of errors
    std::size_t harmonics = 0;
    double rest = kLargestHarmonic * 2 / (1 - phase.ratio), power = 1;
    for (; rest > error / 4; ++harmonics) {
        if (harmonics == kMost) return {};
        size.at(harmonics) = kLargestHarmonic * power;
        bound.at(harmonics) = 1;
        power *= phase.ratio;
        rest *= phase.ratio;
    }
    for (std::size_t n = 1; n <= kMostHermiteNodes; ++n) {
        double sum = rest;
        for (std::size_t i = 0; i < harmonics; ++i) {
            const double frequency = static_cast<double>(i + 1) * phase.most;
            bound[i] *= frequency * frequency / (2 * (2 * static_cast<double>(n) - 1));
            sum += size[i] * std::min(2.0, bound[i]);
        }
        if (sum <= error) return n;
    }
    return {};
}

/// Coefficients |r_j r_k|, with those of both signs of a frequency, and what else they may be:
/// waves of fields that do not exist can be larger than those that do.
constexpr double kLargestWaves = 4;

/// Standard deviations within which a product of waves is at most exp(kFar times its loss) times
/// that at the mean.
constexpr double kFar = 8;

/// A product of waves z^j conj(z)^k.
struct WaveProduct {
    double size;   ///< of its coefficient
    double mean;   ///< that times its modulus at the mean thickness
    double bound;  ///< frequency^(2n) n!/(2n)!
    double power;  ///< (frequency^2/2)^n/n!
    double square, far, grown;

    /// Of n nodes, from that of n - 1: as that of hermite_count(), where the wave is at most
    /// exp(kFar loss) larger than at the mean; and by the sum over the moments from 2n on, none of
    /// which Gauss's rule makes larger than it is.
    double error(double n) {
        bound *= square / (2 * (2 * n - 1));
        power *= square / (2 * n);
        return std::min(2 * size, mean * std::min(far * bound, grown * power));
    }
};

double limited_exp(double x) {
    return std::exp(std::min(x, 600.0));
}

/// Larger ratios have so many products that a bound on them takes longer than the means.
constexpr double kLargestLossyRatio = 0.5;

/// What all higher orders of products may be, by the least product that is listed, and that by the
/// error.
constexpr double kHigher = 256, kListed = 1e-3;

/// Products whose coefficients are at least `least`; all others together are at most `rest`.
/// Nothing if they are too many.
std::optional<std::vector<WaveProduct>> wave_products(const SpreadPhase& phase, double least,
                                                      double& rest) {
    constexpr std::size_t kMost = 48;
    const double turn2 = phase.most * phase.most, loss2 = phase.loss * phase.loss;
    std::vector<WaveProduct> products;
    double size = kLargestWaves, before = 0, wave = 1;  // of ratio^(order - 1), and of one less
    double little = 0;                                  // of all that are not listed
    const double further = 1 / (1 - phase.ratio);
    for (std::size_t order = 1; order <= kMost; ++order) {
        const auto m = static_cast<double>(order);
        for (std::size_t less = 0; 2 * less <= order; ++less) {
            const double of = less == 0 ? size : before;
            const double difference = m - 2 * static_cast<double>(less);
            const double square = difference * difference * turn2 + m * m * loss2;
            if (of < least) {
                little += 2 * of;
                continue;
            }
            products.push_back({of, of * wave, 1, 1, square, limited_exp(kFar * m * phase.loss),
                                limited_exp(square / 2)});
        }
        wave *= phase.wave;  // T has one wave less
        before = size;
        size *= phase.ratio;
        const double grown = wave * limited_exp(m * m * loss2 / 2);
        const double higher = 2 * (m + 2) * before * further * further * std::min(1.0, grown);
        rest = little + higher;
        if (higher <= kHigher * least) return products;
    }
    return {};
}

}  // namespace

std::optional<SpreadRule> lossy_spread_rule(const SpreadPhase& phase, double error) {
    if (phase.ratio > kLargestLossyRatio) return {};
    double rest = 0;
    std::optional<std::vector<WaveProduct>> products = wave_products(phase, kListed * error, rest);
    if (!products) return {};
    for (std::size_t n = 1; n <= kMostHermiteNodes; ++n) {
        double sum = rest;
        for (WaveProduct& product : *products) sum += product.error(static_cast<double>(n));
        if (hermite_nodes(n).back().x > phase.depth) return {};
        if (sum <= error) return SpreadRule{true, n};
    }
    return {};
}

std::optional<std::size_t> series_terms(const SpreadPhase& phase, double error) {
    Fall fall(phase.least);
    double size = kLargestHarmonic * fall.step();  // of harmonic 1
    for (std::size_t terms = 1; terms <= kMostSeriesTerms; ++terms) {
        size *= phase.ratio * fall.step();  // the first one left out
        if (size <= error * (1 - phase.ratio * fall.next)) return terms;
    }
    return {};
}

std::optional<SpreadRule> spread_rule(const SpreadPhase& phase, double error) {
    const std::optional<std::size_t> harmonics = equal_harmonics(phase, error);
    const std::optional<std::size_t> nodes = hermite_count(phase, error);
    if (nodes && (!harmonics || *nodes <= 2 * *harmonics + 1)) return SpreadRule{true, *nodes};
    if (harmonics) return SpreadRule{false, 2 * *harmonics + 1};
    return {};
}

std::span<const HermiteNode> hermite_nodes(std::size_t count) {
    static const std::vector<std::vector<HermiteNode>> rules = all_hermite_rules();
    return rules.at(count);
}

}  // namespace irido
