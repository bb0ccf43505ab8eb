#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "core/color/quadrature/panel_tree.hpp"

namespace irido {

/// Panels with which spectra of fringes of any path begin, made on first use. Thread-safe.
class PanelStarts {
public:
    /// Refers to `tables` and, if given, to `indices`.
    ///   ends         of what is smooth
    ///   make_points  see PanelTree
    ///   indices      tables that fits replace; nullptr if none are
    PanelStarts(const ColorTables& tables, std::vector<double> ends, PointsMaker make_points,
                const SmoothIndices* indices = nullptr)
        : ends_(std::move(ends)), tree_(tables, std::move(make_points), indices) {}

    /// What a start depends on.
    struct Key {
        std::size_t path;  ///< path_class()
        bool follows;      ///< see Transmission
        double tolerance;  ///< of X, Y, Z
        std::size_t most_panels;
        bool operator==(const Key&) const = default;
    };
    const PanelTree::Start& at(const Key& key) const;

    /// Panels and degrees for which points were made.
    std::size_t size() const { return tree_.points_made(); }

private:
    struct Hash {
        std::size_t operator()(const Key& key) const {
            return key.path * 2 + (key.follows ? 1 : 0) + std::hash<double>()(key.tolerance);
        }
    };
    std::vector<double> ends_;
    mutable PanelTree tree_;
    mutable std::mutex lock_;
    mutable std::unordered_map<Key, std::unique_ptr<const PanelTree::Start>, Hash> starts_;
};

/// Tolerance for which the first wavelengths are chosen: the work around a few wavelengths takes as
/// long as some more of them, and panels that are good enough at once are cheaper than halves.
double first_tolerance(double tolerance);

}  // namespace irido
