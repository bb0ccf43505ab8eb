#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "core/design/material_number.hpp"
#include "core/design/written_out.hpp"
#include "core/error.hpp"
#include "core/math/constants.hpp"
#include "schemas/documents/design_parts.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/input_error.hpp"

namespace irido::schemas {

namespace {

using nlohmann::json;

std::vector<std::string> steps_of(const std::string& path) {
    std::vector<std::string> steps{""};
    for (const char c : path) {
        if (c == '.') {
            steps.emplace_back();
        } else {
            steps.back() += c;
        }
    }
    return steps;
}

std::string path_of(std::span<const std::string> steps) {
    std::string path;
    for (const std::string& step : steps) path += (path.empty() ? "" : ".") + step;
    return path;
}

std::optional<std::size_t> index_of(const std::string& step) {
    constexpr std::size_t kLongest = 8;
    if (step.empty() || step.size() > kLongest) return std::nullopt;
    std::size_t index = 0;
    for (const char c : step) {
        if (c < '0' || c > '9') return std::nullopt;
        index = 10 * index + static_cast<std::size_t>(c - '0');
    }
    return index;
}

/// Finds the values that a path with * means, in the order of the document.
class PathFinder {
public:
    explicit PathFinder(json& document) : document_(document) {}

    std::vector<std::string> find(const std::string& path) {
        steps_ = steps_of(path);
        has_star_ = std::ranges::find(steps_, "*") != steps_.end();
        found_.clear();
        walk(document_, {});
        return found_;
    }

private:
    void walk(json& value, std::vector<std::string> taken) {
        if (taken.size() == steps_.size()) {
            if (value.is_number()) found_.push_back(path_of(taken));
            return;
        }
        const std::string& step = steps_[taken.size()];
        const auto go = [&](json& inner, const std::string& name) {
            taken.push_back(name);
            walk(inner, taken);
            taken.pop_back();
        };
        if (value.is_number() && is_material(taken) && (step == "n" || step == "k"))
            value = json{{"n", value}};
        if (value.is_array()) {
            const auto index = index_of(step);
            for (std::size_t i = 0; i < value.size(); ++i)
                if (step == "*" || index == i) go(value[i], std::to_string(i));
        } else if (value.is_object()) {
            if (step == "k" && value.contains("n") && !value.contains("k")) value["k"] = 0.0;
            if (has_star_ && step == "thickness_nm" && !value.value("coherent", true)) return;
            if (step == "*") {
                for (auto& [name, inner] : value.items()) go(inner, name);
            } else if (value.contains(step)) {
                go(value[step], step);
            }
        }
    }

    static bool is_material(const std::vector<std::string>& taken) {
        const std::string& last = taken.back();
        return last == "material" || last == "incident" || last == "substrate" ||
               (taken.size() == 2 && taken.front() == "materials");
    }

    json& document_;
    std::vector<std::string> steps_, found_;
    bool has_star_ = false;
};

/// Calls visit(layer of the document, layer of the stack) for all; false if they do not fit, as
/// where a layer of the document is several of the stack.
bool for_each_layer(const json& layers, std::vector<Element>& elements,
                    const std::function<void(const json&, Layer&)>& visit) {
    if (layers.size() != elements.size()) return false;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        Layer* const layer = std::get_if<Layer>(&elements[i].value);
        if ((layer == nullptr) != layers[i].contains("layers")) return false;
        if (layer) {
            visit(layers[i], *layer);
        } else if (!for_each_layer(layers[i]["layers"], std::get<Group>(elements[i].value).elements,
                                   visit)) {
            return false;
        }
    }
    return true;
}

/// Finds where values stand in the stack.
class PlaceFinder {
public:
    explicit PlaceFinder(DesignTask& task) : task_(task), stack_(task.problem.stack) {
        fits_ = !task.source.reverse &&
                for_each_layer(document()["layers"], stack_.elements, [](const json&, Layer&) {});
    }

    FreePlace find(const std::string& path) {
        if (!fits_) return Rebuilt{};
        const std::vector<std::string> steps = steps_of(path);
        LayerPlace place;
        std::size_t at = 0;
        while (at + 1 < steps.size() && steps[at] == "layers") {
            place.push_back(index_of(steps[at + 1]).value_or(0));
            at += 2;
        }
        const std::vector<std::string> rest(steps.begin() + static_cast<std::ptrdiff_t>(at),
                                            steps.end());
        Element* const element = place.empty() ? nullptr : element_at(stack_, place);
        if (element && rest.size() == 1) {
            if (rest[0] == "thickness_nm" && is_plain(*element)) return ThicknessOf{place};
            if (rest[0] == "repeat" && std::holds_alternative<Group>(element->value))
                return RepeatOf{place};
        }
        return number_of(path, place, rest);
    }

private:
    const json& document() const { return task_.source.document; }

