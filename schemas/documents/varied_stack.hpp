#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "schemas/documents/stack_document.hpp"

namespace irido::schemas {

/// A stack with varied values, each named by its dotted path in the document
/// ("layers.0.thickness_nm").
class VariedStack {
public:
    /// Throws InputError if a path does not exist (a missing last key is added, as by set_value),
    /// is repeated, or lies inside another.
    VariedStack(StackSource source, std::vector<std::string> paths);

    /// The document with these values, one for each path, read and checked. Throws InputError.
    /// Thread-safe.
    StackDocument document(std::span<const nlohmann::json> values) const;

    /// The stack for values that are all numbers.
    Stack at(std::span<const double> values) const;

    /// True if all paths are thicknesses, so that materials and structure never change.
    bool varies_thickness_only() const { return varies_thickness_only_; }

    /// Converts one of its stacks to document order, in which layer_at() finds its layers, and
    /// back: reversed() if the source says so.
    Stack as_written(Stack stack) const;

    /// Whether a path has the shape layers.I.thickness_nm or layers.I.layers.J.thickness_nm, to
    /// any depth.
    static bool is_thickness(std::string_view path);

    /// Whether setting a thickness affects more than one layer's thickness in the stack: if the
    /// layer is graded or in quarter waves, or if any face is rough.
    class OtherEffects {
    public:
        /// The document must outlive this object.
        explicit OtherEffects(const nlohmann::json& document);
        bool are_of(std::string_view path) const;

    private:
        const nlohmann::json& document_;
        bool has_rough_faces_;
    };

    /// The indices I, J, ... of such a path; empty for any other path.
    static LayerPlace place_of(std::string_view path);

    /// The layer whose thickness a path names; nullptr if the stack has no such layer.
    static Layer* layer_at(Stack& stack, std::string_view path);

    /// Throws InputError(file, path, "must be in [0, 1e9] (got X)").
    static void require_thickness(const std::string& file, const std::string& path,
                                  double thickness_nm);

private:
    struct Shared;

    template <class Value>
    StackDocument read(std::span<const Value> values) const;
    void set_thicknesses(Stack& stack, std::span<const double> values) const;

    StackSource source_;
    std::vector<std::string> paths_;
    std::shared_ptr<Shared> shared_;
    StackDocument own_;  ///< with the source's own values
    bool varies_thickness_only_ = false;
};

}  // namespace irido::schemas
