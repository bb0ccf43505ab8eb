#include "core/color/exact_color.hpp"

#include <algorithm>
#include <functional>
#include <mutex>

#include "core/color/quadrature/quadrature_color.hpp"
#include "core/color/spread_color.hpp"
#include "core/color/spread_means.hpp"
#include "core/error.hpp"
#include "core/math/lazy.hpp"

namespace irido {

namespace {

/// One algorithm, and another one for what it cannot do.
class SpecialColor : public ColorAlgorithm {
public:
    using Maker = std::function<std::unique_ptr<ColorAlgorithm>()>;

    SpecialColor(const ColorRequest& request, std::unique_ptr<ColorAlgorithm> special,
                 Maker make_other)
        : request_(request), special_(std::move(special)), make_other_(std::move(make_other)) {}

    void operator()(const Stack& stack, std::span<const double> angles_deg,
                    std::span<StackColor> colors) const override {
        const std::size_t sides = request_.sides.size();
        const bool all = try_special(stack, angles_deg, colors);
        for (std::size_t i = 0; i < angles_deg.size(); ++i) {
            const std::span<StackColor> of_angle = colors.subspan(i * sides, sides);
            const bool is_there = all || try_special(stack, angles_deg.subspan(i, 1), of_angle);
            if (is_there && std::ranges::all_of(of_angle, [&](const StackColor& color) {
                    return color.error <= request_.tolerance;
                }))
                continue;
            const ColorAlgorithm& other = *other_.get(lock_, [&] {
                return std::make_unique<std::unique_ptr<ColorAlgorithm>>(make_other_());
            });
            other(stack, angles_deg.subspan(i, 1), of_angle);
        }
    }

private:
    /// False if it does not take an angle.
    bool try_special(const Stack& stack, std::span<const double> angles_deg,
                     std::span<StackColor> colors) const {
        try {
            (*special_)(stack, angles_deg, colors);
            return true;
        } catch (const DomainError&) {
            return false;
        }
    }

    ColorRequest request_;
    std::unique_ptr<ColorAlgorithm> special_;
    Maker make_other_;
    mutable std::mutex lock_;
    mutable Lazy<std::unique_ptr<ColorAlgorithm>> other_;
};

}  // namespace

std::unique_ptr<ColorAlgorithm> or_quadrature(const ColorTables& tables, const Stack& stack,
                                              const ColorRequest& request,
                                              std::unique_ptr<ColorAlgorithm> special) {
    return std::make_unique<SpecialColor>(request, std::move(special), [&tables, stack, request] {
        return quadrature_color(tables, stack, request);
    });
}

std::unique_ptr<ColorAlgorithm> exact_color(const ColorTables& tables, const Stack& stack,
                                            const ColorMethod& method,
                                            const ColorRequest& request) {
    const auto without_means = [&tables, stack, method, request] {
        auto special = spread_color(tables, stack, method, request);
        return special ? or_quadrature(tables, stack, request, std::move(special))
                       : quadrature_color(tables, stack, request);
    };
    if (auto means = spread_means(tables, stack, request)) {
        return std::make_unique<SpecialColor>(request, std::move(means), without_means);
    }
    return without_means();
}

}  // namespace irido
