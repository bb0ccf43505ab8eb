#include "schemas/varied_stack.hpp"

#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/error.hpp"
#include "schemas/input_error.hpp"
#include "schemas/json_document.hpp"

namespace irido {

namespace {

constexpr std::string_view kThickness = "thickness_nm";
constexpr double kLargestThickness_nm = 1e9;

std::vector<std::string_view> steps_of(std::string_view path) {
    std::vector<std::string_view> steps;
    for (std::size_t dot = path.find('.'); dot != std::string_view::npos; dot = path.find('.')) {
        steps.push_back(path.substr(0, dot));
        path.remove_prefix(dot + 1);
    }
    steps.push_back(path);
    return steps;
}

/// The indices in layers.I.layers.J.thickness_nm, or none for a path of another shape.
std::vector<std::size_t> thickness_place(std::string_view path) {
    const std::vector<std::string_view> steps = steps_of(path);
    if (steps.size() % 2 == 0 || steps.back() != kThickness) return {};
    std::vector<std::size_t> place;
    for (std::size_t i = 0; i + 1 < steps.size(); i += 2) {
        const std::string_view digits = steps[i + 1];
        const char* const end = digits.data() + digits.size();
        std::size_t index = 0;
        const auto [stop, error] = std::from_chars(digits.data(), end, index);
        if (steps[i] != "layers" || error != std::errc() || stop != end) return {};
        place.push_back(index);
    }
    return place;
}

/// The layer there; nullptr if it is none.
Layer* layer_at(std::vector<Element>& elements, std::span<const std::size_t> place) {
    if (place.empty() || place[0] >= elements.size()) return nullptr;
    auto& value = elements[place[0]].value;
    if (place.size() == 1) return std::get_if<Layer>(&value);
    auto* const group = std::get_if<Group>(&value);
    return group ? layer_at(group->elements, place.subspan(1)) : nullptr;
}

}  // namespace

VariedStack::VariedStack(StackSource source, std::vector<std::string> paths)
    : source_(std::move(source)), paths_(std::move(paths)) {
    stack_ = read_stack(source_.document, source_.file, source_.folder).stack;
    for (const std::string& path : paths_) {
        const std::vector<std::size_t> place = thickness_place(path);
        if (layer_at(stack_.elements, place)) places_.push_back(place);
    }
}

Stack VariedStack::at(std::span<const double> values) const {
    if (!varies_thickness_only()) {
        nlohmann::json document = source_.document;
        for (std::size_t i = 0; i < paths_.size(); ++i) set_value(document, paths_[i], values[i]);
        return read_stack(document, source_.file, source_.folder).stack;
    }
    Stack stack = stack_;
    for (std::size_t i = 0; i < paths_.size(); ++i) {
        if (!(values[i] >= 0 && values[i] <= kLargestThickness_nm))
            throw InputError(source_.file, paths_[i],
                             "must be in [0, 1e9] (got " + to_text(values[i]) + ")");
        layer_at(stack.elements, places_[i])->thickness_nm = values[i];
    }
    return stack;
}

}  // namespace irido