    static bool is_plain(const Element& element) {
        const Layer* const layer = std::get_if<Layer>(&element.value);
        return layer && layer->coherent;
    }

    FreePlace number_of(const std::string& path, const LayerPlace& place,
                        const std::vector<std::string>& rest) {
        const bool is_named = place.empty() && rest.size() > 2 && rest[0] == "materials";
        const bool is_end =
            place.empty() && rest.size() > 1 && (rest[0] == "incident" || rest[0] == "substrate");
        const bool is_layer = !place.empty() && rest.size() > 1 && rest[0] == "material";
        if (!is_named && !is_end && !is_layer) return Rebuilt{};
        const std::vector<std::string> inside(rest.begin() + (is_named ? 2 : 1), rest.end());
        auto number = part_of(inside);
        if (!number) return Rebuilt{};
        const std::string holder = path.substr(0, path.size() - path_of(inside).size() - 1);
        const auto [known, is_new] = owned_.try_emplace(holder, 0);
        if (is_new) known->second = own(place, rest);
        number->material = known->second;
        try {
            Material copy = stack_.materials[number->material];
            value_of(copy, *number);
        } catch (const DomainError&) {
            return Rebuilt{};
        } catch (const std::out_of_range&) {
            return Rebuilt{};
        }
        return *number;
    }

    /// A number of a material by its path in there.
    static std::optional<MaterialNumber> part_of(const std::vector<std::string>& inside) {
        using Part = MaterialNumber::Part;
        const auto at = [&](std::size_t i) {
            return i < inside.size() ? index_of(inside[i]) : std::nullopt;
        };
        const std::size_t size = inside.size();
        if (size == 1 && inside[0] == "n") return MaterialNumber{0, Part::n, 0};
        if (size == 1 && inside[0] == "k") return MaterialNumber{0, Part::k, 0};
        if (size == 2 && inside[0] == "cauchy" && at(1))
            return MaterialNumber{0, Part::coefficient, *at(1) == 0 ? 0 : 2 * *at(1) - 1};
        if (size == 3 && inside[0] == "sellmeier" && at(1) && at(2))
            return MaterialNumber{0, Part::coefficient, 1 + 2 * *at(1) + *at(2)};
        if (size == 3 && inside[0] == "table" && at(1) && (at(2) == 1U || at(2) == 2U))
            return MaterialNumber{0, at(2) == 1U ? Part::n_row : Part::k_row, *at(1)};
        if (inside[0] != "lorentz_drude" || size < 2) return std::nullopt;
        if (size == 2 && inside[1] == "eps_infinity")
            return MaterialNumber{0, Part::eps_infinity, 0};
        if (size == 2 && inside[1] == "plasma_ev") return MaterialNumber{0, Part::plasma, 0};
        if (size == 4 && inside[1] == "oscillators" && at(2) && at(3)) {
            constexpr std::array kParts{Part::strength, Part::damping, Part::resonance};
            if (*at(3) < kParts.size()) return MaterialNumber{0, kParts[*at(3)], *at(2)};
        }
        return std::nullopt;
    }

    /// Gives a material to those alone that the path means; its place in the stack.
    std::size_t own(const LayerPlace& place, const std::vector<std::string>& rest) {
        const std::size_t fresh = stack_.materials.size();
        const auto take = [&](std::size_t& material) {
            if (stack_.materials.size() == fresh) {
                const Material copy = stack_.materials[material];
                stack_.materials.push_back(copy);
            }
            material = fresh;
        };
        if (!place.empty()) {
            take(std::get<Layer>(element_at(stack_, place)->value).material);
        } else if (rest[0] == "incident") {
            take(stack_.incident);
        } else if (rest[0] == "substrate") {
            take(stack_.substrate);
        } else {
            const json name = rest[1];
            if (document()["incident"] == name) take(stack_.incident);
            for_each_layer(document()["layers"], stack_.elements,
                           [&](const json& layer, Layer& of_stack) {
                               if (layer["material"] == name) take(of_stack.material);
                           });
            if (document()["substrate"] == name) take(stack_.substrate);
        }
        return fresh;
    }

    DesignTask& task_;
    Stack& stack_;
    std::map<std::string, std::size_t> owned_;
    bool fits_ = false;
};

const json& value_at(const json& document, const std::string& path) {
    const json* value = &document;
    for (const std::string& step : steps_of(path))
        value = value->is_array() ? &(*value)[*index_of(step)] : &(*value)[step];
    return *value;
}

/// Bounds of a value that states none: its closed range.
std::array<double, 2> natural_bounds(const std::string& path) {
    if (path.ends_with("thickness_nm") || path.ends_with("sigma_nm")) return {0, kInfinity};
    if (path.ends_with(".n")) return {1e-6, kInfinity};
    if (path.ends_with(".k")) return {0, kInfinity};
    return {-kInfinity, kInfinity};
}

class FreeReader {
public:
    FreeReader(const json& free, DesignTask& task) : free_(free), task_(task) {}

