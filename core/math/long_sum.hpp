#pragma once

namespace irido {

/// A sum to twice the precision of a double, so that it rounds to the same double in whatever order
/// and parts the terms are added: the parts' errors are of 2^-106 of the terms each. Source: D. E.
/// Knuth, The Art of Computer Programming 2, section 4.2.2 (the exact error of a sum).
struct LongSum {
    double high = 0, low = 0;

    void add(double term) {
        const double sum = high + term, of_term = sum - high;
        low += (high - (sum - of_term)) + (term - of_term);
        high = sum;
    }
    void add(const LongSum& other) {
        add(other.high);
        add(other.low);
    }
    double value() const { return high + low; }
};

}  // namespace irido
