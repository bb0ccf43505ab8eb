#include "core/interference/vector/program.hpp"

#include <algorithm>
#include <map>

#include "core/math/vector_math.hpp"

namespace irido {

namespace {

/// Groups of fewer layers in all are cheaper layer by layer than in closed form.
constexpr std::uint64_t kFewLayers = 40;

/// Fewer periods of a hosted mirror than this are cheaper layer by layer.
constexpr std::uint64_t kFewMirrorPeriods = 7;

/// Groups without a closed form are written out up to this many layers: the roundings of equal
/// layers add up.
constexpr std::uint64_t kMostWrittenOut = 200;

/// Layers of a period that is raised to its power in closed form.
constexpr std::size_t kLongestPeriod = 64;

/// The steps of a stack, collected from the substrate up.
class Compiler {
public:
    Compiler(Program& program, const std::vector<bool>& absorbs)
        : program_(program), absorbs_(absorbs) {}

    /// False if the elements are better left to the plain kernel.
    bool add(std::span<const Element> elements) {
        for (std::size_t i = elements.size(); i-- > 0;) {
            if (const Layer* layer = std::get_if<Layer>(&elements[i].value)) {
                add(layer->material, layer->thickness_nm);
            } else if (!add(std::get<Group>(elements[i].value))) {
                return false;
            }
        }
        return true;
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

    void add(std::size_t material, double thickness_nm) {
        if (thickness_nm == 0) return;
        using Kind = Program::Kind;
        const Kind kind = absorbs_[material] ? Kind::absorbing : Kind::transparent;
        const auto position = static_cast<std::uint32_t>(program_.order.size());
        program_.order.push_back(shared_layer(material, thickness_nm));
        if (program_.steps.empty() || program_.steps.back().kind != kind)
            program_.steps.push_back({kind, position, 0});
        ++program_.steps.back().count;
    }

    bool add(const Group& group) {
        if (group.elements.size() == 1 && std::holds_alternative<Layer>(group.elements[0].value)) {
            const Layer& layer = std::get<Layer>(group.elements[0].value);
            add(layer.material, layer.thickness_nm * static_cast<double>(group.repeat));
            return true;
        }
        std::vector<Layer> period;
        if (!write_out(group.elements, period)) return false;
        const bool transparent = std::ranges::none_of(
            period, [&](const Layer& layer) { return absorbs_[layer.material]; });
        const std::uint64_t all = group.repeat * period.size();
        if (transparent && group.repeat > 1 && all > kFewLayers &&
            period.size() <= kLongestPeriod) {
            add_period(period, static_cast<std::uint32_t>(group.repeat));
            return true;
        }
        if (all > kMostWrittenOut) return false;
        for (std::uint64_t n = 0; n < group.repeat; ++n)
            for (std::size_t i = period.size(); i-- > 0;)
                add(period[i].material, period[i].thickness_nm);
        return true;
    }

    void add_period(const std::vector<Layer>& period, std::uint32_t repeat) {
        Program::Step step{Program::Kind::group, static_cast<std::uint32_t>(program_.order.size()),
                           static_cast<std::uint32_t>(period.size()), repeat};
        for (std::size_t i = period.size(); i-- > 0;)
            program_.order.push_back(shared_layer(period[i].material, period[i].thickness_nm));
        program_.steps.push_back(step);
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
    std::map<std::size_t, std::uint32_t> media_;
    std::map<std::pair<std::uint32_t, double>, std::uint32_t> layers_;
};

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

std::optional<Program> compile(std::span<const Element> elements, std::size_t substrate,
                               const std::vector<bool>& absorbs) {
    Program program;
    Compiler compiler(program, absorbs);
    if (!compiler.add(elements)) return std::nullopt;
    program.media.push_back({substrate, substrate != Program::kIncident && absorbs[substrate]});
    std::size_t single = 0;
    for (const Program::Step& step : program.steps)
        if (step.kind != Program::Kind::group) single += step.count;
    program.shares_layers = single >= 2 * program.layers.size();
    return program;
}

}  // namespace irido
