#include "core/vector/program.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <memory_resource>

#include "core/math/vector_math.hpp"
#include "core/vector/spread_program.hpp"

namespace irido {

namespace {

/// Groups of fewer layers in all are cheaper layer by layer than in closed form.
constexpr std::uint64_t kFewLayers = 40;

/// Fewer periods of a hosted mirror than this are cheaper layer by layer.
constexpr std::uint64_t kFewMirrorPeriods = 7;

/// Groups without a closed form are written out up to this many layers: the roundings of equal
/// layers add up.
constexpr std::uint64_t kMostWrittenOut = 200;

/// Operations, about three transparent layers, below which a stored matrix does not pay, nor the
/// storing as a whole.
constexpr double kFewestFixedOperations = 120;

/// More layers of groups that absorb are cheaper in closed form than written out.
constexpr std::uint64_t kFewAbsorbingLayers = 12;

/// Layers of a period that is raised to its power in closed form.
constexpr std::size_t kLongestPeriod = 64;

/// The steps of a stack, collected from the substrate up.
class Compiler {
public:
    /// `sigma_nm`, if given, receives those of the layers, and no period may have any.
    Compiler(Program& program, const std::vector<bool>& absorbs, bool needs_A,
             std::vector<double>* sigma_nm = nullptr)
        : program_(program), absorbs_(absorbs), needs_A_(needs_A), sigma_nm_(sigma_nm) {
        program_.media.clear();
        program_.layers.clear();
        program_.order.clear();
        program_.steps.clear();
        program_.shares_layers = program_.absorbs = program_.has_absorbing_groups = false;
        program_.largest_thickness_nm = 0;
        program_.mirror.reset();
    }

    void add(const Layer& layer) { add(layer, 1); }

    /// Whether a layer of no thickness has a distribution.
    bool lacks_spread() const { return lacks_spread_; }

    /// Call after the layers.
    void add_substrate(std::size_t material) {
        program_.media.push_back({material, material != Program::kIncident && absorbs_[material]});
        std::size_t single = 0;
        for (const Program::Step& step : program_.steps)
            if (step.kind <= Program::Kind::absorbing) single += step.count;
        program_.shares_layers = single >= 2 * program_.layers.size();
    }

    /// False if the elements are better left to the plain kernel.
    bool add(std::span<const Element> elements) {
        for (std::size_t i = elements.size(); i-- > 0;) {
            if (const Layer* layer = std::get_if<Layer>(&elements[i].value)) {
                add(*layer);
            } else if (!add(std::get<Group>(elements[i].value))) {
                return false;
            }
        }
        return true;
    }

    /// The stored step for its elements.
    void add(const FixedRun& run) {
        program_.steps.push_back(run.step);
        program_.absorbs |= run.program.absorbs;
        program_.has_absorbing_groups |= run.program.has_absorbing_groups;
        program_.largest_thickness_nm =
            std::max(program_.largest_thickness_nm, run.program.largest_thickness_nm);
    }

    std::uint32_t medium(std::size_t material) {
        const auto [entry, is_new] =
            media_.try_emplace(material, static_cast<std::uint32_t>(program_.media.size()));
        if (is_new) program_.media.push_back({material, absorbs_[material]});
        return entry->second;
    }

private:
    std::uint32_t shared_layer(std::size_t material, double thickness_nm) {
        const std::uint32_t used = medium(material);
        const auto [entry, is_new] = layers_.try_emplace(
            {used, thickness_nm}, static_cast<std::uint32_t>(program_.layers.size()));
        if (is_new) program_.layers.push_back({used, thickness_nm});
        program_.absorbs |= absorbs_[material];
        program_.largest_thickness_nm = std::max(program_.largest_thickness_nm, thickness_nm);
        return entry->second;
    }

    /// One layer that is there `times` times in a row.
    void add(const Layer& layer, double times) {
        add(layer.material, layer.thickness_nm * times);
        if (!sigma_nm_ || layer.thickness_sigma_nm == 0) return;
        if (layer.thickness_nm > 0) {
            sigma_nm_->back() = layer.thickness_sigma_nm * times;
        } else {
            lacks_spread_ = true;
        }
    }

    void add(std::size_t material, double thickness_nm) {
        if (thickness_nm == 0) return;
        using Kind = Program::Kind;
        const Kind kind = absorbs_[material] ? Kind::absorbing : Kind::transparent;
        const auto position = static_cast<std::uint32_t>(program_.order.size());
        program_.order.push_back(shared_layer(material, thickness_nm));
        if (program_.steps.empty() || program_.steps.back().kind != kind)
            program_.steps.push_back({kind, position, 0});
        ++program_.steps.back().count;
        if (sigma_nm_) sigma_nm_->resize(program_.order.size());
    }

