#include "cli/sweep/stacks.hpp"

#include <algorithm>

#include "core/stack/reversed.hpp"
#include "schemas/documents/document_kind.hpp"
#include "schemas/documents/json_document.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/number.hpp"

namespace irido::cli {

namespace {

/// Structures cached per thread.
constexpr std::size_t kMostPlaces = 16;
/// Values per column that are checked before the sweep starts.
constexpr std::size_t kMostChecked = 1000;

std::vector<std::size_t> columns_where(const SweepSpace& space, const nlohmann::json& document,
                                       bool thickness) {
    const schemas::VariedStack::OtherEffects effects(document);
    std::vector<std::size_t> columns;
    for (std::size_t c = 0; c < space.columns().size(); ++c) {
        const SweptColumn& column = space.columns()[c];
        if (!column.is_of_stack()) continue;
        const bool is_thickness =
            schemas::VariedStack::is_thickness(column.path) && !effects.are_of(column.path);
        if (is_thickness == thickness) columns.push_back(c);
    }
    return columns;
}

std::vector<std::string> paths_of(const SweepSpace& space,
                                  const std::vector<std::size_t>& columns) {
    std::vector<std::string> paths;
    for (const std::size_t c : columns) paths.push_back(space.columns()[c].path);
    return paths;
}

/// Runs `work`; prefixes its errors with the origin of the value.
template <class Work>
void from_origin(const SweepSpace& space, std::size_t column, std::size_t index, const Work& work) {
    try {
        work();
    } catch (const schemas::InputError& error) {
        throw schemas::InputError("", "", space.origin_of(column, index) + error.what());
    }
}

/// The source with each varied thickness in the middle of its range, as used to prepare structures.
schemas::StackSource with_thicknesses(schemas::StackSource source, const SweepSpace& space,
                                      const std::vector<std::size_t>& thicknesses) {
    if (const std::string other =
            schemas::other_kind(source.document, schemas::DocumentKind::stack);
        !other.empty())
        throw schemas::InputError(source.file, "", other);
    for (const std::size_t c : thicknesses) {
        const SweptColumn& column = space.columns()[c];
        if (column.is_text()) {
            const auto wrong = std::ranges::find_if(
                column.texts, [](const std::string& text) { return !schemas::parse_number(text); });
            const auto index = static_cast<std::size_t>(wrong - column.texts.begin());
            throw schemas::InputError(
                "", "",
                space.origin_of(c, index) + (column.of_points ? column.path + ": " : "") +
                    "must be numbers (got " + schemas::in_quotes(*wrong) + ")");
        }
        for (std::size_t i = 0; i < column.numbers.size(); ++i)
            from_origin(space, c, i, [&] {
                schemas::VariedStack::require_thickness(source.file, column.path,
                                                        column.numbers[i]);
            });
        schemas::set_value(source.document, column.path, column.middle());
    }
    return source;
}

}  // namespace

SweptStacks::SweptStacks(schemas::StackSource source, const SweepSpace& space, const Query& query)
    : space_(space),
      query_(query),
      structural_(columns_where(space, source.document, false)),
      thicknesses_(columns_where(space, source.document, true)),
      is_reversed_(source.reverse),
      varied_(with_thicknesses(source, space, thicknesses_), paths_of(space, structural_)),
      file_(source.file) {
    read_values();
}

void SweptStacks::read_values() {
    const std::vector<std::size_t> first = key_of(0);
    bool first_is_read = true;
    try {
        first_ = document(first);
    } catch (const schemas::InputError&) {
        first_is_read = false;  // some column's value is to blame
    }
    for (std::size_t s = 0; s < structural_.size(); ++s) {
        std::vector<std::size_t> key = first;
        const std::size_t column = structural_[s];
        const std::size_t values = space_.columns()[column].scattered
                                       ? 1
                                       : std::min(space_.columns()[column].size(), kMostChecked);
        for (key[s] = 0; key[s] < values; ++key[s])
            if (!first_is_read || key[s] != first[s])
                from_origin(space_, column, key[s], [&] { document(key); });
    }
    if (!first_is_read) first_ = document(first);
}

std::vector<std::size_t> SweptStacks::key_of(std::uint64_t combination) const {
    std::vector<std::size_t> key;
    key.reserve(structural_.size());
    for (const std::size_t c : structural_) key.push_back(space_.at(c, combination));
    return key;
}

schemas::StackDocument SweptStacks::document(const std::vector<std::size_t>& key) const {
    std::vector<nlohmann::json> values;
    values.reserve(key.size());
    for (std::size_t s = 0; s < key.size(); ++s)
        values.push_back(space_.columns()[structural_[s]].value(key[s]));
    return varied_.document(values);
}

std::shared_ptr<SweptStacks::Structure> SweptStacks::entry(const std::vector<std::size_t>& key) {
    const std::scoped_lock guard(lock_);
    std::shared_ptr<Structure>& found = structures_[key];
    if (!found) found = std::make_shared<Structure>();
    found->last_used = ++uses_;
    const std::shared_ptr<Structure> result = found;
    if (structures_.size() > kMostStructures)
        structures_.erase(std::ranges::min_element(
            structures_, {}, [](const auto& entry) { return entry.second->last_used; }));
    return result;
}

std::shared_ptr<const PreparedStack> SweptStacks::prepared(const std::vector<std::size_t>& key) {
    const std::shared_ptr<Structure> structure = entry(key);
    const std::scoped_lock guard(structure->making);
    if (!structure->prepared) {
        structure->prepared = query_.prepare(document(key));
        ++prepared_count_;
    }
    return structure->prepared;
}

SweptStacks::Walk::Place& SweptStacks::Walk::structure_at(std::uint64_t combination) {
    key_.clear();
    for (const std::size_t c : stacks_.structural_)
        key_.push_back(stacks_.space_.at(c, combination));
    if (const auto found = places_.find(key_); found != places_.end()) return found->second;
    if (places_.size() >= kMostPlaces) places_.clear();
    auto prepared = stacks_.prepared(key_);
    Place& place = places_[key_];
    place.stack = prepared->document.stack;
    place.prepared = std::move(prepared);
    if (stacks_.is_reversed_) place.written.elements = reversed(place.stack.elements);
    for (const std::size_t c : stacks_.thicknesses_) {
        const std::string& path = stacks_.space_.columns()[c].path;
        Stack& written = stacks_.is_reversed_ ? place.written : place.stack;
        place.varied.push_back(schemas::VariedStack::layer_at(written, path));
        if (place.varied.back()) continue;
        places_.erase(key_);
        throw schemas::InputError(stacks_.file_, path, "names no layer");
    }
    return place;
}

const SweptStacks::Walk::Place& SweptStacks::Walk::at(std::uint64_t combination) {
    Place& place = structure_at(combination);
    for (std::size_t i = 0; i < stacks_.thicknesses_.size(); ++i) {
        const std::size_t c = stacks_.thicknesses_[i];
        place.varied[i]->thickness_nm =
            stacks_.space_.columns()[c].number(stacks_.space_.at(c, combination));
    }
    if (stacks_.is_reversed_) place.stack.elements = reversed(place.written.elements);
    return place;
}

}  // namespace irido::cli
