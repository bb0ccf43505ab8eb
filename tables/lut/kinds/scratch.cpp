#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/colorimetry/difference.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "core/scratch/scratch.hpp"
#include "core/scratch/slit_color.hpp"
#include "tables/lut/color_values.hpp"
#include "tables/lut/kind_parts.hpp"
#include "tables/lut/light_facts.hpp"
#include "tables/lut/lut_kind.hpp"

namespace irido::tables {

namespace {

/// The contents of a table of scratches.
struct ScratchForm {
    bool carrier = false;     ///< Q instead of T
    bool derivative = false;  ///< T and its derivative with respect to u
    bool place = false;       ///< only the derivative with respect to x = u/(u + half)
};

/// u at x = 1/2 on the axis x = u/(u + half).
double half_of(const LutRequest& request) {
    return request.number("u-scale");
}

LutAxis slit_axis(const LutRequest& request) {
    LutAxis axis{"u_um", "um", {}};
    if (request.has("u")) {
        axis.values = request.list("u");
        return axis;
    }
    const auto count = static_cast<std::size_t>(request.number("u-count"));
    axis.half_at = half_of(request);
    for (std::size_t i = 0; i < count; ++i)
        axis.values.push_back(axis.at_place(static_cast<double>(i) / static_cast<double>(count)));
    return axis;
}

/// Places D/(D + scale): Q bends most where D is small, and T there is a small difference of Q.
LutAxis depth_axis(const LutRequest& request) {
    constexpr std::size_t kCount = 64;
    LutAxis axis{"depth_um", "um", {0, request.number("depth-max")}};
    axis.half_at = request.number("depth-scale");
    axis.values = axis.spaced(kCount);
    return axis;
}

class ScratchFunction {
public:
    ScratchFunction(const LutRequest& request, const ScratchForm& form, double largest_u_um,
                    double largest_depth_um)
        : form_(form),
          half_(half_of(request)),
          values_(request),
          colors_(
              std::make_shared<SlitColors>(*request.sensitivity, largest_u_um, largest_depth_um)) {}

    std::vector<double> operator()(const std::vector<LutAxis>& axes) const {
        const std::vector<double>&u = axes[0].values, &depth = axes[1].values;
        std::vector<double> values;
        if (form_.carrier) {
            const auto q = form_.place ? colors_->carried_slope(u, depth, kSlitCarriers_um)
                                       : colors_->carried(u, depth, kSlitCarriers_um);
            for (std::size_t i = 0; i < q.size(); ++i) {
                const double scale = form_.place ? per_place(u[i / depth.size()]) : 1;
                for (const Complex& part : q[i]) values.push_back(scale * part.real());
                for (const Complex& part : q[i]) values.push_back(scale * part.imag());
            }
            return values;
        }
        const auto t = form_.place ? std::vector<Triple>() : colors_->power(u, depth);
        const auto slope =
            form_.place || form_.derivative ? colors_->slope(u, depth) : std::vector<Triple>();
        for (std::size_t i = 0; i < u.size() * depth.size(); ++i) {
            if (!form_.place) add(values, t[i], 1);
            if (form_.derivative) add(values, slope[i], 1);
            if (form_.place) add(values, slope[i], per_place(u[i / depth.size()]));
        }
        return values;
    }

    /// du/dx
    double per_place(double u) const { return (u + half_) * (u + half_) / half_; }
    /// L*, a*, b* of XYZ, where the full lobe at mean depth has twice the XYZ of white.
    Triple lab_of(Triple value) const {
        for (double& component : value) component /= 2;
        return values_.to_lab(value);
    }
    const SlitColors& colors() const { return *colors_; }
    const ScratchForm& form() const { return form_; }
    Triple to_value(const Triple& xyz) const { return values_(xyz); }

private:
    void add(std::vector<double>& values, const Triple& xyz, double scale) const {
        const Triple value = values_(xyz);
        for (const double component : value) values.push_back(scale * component);
    }