    void read() {
        PathFinder finder(task_.source.document);
        for (std::size_t i = 0; i < free_.size(); ++i) {
            const std::string path = free_[i]["path"].get<std::string>();
            const std::vector<std::string> found = finder.find(path);
            if (found.empty())
                fail(i, "/path", "matches no number in the stack (got \"" + path + "\")");
            for (const std::string& one : found) add(i, one, found.size() > 1);
        }
        PlaceFinder places(task_);
        for (std::size_t v = 0; v < task_.paths.size(); ++v) add_places(v, places);
        if (needs_rebuild_) set_rebuild();
    }

private:
    [[noreturn]] void fail(std::size_t i, const std::string& where,
                           const std::string& words) const {
        throw InputError(task_.file, "/free/" + std::to_string(i) + where, words);
    }

    void add(std::size_t i, const std::string& path, bool is_one_of_many) {
        const json& entry = free_[i];
        if (!taken_.insert(path).second) fail(i, "/path", path + " is already free");
        FreeValue value;
        value.name = entry.value("name", path);
        if (is_one_of_many && entry.contains("name") && !entry.contains("link")) value.name = path;
        value.start = value_at(task_.source.document, path).get<double>();
        value.is_integer = entry.value("integer", false) || path.ends_with("repeat");
        read_bounds(i, path, value);
        const auto& known = std::ranges::find(links_, entry.value("link", ""),
                                              &std::pair<std::string, std::size_t>::first);
        if (!entry.contains("link") || known == links_.end()) {
            if (entry.contains("link"))
                links_.emplace_back(entry["link"].get<std::string>(), task_.paths.size());
            task_.problem.free.push_back(std::move(value));
            task_.paths.push_back({path});
            entries_.push_back(i);
            return;
        }
        FreeValue& first = task_.problem.free[known->second];
        first.low = std::max(first.low, value.low);
        first.high = std::min(first.high, value.high);
        if (first.low > first.high) fail(i, "/bounds", "do not overlap those of the same link");
        if (first.start != value.start)
            task_.notes.push_back(path + " starts from the value of " +
                                  task_.paths[known->second].front() +
                                  ", to which it is linked: " + to_text(first.start));
        task_.paths[known->second].push_back(path);
    }

    void read_bounds(std::size_t i, const std::string& path, FreeValue& value) const {
        const auto natural = natural_bounds(path);
        value.low = natural[0];
        value.high = natural[1];
        if (!free_[i].contains("bounds")) {
            if (value.is_integer) fail(i, "", "a whole number must have bounds");
            return;
        }
        const json& bounds = free_[i]["bounds"];
        const double low = bounds[0].get<double>(), high = bounds[1].get<double>();
        if (!(low <= high))
            fail(i, "/bounds",
                 "the first must not be above the second (got " + to_text(low) + ", " +
                     to_text(high) + ")");
        const double most = path.ends_with("thickness_nm") ? kLargestThickness_nm : 1e300;
        if (low < natural[0] || high > most)
            fail(i, "/bounds",
                 "must be in [" + to_text(natural[0]) + ", " + to_text(most) + "] (got " +
                     to_text(low) + ", " + to_text(high) + ")");
        if (value.is_integer && (low != std::floor(low) || high != std::floor(high) ||
                                 (path.ends_with("repeat") && low < 1)))
            fail(i, "/bounds", "must be whole numbers, of a repeat at least 1");
        value.low = low;
        value.high = high;
        if (value.start < low || value.start > high)
            task_.notes.push_back(path + " starts at a bound: " + to_text(value.start) +
                                  " is outside of [" + to_text(low) + ", " + to_text(high) + "]");
    }

    void add_places(std::size_t v, PlaceFinder& places) {
        for (const std::string& path : task_.paths[v]) {
            FreePlace place = places.find(path);
            if (std::holds_alternative<Rebuilt>(place)) needs_rebuild_ = true;
            task_.problem.free[v].places.push_back(std::move(place));
        }
    }

    void set_rebuild() {
        const auto files = std::make_shared<MaterialFiles>();
        task_.problem.rebuild = [source = task_.source, paths = task_.paths,
                                 files](const std::vector<double>& x) {
            json document = source.document;
            for (std::size_t i = 0; i < x.size(); ++i)
                for (const std::string& path : paths[i]) set_value(document, path, x[i]);
            try {
                return read_source(source, document, *files).stack;
            } catch (const InputError& error) {
                throw DomainError(error.what());  // a value that cannot be
            }
        };
    }

    const json& free_;
    DesignTask& task_;
    std::set<std::string> taken_;
    std::vector<std::pair<std::string, std::size_t>> links_;
    std::vector<std::size_t> entries_;
    bool needs_rebuild_ = false;
};

}  // namespace

void read_free(const json& free, DesignTask& task) {
    FreeReader(free, task).read();
}

}  // namespace irido::schemas
