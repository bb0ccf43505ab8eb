#include "schemas/documents/varied_stack.hpp"

#include <algorithm>
#include <charconv>
#include <mutex>
#include <optional>

#include "core/error.hpp"
#include "core/stack/reversed.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/documents/rough_faces.hpp"
#include "schemas/input_error.hpp"

namespace irido::schemas {

namespace {

constexpr std::string_view kThickness = "thickness_nm";

/// Removes "layers.I." from a path and returns I; empty for any other path.
std::optional<std::size_t> take_layer(std::string_view& path) {
    constexpr std::string_view kLayers = "layers.";
    if (!path.starts_with(kLayers)) return std::nullopt;
    const std::string_view rest = path.substr(kLayers.size());
    const char* const end = rest.data() + rest.size();
    std::size_t index = 0;
    const auto [stop, error] = std::from_chars(rest.data(), end, index);
    if (error != std::errc() || stop == end || *stop != '.') return std::nullopt;
    path.remove_prefix(static_cast<std::size_t>(stop + 1 - path.data()));
    return index;
}

/// Refuses paths inside each other: setting one would overwrite the other.
void require_apart(const std::vector<std::string>& paths) {
    const std::optional<PathOverlap> overlap = overlap_of(paths);
    if (!overlap) return;
    if (overlap->is_same) throw InputError(paths[overlap->inner], "", "is varied twice");
    throw InputError(paths[overlap->inner], "",
                     "is inside \"" + paths[overlap->outer] + "\", which also varies");
}

}  // namespace

/// State shared between readings: copying a document takes about as long as checking it.
struct VariedStack::Shared {
    MaterialFiles files;
    std::mutex lock;
    std::vector<nlohmann::json> documents;  ///< with some values of the varied paths, not in use

    nlohmann::json take(const nlohmann::json& otherwise) {
        const std::scoped_lock guard(lock);
        if (documents.empty()) return otherwise;
        nlohmann::json document = std::move(documents.back());
        documents.pop_back();
        return document;
    }
    void give_back(nlohmann::json document) {
        const std::scoped_lock guard(lock);
        documents.push_back(std::move(document));
    }
};

VariedStack::VariedStack(StackSource source, std::vector<std::string> paths)
    : source_(std::move(source)),
      paths_(std::move(paths)),
      shared_(std::make_shared<Shared>()),
      own_(read_source(source_, source_.document, shared_->files)) {
    require_apart(paths_);
    nlohmann::json document = source_.document;
    for (const std::string& path : paths_) set_value(document, path, nullptr);
    Stack written = as_written(own_.stack);
    const OtherEffects effects(source_.document);
    varies_thickness_only_ = std::ranges::all_of(paths_, [&](const std::string& path) {
        return layer_at(written, path) != nullptr && !effects.are_of(path);
    });
}

StackDocument VariedStack::document(std::span<const nlohmann::json> values) const {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < paths_.size(); ++i) {
        if (!values[i].is_number()) continue;
        numbers.push_back(values[i].get<double>());
        if (is_thickness(paths_[i])) require_thickness(source_.file, paths_[i], numbers.back());
    }
    if (!varies_thickness_only_ || numbers.size() < values.size()) return read(values);
    StackDocument document = own_;
    set_thicknesses(document.stack, numbers);
    return document;
}

Stack VariedStack::at(std::span<const double> values) const {
    if (!varies_thickness_only_) return read(values).stack;
    Stack stack = own_.stack;
    set_thicknesses(stack, values);
    return stack;
}

template <class Value>
StackDocument VariedStack::read(std::span<const Value> values) const {
    nlohmann::json document = shared_->take(source_.document);
    for (std::size_t i = 0; i < paths_.size(); ++i) set_value(document, paths_[i], values[i]);
    StackDocument result = read_source(source_, document, shared_->files);
    shared_->give_back(std::move(document));  // the next values overwrite these
    return result;
}

void VariedStack::set_thicknesses(Stack& stack, std::span<const double> values) const {
    stack = as_written(std::move(stack));
    for (std::size_t i = 0; i < paths_.size(); ++i) {
        require_thickness(source_.file, paths_[i], values[i]);
        layer_at(stack, paths_[i])->thickness_nm = values[i];
    }
    stack = as_written(std::move(stack));
}

Stack VariedStack::as_written(Stack stack) const {
    return source_.reverse ? reversed(std::move(stack)) : stack;
}

LayerPlace VariedStack::place_of(std::string_view path) {
    LayerPlace place;
    while (const auto index = take_layer(path)) place.push_back(*index);
    return path == kThickness ? place : LayerPlace{};
}

bool VariedStack::is_thickness(std::string_view path) {
    return !place_of(path).empty();
}

VariedStack::OtherEffects::OtherEffects(const nlohmann::json& document)
    : document_(document), has_rough_faces_(has_rough_faces(document)) {}

bool VariedStack::OtherEffects::are_of(std::string_view path) const {
    if (has_rough_faces_) return true;
    const std::string layer(path.substr(0, path.rfind('.') + 1));
    return has_value(document_, layer + "graded") || has_value(document_, layer + "qwot");
}

Layer* VariedStack::layer_at(Stack& stack, std::string_view path) {
    std::vector<Element>* elements = &stack.elements;
    Layer* layer = nullptr;
    while (const auto index = take_layer(path)) {
        if (elements == nullptr || *index >= elements->size()) return nullptr;
        auto& value = (*elements)[*index].value;
        layer = std::get_if<Layer>(&value);
        auto* const group = std::get_if<Group>(&value);
        elements = group == nullptr ? nullptr : &group->elements;
    }
    return path == kThickness ? layer : nullptr;
}

void VariedStack::require_thickness(const std::string& file, const std::string& path,
                                    double thickness_nm) {
    if (!(thickness_nm >= 0 && thickness_nm <= kLargestThickness_nm))
        throw InputError(file, path, "must be in [0, 1e9] (got " + to_text(thickness_nm) + ")");
}

}  // namespace irido::schemas