    ScratchForm form_;
    double half_;
    ColorValues values_;
    std::shared_ptr<const SlitColors> colors_;
};

/// Extent in x of the light for which derivatives are measured.
constexpr double kNarrow = 0.05;

/// Interpolation error of A = Q(u, 0) along an axis of u, from A at its samples and at the targets.
class FlatError {
public:
    FlatError(const ScratchFunction& function, LutAxis axis)
        : function_(function), axis_(std::move(axis)), samples_(flat(axis_.values)) {}

    std::vector<Triple> operator()(const std::vector<double>& u) const {
        std::vector<Triple> errors = flat(u);
        for (std::size_t i = 0; i < u.size(); ++i) {
            const std::size_t cell = axis_.cell_of(u[i]);
            const std::size_t next = std::min(cell + 1, axis_.count() - 1);
            const double low = axis_.place_of(axis_.values[cell]),
                         high = axis_.place_of(axis_.values[next]);
            const double w =
                next == cell ? 0
                             : std::clamp((axis_.place_of(u[i]) - low) / (high - low), 0.0, 1.0);
            for (std::size_t c = 0; c < 3; ++c)
                errors[i][c] = samples_[cell][c] * (1 - w) + samples_[next][c] * w - errors[i][c];
        }
        return errors;
    }

private:
    /// A, or its derivative with respect to x.
    std::vector<Triple> flat(const std::vector<double>& u) const {
        const std::array depth{0.0};
        const auto q = function_.form().place
                           ? function_.colors().carried_slope(u, depth, kSlitCarriers_um)
                           : function_.colors().carried(u, depth, kSlitCarriers_um);
        std::vector<Triple> values(u.size());
        for (std::size_t i = 0; i < u.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                values[i][c] =
                    q[i][c].real() * (function_.form().place ? function_.per_place(u[i]) : 1);
        return values;
    }

    ScratchFunction function_;
    LutAxis axis_;
    std::vector<Triple> samples_;
};

/// Colour differences; with the carrier, those from the errors of A and Q combined.
LutMeasure scratch_measure(const ScratchFunction& function, const LutAxis& u_axis) {
    std::shared_ptr<const FlatError> flat_error;
    if (function.form().carrier) flat_error = std::make_shared<const FlatError>(function, u_axis);
    const std::string of = function.form().place ? "a light that covers 0.05 of x" : "T";
    return {
        "delta_e_2000 of " + of + ", the full lobe at mean depth being white",
        [function, flat_error](const std::vector<LutAxis>& axes, std::span<const double> exact,
                               std::span<const double> approximate) {
            const ScratchForm& form = function.form();
            const std::size_t channels = form.carrier || form.derivative ? 6 : 3;
            const std::vector<double>&u = axes[0].values, &depth = axes[1].values;
            std::vector<Triple> t;
            if (form.carrier)
                t = form.place ? function.colors().slope(u, depth)
                               : function.colors().power(u, depth);
            const std::vector<Triple> flat =
                form.carrier ? (*flat_error)(u) : std::vector<Triple>();
            const double covered = form.place ? kNarrow : 1;
            std::vector<double> result;
            for (std::size_t i = 0; i * channels < exact.size(); ++i) {
                Triple a{}, b{};
                const double* const is = exact.data() + i * channels;
                const double* const was = approximate.data() + i * channels;
                for (std::size_t c = 0; c < 3; ++c) {
                    if (!form.carrier) {
                        a[c] = covered * is[c], b[c] = covered * was[c];
                        continue;
                    }
                    const double scale = form.place ? function.per_place(u[i / depth.size()]) : 1;
                    const Complex off(was[c] - is[c], was[c + 3] - is[c + 3]);
                    const Complex wave =
                        std::polar(1.0, 2 * kTwoPi * depth[i % depth.size()] / kSlitCarriers_um[c]);
                    a[c] = covered * scale * t[i][c];
                    b[c] = a[c] + covered * 2 * (flat[i / depth.size()][c] - (wave * off).real());
                }
                result.push_back(ciede2000(function.lab_of(a), function.lab_of(b)));
            }
            return result;
        }};
}

std::vector<std::string> scratch_channels(const LutRequest& request, const ScratchForm& form) {
    const bool is_xyz = request.space->name == "xyz";
    const std::array<std::string, 3> names = is_xyz ? std::array<std::string, 3>{"X", "Y", "Z"}
                                                    : std::array<std::string, 3>{"r", "g", "b"};
    std::vector<std::string> channels;
    const auto add = [&](const std::string& before, const std::string& after) {
        for (const std::string& name : names)
            channels.emplace_back(before).append(name).append(after);
    };
    const std::string before = form.place ? "d" : "", after = form.place ? "_dx" : "";
    if (form.carrier) {
        add(before, after + "_re");
        add(before, after + "_im");
        return channels;
    }
    add(before, after);
    if (form.derivative) add("d", "_du");
    return channels;
}

LutPlan plan(const LutRequest& request) {
    const ScratchForm form{request.has("carrier"), request.has("derivative"),
                           request.has("per-place")};
    if (form.derivative && (form.carrier || form.place))
        throw DomainError("--derivative cannot be combined with --carrier or --per-place");
    if (form.carrier && request.space->name != "xyz")
        throw DomainError("--carrier requires --space xyz: X, Y and Z have carriers of their own");
    AxisPlan u{slit_axis(request), true},
        depth = listed_axis(request, "depth", {"depth_um", "um", {}});
    if (!request.has("depth")) depth.axis = depth_axis(request);
    if (request.has("u")) u = listed_axis(request, "u", u.axis);
    if (form.carrier && !form.place && depth.axis.values.front() != 0)
        throw DomainError("--carrier requires depths that begin at 0, where Q is A (got " +
                          to_text(depth.axis.values.front()) + ")");
    LutPlan result;
    const double largest_u = std::max(u.axis.values.front(), u.axis.values.back());
    const double largest_depth = std::max(depth.axis.values.front(), depth.axis.values.back());
    const bool is_placed = u.axis.half_at > 0, is_deep_placed = depth.axis.half_at > 0;
    const LutAxis u_axis = u.axis;
    result.axes = {std::move(u), std::move(depth)};
    result.channels = scratch_channels(request, form);
    const ScratchFunction function(request, form, largest_u, largest_depth);
    result.evaluate = function;
    result.measure = scratch_measure(function, u_axis);
    result.facts = light_facts(request);
    result.facts["color_space"] = request.space->name;
    auto& facts = result.facts["request"];
    if (request.space->name != "xyz")
        facts["adaptation"] = request.adaptation == Adaptation::bradford ? "bradford" : "none";
    if (is_placed || form.place) facts["u_scale_um"] = half_of(request);
    if (is_deep_placed) facts["depth_scale_um"] = request.number("depth-scale");
    auto& notes = result.facts["notes"] = nlohmann::json::array();
    if (is_placed)
        notes.push_back("u_um is equally spaced in u/(u + u_scale_um), in which to interpolate");
    if (is_deep_placed)
        notes.push_back(
            "depth_um is equally spaced in D/(D + depth_scale_um), in which to interpolate");
    if (form.carrier) facts["carrier_um"] = kSlitCarriers_um;
    return result;
}

/// T rises with u from 0 to less than twice the white, |Q| to less than half the white.
std::vector<std::string> problems(const Lut& lut) {
    if (lut.facts.at("color_space") != "xyz") return {};
    const auto& white = lut.facts.at("request").at("white_xyz");
    const std::size_t channels = lut.channels.size();
    const bool is_complex = lut.channels.front().ends_with("_re"),
               is_slope = lut.channels.front().starts_with("d");
    if (is_slope) return {};
    const double rounding = rounding_of(lut.type);
    for (std::size_t i = 0; i < lut.values.size(); ++i) {
        const double w = white[i % 3].get<double>(), value = lut.values[i];
        const bool is_derivative = i % channels >= 3 && !is_complex;
        const double most = (is_complex ? 0.5 : is_derivative ? 13 : 2.0) * w + rounding;
        const double least = is_complex ? -most : -rounding;
        if (value < least || value > most)
            return {lut.channels[i % channels] + " must be in [" + to_text(least) + ", " +
                    to_text(most) + "] at " + place_in(lut, i / channels) + " (got " +
                    to_text(value) + ")"};
    }
    return {};
}

}  // namespace

extern const LutKind lut_kind_scratch = {
    .name = "scratch",
    .summary = "Colours that scratches diffract, for every width, direction and area light.",
    .axes = "u_um, depth_um",
    .notes =
        "T_j(u, D) = int s_j(L) 4 sin^2(2 pi D/L) F(2 pi u/L)/pi dL with F(x) = Si(x) -\n"
        "(1 - cos x)/x, s_j the weighted colour-matching functions, u = W q for a scratch of\n"
        "width W and depth D, q the sum of the directions across it. T is odd in u. An area\n"
        "light that covers q0..q1 gives rho [T(W q1, D) - T(W q0, D)] of its radiance, rho the\n"
        "scratch's share of the area; white, the full lobe at mean depth, is 2. --carrier\n"
        "stores Q, smooth in D (so 64 depths do): T = 2 Q(u, 0) - 2 Re[exp(4 pi i D/carrier_j)\n"
        "Q(u, D)]. Lights that cover less than 0.05 in u/(u + C) need --per-place: dT/dx at one\n"
        "or two Gauss points, which f16 holds; differences of T need f32.",
    .examples = {"scratch --u 0:3:0.1 --depth 0.14,0.3",
                 "scratch --carrier --dtype f32 -o scratch.ktx2",
                 "scratch --carrier --per-place --dtype f16 -o narrow.ktx2"},
    .light = true,
    .space = true,
    .text_type = "f64",
    .options = {{.name = "u",
                 .type = LutOption::Type::list,
                 .help = "u = W q, um, [0, 1000] [U-COUNT values, equally spaced in\n"
                         "u/(u + U-SCALE) from 0 on, U-COUNT of which would be 1]",
                 .lowest = 0,
                 .highest = SlitColors::kLargest_u_um},
                {.name = "u-count",
                 .type = LutOption::Type::whole,
                 .help = "number of values of u, [16, 1024] [256]; the last one, U-SCALE times\n"
                         "U-COUNT - 1, is 1000 at most",
                 .fallback = "256",
                 .lowest = 16,
                 .highest = 1024},
                {.name = "u-scale",
                 .type = LutOption::Type::number,
                 .help = "C of x = u/(u + C), um, [0.01, 3.9] [2]",
                 .fallback = "2",
                 .lowest = 0.01,
                 .highest = 3.9},
                {.name = "depth",
                 .type = LutOption::Type::list,
                 .help = "depths D, um, [0, 100] [64 values, equally spaced in\n"
                         "D/(D + DEPTH-SCALE) from 0 to DEPTH-MAX]",
                 .lowest = 0,
                 .highest = kDeepest_um},
                {.name = "depth-scale",
                 .type = LutOption::Type::number,
                 .help = "C of D/(D + C), um, [0.01, 100] [1]",
                 .fallback = "1",
                 .lowest = 0.01,
                 .highest = kDeepest_um},
                {.name = "depth-max",
                 .type = LutOption::Type::number,
                 .help = "um, [0.001, 100] [3.15]",
                 .fallback = "3.15",
                 .lowest = 0.001,
                 .highest = kDeepest_um},
                {.name = "derivative",
                 .type = LutOption::Type::flag,
                 .help = "also store dT/du, per um"},
                {.name = "per-place",
                 .type = LutOption::Type::flag,
                 .help = "store dT/dx = dT/du (u + C)^2/C instead of T, for narrow lights"},
                {.name = "carrier",
                 .type = LutOption::Type::flag,
                 .help = "divide out each channel's carrier: Q instead of T"}},
    .plan = plan,
    .problems = problems,
};

}  // namespace irido::tables
