#include "core/scratch/lobe_table.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/constants.hpp"

namespace irido {

LobeTable::LobeTable(const VisibleScratch& scratch, double first, double last, double farthest_end)
    : scratch_(scratch), has_ends_(scratch.has_ends() && scratch.ends_within(farthest_end)) {
    if (has_ends_ && first < last) add(first, last, 0);
}

void LobeTable::add(double first, double last, int depth) {
    constexpr int kDeepest = 14;
    constexpr double kAccuracy = 1e-11;
    Piece piece{first, last, {}};
    std::array<double, kNodes> values{};
    double largest = 0;
    const double half = (last - first) / 2;
    const auto angle = [](std::size_t j) {
        return kPi * (static_cast<double>(j) + 0.5) / static_cast<double>(kNodes);
    };
    for (std::size_t j = 0; j < kNodes; ++j) {
        values[j] = scratch_.power(first + half * (1 + std::cos(angle(j))));
        largest = std::max(largest, std::abs(values[j]));
    }
    for (std::size_t k = 0; k < kNodes; ++k) {
        double sum = 0;
        for (std::size_t j = 0; j < kNodes; ++j)
            sum += values[j] * std::cos(angle(j) * static_cast<double>(k));
        piece.coefficient[k] = (k == 0 ? 1 : 2) * sum / static_cast<double>(kNodes);
    }
    const double tail = std::abs(piece.coefficient[kNodes - 1]) +
                        std::abs(piece.coefficient[kNodes - 2]) +
                        std::abs(piece.coefficient[kNodes - 3]);
    if (tail > kAccuracy * largest && depth < kDeepest) {
        add(first, first + half, depth + 1);
        add(first + half, last, depth + 1);
        return;
    }
    pieces_.push_back(piece);
}

double LobeTable::operator()(double y) const {
    const double size = std::abs(y);
    if (!has_ends_) return scratch_.weight() * std::exp(-y * y);
    if (pieces_.empty() || size < pieces_.front().first || size > pieces_.back().last)
        return scratch_.power(y);
    const auto next = std::ranges::upper_bound(pieces_, size, {}, &Piece::first);
    const Piece& piece = next == pieces_.begin() ? *next : *std::prev(next);
    const double x =
        std::clamp(2 * (size - piece.first) / (piece.last - piece.first) - 1, -1.0, 1.0);
    double one = 0, two = 0;
    for (std::size_t k = kNodes - 1; k > 0; --k) {
        const double value = 2 * x * one - two + piece.coefficient[k];
        two = one;
        one = value;
    }
    return x * one - two + piece.coefficient[0];
}

}  // namespace irido