    bool add(const Group& group) {
        if (group.repeat == 1) return add(std::span(group.elements));
        if (group.elements.size() == 1 && std::holds_alternative<Layer>(group.elements[0].value)) {
            add(std::get<Layer>(group.elements[0].value), static_cast<double>(group.repeat));
            return true;
        }
        std::vector<Layer> period;
        if (!write_out(group.elements, period)) return false;
        if (sigma_nm_ && std::ranges::any_of(period, [](const Layer& layer) {
                return layer.thickness_sigma_nm > 0;
            }))
            return false;
        const bool transparent = std::ranges::none_of(
            period, [&](const Layer& layer) { return absorbs_[layer.material]; });
        const std::uint64_t all = group.repeat * period.size();
        if (group.repeat > 1 && period.size() <= kLongestPeriod) {
            if (transparent && all > kFewLayers) {
                add_period(Program::Kind::group, period, group.repeat);
                return true;
            }
            if (!transparent && all > (needs_A_ ? kMostWrittenOut : kFewAbsorbingLayers)) {
                add_period(Program::Kind::absorbing_group, period, group.repeat);
                program_.has_absorbing_groups = true;
                return true;
            }
        }
        if (all > kMostWrittenOut) return false;
        for (std::uint64_t n = 0; n < group.repeat; ++n)
            for (std::size_t i = period.size(); i-- > 0;)
                add(period[i].material, period[i].thickness_nm);
        return true;
    }

    void add_period(Program::Kind kind, const std::vector<Layer>& period, std::uint64_t repeat) {
        Program::Step step{kind, static_cast<std::uint32_t>(program_.order.size()),
                           static_cast<std::uint32_t>(period.size()),
                           static_cast<std::uint32_t>(repeat)};
        for (std::size_t i = period.size(); i-- > 0;)
            program_.order.push_back(shared_layer(period[i].material, period[i].thickness_nm));
        program_.steps.push_back(step);
        if (sigma_nm_) sigma_nm_->resize(program_.order.size());
    }

    /// Layers of a period with the groups in it written out; false if they are many.
    static bool write_out(std::span<const Element> elements, std::vector<Layer>& out) {
        for (const Element& element : elements) {
            if (const Layer* layer = std::get_if<Layer>(&element.value)) {
                out.push_back(*layer);
            } else {
                const Group& group = std::get<Group>(element.value);
                for (std::uint64_t n = 0; n < group.repeat; ++n)
                    if (!write_out(group.elements, out)) return false;
            }
            if (out.size() > kMostWrittenOut) return false;
        }
        return true;
    }

