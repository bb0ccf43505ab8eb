#pragma once

#include <array>
#include <vector>

#include "core/scratch/visible_scratch.hpp"

namespace irido {

/// power() of a scratch for many y: the closed form of an infinite one; polynomials on panels,
/// halved until they are within 1e-11 of a panel's largest value, of one with ends. Refers to the
/// scratch.
class LobeTable {
public:
    /// Ends further off than this, in coherence radii, change integrals over y by 1e-8 at most; by
    /// default they are left out.
    static constexpr double kFarthestEnd = 6;

    /// first, last  the range of |y|; beyond it power() itself is asked
    LobeTable(const VisibleScratch& scratch, double first, double last,
              double farthest_end = kFarthestEnd);

    bool has_ends() const { return has_ends_; }
    double operator()(double y) const;

private:
    static constexpr std::size_t kNodes = 24;
    struct Piece {
        double first, last;
        std::array<double, kNodes> coefficient;
    };
    void add(double first, double last, int depth);

    const VisibleScratch& scratch_;
    bool has_ends_;
    std::vector<Piece> pieces_;  ///< ascending, adjoining
};

}  // namespace irido
