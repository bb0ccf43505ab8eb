#include <algorithm>
#include <functional>
#include <memory>

#include "core/coherent/coherent.hpp"
#include "core/color/remapped_film.hpp"
#include "core/color/stack_color.hpp"
#include "core/error.hpp"
#include "core/math/angle_of_cosine.hpp"
#include "core/stack/stack.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/documents/varied_stack.hpp"
#include "tables/lut/color_values.hpp"
#include "tables/lut/lut_kind.hpp"

namespace irido::tables {

namespace {

/// Every combination of one sample of each axis, the last axis fastest.
void for_each_combination(std::span<const LutAxis> axes,
                          const std::function<void(const std::vector<double>&)>& visit) {
    std::vector<std::size_t> place(axes.size());
    std::vector<double> values(axes.size());
    for (bool more = true; more;) {
        for (std::size_t a = 0; a < axes.size(); ++a) values[a] = axes[a].values[place[a]];
        visit(values);
        more = false;
        for (std::size_t a = axes.size(); a-- > 0 && !more;) {
            more = ++place[a] < axes[a].count();
            if (!more) place[a] = 0;
        }
    }
}

/// Samples that an axis has at least where a tolerance or a size decides.
constexpr std::size_t kFewSamples = 32;

double remap_width(const LutRequest& request) {
    return request.has("remap-index") ? request.number("remap-index") : 0;
}

std::string path_of_spread(const LutRequest& request) {
    const std::string thickness = "thickness_nm";
    std::string path = request.vary.empty() ? std::string() : request.vary.front().path;
    if (!path.ends_with(thickness))
        throw DomainError("sigma requires the first varied value to be a thickness");
    return path.replace(path.size() - thickness.size(), thickness.size(), "thickness_sigma_nm");
}

/// The colours of a stack with varied values, at angles given as cosines or in degrees. Axes: the
/// standard deviation of the first value if requested, the angle, the values.
class ColorFunction {
public:
    ColorFunction(std::shared_ptr<const ColorTables> tables, const LutRequest& request,
                  std::size_t colors, bool by_cosine)
        : tables_(std::move(tables)),
          color_(request.color),
          values_(request),
          by_cosine_(by_cosine),
          remap_width_nm_(remap_width(request)) {
        color_.colors = colors;
        const std::vector<double> sigmas =
            request.has("sigma") ? request.list("sigma") : std::vector{0.0};
        for (const double sigma : sigmas) add_level(request, sigma);
    }

    std::vector<double> operator()(const std::vector<LutAxis>& axes) const {
        const bool has_spread = levels_.size() > 1;
        if (!has_spread) return level_colors(levels_.front(), axes);
        std::vector<double> all;
        for (const double sigma : axes.front().values) {
            const Level& level = *std::ranges::find(levels_, sigma, &Level::sigma);
            const std::vector<double> values = level_colors(level, std::span(axes).subspan(1));
            all.insert(all.end(), values.begin(), values.end());
        }
        return all;
    }

private:
    struct Level {
        double sigma = 0;
        std::shared_ptr<const schemas::VariedStack> stack;
        std::shared_ptr<const ColorAlgorithm> algorithm;  ///< none if materials or structure vary
    };

    void add_level(const LutRequest& request, double sigma) {
        schemas::StackSource source = request.source;
        if (sigma != 0) schemas::set_value(source.document, path_of_spread(request), sigma);
        std::vector<double> first, last;
        for (const VariedValue& vary : request.vary) {
            first.push_back(vary.values.front());
            last.push_back(vary.values.back());
        }
        Level level{
            sigma,
            std::make_shared<schemas::VariedStack>(std::move(source), paths_of(request.vary)),
            nullptr};
        level.stack->at(last);  // throws now rather than later
        const Stack stack = level.stack->at(first);
        if (remap_width_nm_ > 0) {
            with_remapped_film(stack, remap_width_nm_);  // throws now, too
        } else if (level.stack->varies_thickness_only()) {
            ColorRequest asked = color_;
            if (!request.source.reverse)
                for (const VariedValue& vary : request.vary)
                    asked.varied.push_back(schemas::VariedStack::place_of(vary.path));
            level.algorithm = color_algorithm(*tables_, stack, {}, asked);
        }
        levels_.push_back(std::move(level));
    }

    /// Rejects colours too inaccurate for any table.
    static void require_known(const StackColor& color, double angle_deg) {
        constexpr double worst = 1e-4;
        if (!(color.error <= worst))
            throw DomainError("the colour at " + to_text(angle_deg) + " degrees has error " +
                              to_text(color.error) + ", tables require " + to_text(worst));
    }