    Program& program_;
    const std::vector<bool>& absorbs_;
    const bool needs_A_;
    std::vector<double>* const sigma_nm_;
    bool lacks_spread_ = false;
    std::array<std::byte, 4096> room_;
    std::pmr::monotonic_buffer_resource memory_{room_.data(), room_.size()};
    std::pmr::map<std::size_t, std::uint32_t> media_{&memory_};
    std::pmr::map<std::pair<std::uint32_t, double>, std::uint32_t> layers_{&memory_};
};

/// The run of these elements, and whether the vector kernel takes it; its place in the rows is
/// open.
bool make_run(std::span<const Element> elements, std::size_t first, std::size_t count,
              std::size_t substrate, const std::vector<bool>& absorbs, FixedRun& run) {
    const bool lowest = first + count == elements.size();
    run.first = first;
    run.count = count;
    if (!compile(elements.subspan(first, count), lowest ? substrate : Program::kIncident, absorbs,
                 false, {}, run.program))
        return false;
    using enum Program::Kind;
    run.step.kind = lowest ? fixed_fields : run.program.absorbs ? fixed_complex : fixed_real;
    return true;
}

/// Operations of the parts of kernel.cpp: once for both polarizations + for each of them.
struct Operations {
    double once, each;
    double of(int polarizations) const { return once + each * polarizations; }
};
constexpr Operations kTransparentMedium{16, 0}, kAbsorbingMedium{42, 0};
constexpr double kTurn = kSinCosOperations;
constexpr Operations kTravellingLayer{kTurn + 2, 10}, kSharedTravellingLayer{0, 8},
    kTravellingMatrix{kTurn + 6, 0};
constexpr Operations kAbsorbingLayer{kTurn + 33, 25}, kSharedAbsorbingLayer{0, 17},
    kAbsorbingMatrix{kTurn + 49, 0};
constexpr Operations kLayerOfPeriod{kTurn + 2, 30}, kPowerOfPeriod{0, 92};
constexpr Operations kLossyLayerOfPeriod{kTurn + 40, 80}, kPowerOfLossyPeriod{0, kTurn + 280};
constexpr Operations kFixedReal{0, 9}, kFixedComplex{0, 17};
constexpr Operations kFilm{kTurn + 1, 18}, kEnds{3, 20};
constexpr Operations kMirror{2 * kTurn + 7, kTurn + 46}, kMirrorMedia{39, 0};

}  // namespace

std::optional<HostedMirror> fast_mirror(const std::optional<HostedMirror>& mirror,
                                        const std::vector<bool>& absorbs) {
    if (!mirror || absorbs[mirror->host] || absorbs[mirror->other]) return std::nullopt;
    return mirror->repeat < kFewMirrorPeriods ? std::nullopt : mirror;
}

bool has_few_layers(const HostedMirror& mirror) {
    return 2 * mirror.repeat <= kFewLayers;
}

double operations_of_mirror(int polarizations, bool constant) {
    return kMirror.of(polarizations) + (constant ? 0 : kMirrorMedia.of(polarizations));
}

double operations_per_point(const Program& program, int polarizations, bool constant) {
    if (constant && program.is_one_film()) return kFilm.of(polarizations);
    double sum = kEnds.of(polarizations);
    const auto add = [&](const Operations& part, double count) {
        sum += count * part.of(polarizations);
    };
    for (const Program::Step& step : program.steps) {
        switch (step.kind) {
            case Program::Kind::transparent:
                add(program.shares_layers ? kSharedTravellingLayer : kTravellingLayer, step.count);
                break;
            case Program::Kind::absorbing:
                add(program.shares_layers ? kSharedAbsorbingLayer : kAbsorbingLayer, step.count);
                break;
            case Program::Kind::group:
                add(kLayerOfPeriod, step.count);
                add(kPowerOfPeriod, 1);
                break;
            case Program::Kind::absorbing_group:
                add(kLossyLayerOfPeriod, step.count);
                add(kPowerOfLossyPeriod, 1);
                break;
            case Program::Kind::fixed_fields:
                break;
            case Program::Kind::fixed_real:
                add(kFixedReal, 1);
                break;
            case Program::Kind::fixed_complex:
                add(kFixedComplex, 1);
                break;
        }
    }
    if (program.shares_layers)
        for (const Program::PlainLayer& layer : program.layers)
            add(program.media[layer.medium].absorbs ? kAbsorbingMatrix : kTravellingMatrix, 1);
    if (!constant)
        for (const Program::UsedMedium& medium : program.media)
            add(medium.absorbs ? kAbsorbingMedium : kTransparentMedium, 1);
    return sum;
}

FixedRuns fixed_runs(std::span<const Element> elements, std::size_t substrate,
                     const std::vector<bool>& absorbs, std::span<const std::size_t> varied) {
    FixedRuns fixed;
    if (varied.empty()) return fixed;
    double saved = 0;
    std::size_t end = elements.size();
    for (std::size_t i = varied.size() + 1; i-- > 0;) {
        const std::size_t first = i == 0 ? 0 : varied[i - 1] + 1;
        FixedRun run;
        if (!make_run(elements, first, end - first, substrate, absorbs, run)) return {};
        const double operations = operations_per_point(run.program, 2, true) - kEnds.of(2);
        const bool lowest = end == elements.size();
        if (operations > (lowest ? 0 : kFewestFixedOperations)) {
            run.step.first = static_cast<std::uint32_t>(fixed.rows);
            fixed.rows += 2 * FixedRun::rows_of(run.step.kind) + 1;
            fixed.runs.push_back(std::move(run));
            saved += operations;
        }
        end = first == 0 ? 0 : first - 1;
    }
    if (saved < kFewestFixedOperations) return {};
    return fixed;
}

bool compile(std::span<const Element> elements, std::size_t substrate,
             const std::vector<bool>& absorbs, bool needs_A, const FixedRuns& fixed,
             Program& program) {
    Compiler compiler(program, absorbs, needs_A);
    std::size_t end = elements.size();
    for (const FixedRun& run : fixed.runs) {
        const std::size_t above = run.first + run.count;
        if (!compiler.add(elements.subspan(above, end - above))) return false;
        compiler.add(run);
        end = run.first;
    }
    if (!compiler.add(elements.first(end))) return false;
    compiler.add_substrate(substrate);
    return true;
}

bool compile(std::span<const Element> elements, std::size_t substrate,
             const std::vector<bool>& absorbs, double reach, SpreadProgram& program) {
    program.sigma_nm.clear();
    Compiler compiler(program.program, absorbs, false, &program.sigma_nm);
    if (!compiler.add(elements) || compiler.lacks_spread()) return false;
    compiler.add_substrate(substrate);
    std::size_t spreads = 0;
    for (std::size_t i = 0; i < program.sigma_nm.size(); ++i) {
        const double sigma_nm = program.sigma_nm[i];
        if (sigma_nm == 0) continue;
        const Program::PlainLayer& layer = program.program.layers[program.program.order[i]];
        if (layer.thickness_nm < reach * sigma_nm) return false;
        ++spreads;
    }
    return spreads > 0 && spreads <= kMostMeanSpreads;
}

void compile_layers(std::span<const Layer> layers, std::span<const std::size_t> listed,
                    std::size_t substrate, const std::vector<bool>& absorbs,
                    LayerProgram& program) {
    Compiler compiler(program.program, absorbs, true);
    program.owners.clear();
    program.without.clear();
    for (std::size_t i = layers.size(); i-- > 0;) {
        const auto owner = static_cast<std::uint32_t>(listed.empty() ? i : listed[i]);
        const bool is_there = layers[i].thickness_nm > 0;
        (is_there ? program.owners : program.without).push_back(owner);
        compiler.add(layers[i]);
    }
    compiler.add_substrate(substrate);
}

}  // namespace irido
