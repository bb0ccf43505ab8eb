#pragma once

#include "tables/pictures/figure.hpp"

namespace irido::tables {

/// A label of an axis and its coordinate.
struct Tick {
    double value;
    std::string text;
};

/// Maps the values of an axis to coordinates in a picture.
class AxisPlaces {
public:
    /// axis       the axis
    /// low, high  range of the data, used for ends that the axis leaves open; widened if equal
    /// widen      widens the range of the data to round numbers
    /// from, to   coordinates of the axis' first and last value
    AxisPlaces(const FigureAxis& axis, double low, double high, bool widen, double from, double to);

    double operator()(double value) const;
    /// The value at a coordinate.
    double value_at(double coordinate) const;
    double first() const { return first_; }
    double last() const { return last_; }
    double from() const { return from_; }
    double to() const { return to_; }
    /// Labels at least `space` apart.
    std::vector<Tick> ticks(double space) const;

private:
    double scaled(double value) const;
    std::vector<Tick> powers(double space) const;

    const FigureAxis& axis_;
    double first_, last_, from_, to_;
};

/// A number as a label, with a true minus sign and superscript powers of ten.
std::string tick_text(double value, double step);

}  // namespace irido::tables