    /// [angle][values][channel]
    std::vector<double> level_colors(const Level& level, std::span<const LutAxis> axes) const {
        std::vector<double> angles_deg;
        for (const double x : axes.front().values)
            angles_deg.push_back(by_cosine_ ? angle_of_cosine(x) : x);
        std::size_t combinations = 1, combination = 0;
        for (const LutAxis& axis : axes.subspan(1)) combinations *= axis.count();
        std::vector<double> values(angles_deg.size() * combinations * 3);
        std::vector<StackColor> colors(angles_deg.size());
        for_each_combination(axes.subspan(1), [&](const std::vector<double>& varied) {
            Stack stack = level.stack->at(varied);
            if (remap_width_nm_ > 0) stack = with_remapped_film(std::move(stack), remap_width_nm_);
            if (level.algorithm) {
                (*level.algorithm)(stack, angles_deg, colors);
            } else {
                ColorRequest own = color_;
                if (remap_width_nm_ > 0) own.colors = angles_deg.size();
                own.structures = std::max<std::size_t>(1, own.colors / angles_deg.size());
                (*color_algorithm(*tables_, stack, {}, own))(stack, angles_deg, colors);
            }
            for (std::size_t i = 0; i < colors.size(); ++i) {
                require_known(colors[i], angles_deg[i]);
                const Triple value = values_(colors[i].xyz);
                const std::size_t to = (i * combinations + combination) * 3;
                std::ranges::copy(value, values.begin() + static_cast<std::ptrdiff_t>(to));
            }
            ++combination;
        });
        return values;
    }

    std::shared_ptr<const ColorTables> tables_;
    std::vector<Level> levels_;
    ColorRequest color_;
    ColorValues values_;
    bool by_cosine_;
    double remap_width_nm_;
};

LutPlan plan(const LutRequest& request) {
    const bool by_cosine = !request.has("theta");
    LutPlan result;
    if (request.has("sigma") &&
        !std::ranges::is_sorted(request.list("sigma"), std::ranges::less_equal()))
        throw DomainError("sigma must ascend");
    if (request.has("sigma") && request.list("sigma").size() > 1) {
        if (request.vary.size() > 1)
            throw DomainError("sigma cannot be combined with a second varied value");
        result.axes.push_back({{"thickness_sigma_nm", "nm", request.list("sigma")}, true});
        result.mips = true;
    }
    result.axes.push_back(by_cosine ? AxisPlan{{"cos_theta", "", request.list("cos")}}
                                    : AxisPlan{{"theta_deg", "deg", request.list("theta")}});
    for (const VariedValue& vary : request.vary) {
        result.axes.push_back({{vary.path, unit_of_path(vary.path), vary.values}});
        result.axes.back().may_end_early = vary.path.ends_with("thickness_nm");
        result.axes.back().end_reason = "no fringes are left";
    }
    result.split_axis = result.axes.size() - 1;
    std::size_t colors = 1;
    for (AxisPlan& axis : result.axes) {
        axis.fixed = axis.fixed || !axis.axis.is_linear();
        // a range may be sampled more finely than its list says
        colors *= std::max(axis.axis.count(), axis.fixed ? 1 : kFewSamples);
    }
    result.channels = color_channels(request);
    const auto tables = std::make_shared<const ColorTables>(*request.sensitivity);
    result.evaluate = ColorFunction(tables, request, colors, by_cosine);
    result.roughly = [=](double error) -> LutPlan::Evaluate {
        return ColorFunction(tables, rougher(request, error), colors, by_cosine);
    };
    result.measure = color_measure(request);
    result.facts = color_facts(request);
    if (const double width_nm = remap_width(request); width_nm > 0)
        result.facts["request"]["remap_index_nm"] = width_nm;
    return result;
}

}  // namespace

extern const LutKind lut_kind_color = {
    .name = "color",
    .summary = "Colour of a stack over the angle of incidence and up to two varied values.",
    .axes = "cos_theta or theta_deg, the varied values",
    .notes =
        "Linear RGB of --space, unclamped, or X, Y, Z with --space xyz. Without --vary the\n"
        "angle is the only axis. The error is in CIEDE2000.",
    .examples = {"color \"air | 1.33@400 | 1.9+1.5i\" --vary layers.0.thickness_nm=0:1000/512 "
                 "-o film.ktx2 --dtype f16",
                 "color mirror.json --vary layers.0.layers.0.thickness_nm=80:120/64 "
                 "--tolerance 0.1 -o m.exr"},
    .stack = true,
    .light = true,
    .color = true,
    .vary = true,
    .options = {{.name = "cos",
                 .type = LutOption::Type::list,
                 .help = "cosines of the angles of incidence, [0, 1] [0:1/64]",
                 .fallback = "0:1/64",
                 .lowest = 0,
                 .highest = 1},
                {.name = "theta",
                 .type = LutOption::Type::list,
                 .help = "angles of incidence instead of cosines, degrees, [0, 90]",
                 .lowest = 0,
                 .highest = kLargestAngle_deg},
                {.name = "sigma",
                 .type = LutOption::Type::list,
                 .help = "standard deviations of the first varied value, a thickness, nm,\n"
                         "ascending; adds a first axis: mip levels in KTX2 files",
                 .lowest = 0,
                 .highest = kLargestThickness_nm},
                {.name = "remap-index",
                 .type = LutOption::Type::number,
                 .help = "for artists: the index of one film goes to the incident medium's where\n"
                         "its path 2 n d is less than this, nm (Belcour and Barla 2017 take 30)",
                 .lowest = 0,
                 .highest = kLargestThickness_nm}},
    .plan = plan,
    .problems = color_problems,
};

}  // namespace irido::tables
