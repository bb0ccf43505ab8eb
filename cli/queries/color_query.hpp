#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/options/color_options.hpp"
#include "cli/options/cone_options.hpp"
#include "cli/queries/color_columns.hpp"
#include "cli/queries/query.hpp"
#include "core/color/color_tables.hpp"
#include "core/color/stack_color.hpp"

namespace irido::cli {

/// Options of irido color, as given on the command line.
struct ColorQueryOptions : QueryOptions {
    std::string angles = "0";
    ColorOptions color;
    ConeOptions cone;
    std::string columns;
    std::string target;
    bool compare = false;
    bool stats = false;

    static std::unique_ptr<QueryOptions> add(CLI::App& command);
    std::unique_ptr<const Query> parse(const QueryRun& run) const override;
    nlohmann::json typed() const override;
};

/// The transform from XYZ. Throws UsageError, which names --illuminant.
RgbTransform rgb_transform(const RgbSpace& space, const Triple& white, Adaptation adaptation);

/// An illuminant and everything shared by the colours under it.
struct Illumination {
    Illumination(std::string name, Sensitivity sensitivity, const RgbSpace& space,
                 Adaptation adaptation);

    const Triple& white() const { return tables.sensitivity().white(); }

    std::string name;
    ColorTables tables;
    RgbTransform transform;
};

/// Colours of one stack, per illumination as [angle][side].
struct StackColors {
    std::vector<double> angles_deg;
    std::vector<std::vector<StackColor>> colors;
};

/// X, Y, Z and RGB of the light that a stack reflects or transmits.
class ColorQuery : public Query {
public:
    ColorQuery(const ColorQueryOptions& typed, const QueryRun& run);

    std::span<const double> angles_deg() const override { return angles_deg_; }
    bool splits_angles() const override { return illuminations_.size() == 1; }
    std::size_t rows_per_angle() const override { return illuminations_.size() * sides().size(); }
    tables::RecordLayout layout(const schemas::StackDocument& document) const override;
    tables::RowPlot plot(const tables::Records& rows, tables::GamutMapping gamut) const override;
    nlohmann::json data() const override;
    std::unique_ptr<const PreparedStack> prepare(schemas::StackDocument document) const override;
    std::unique_ptr<QueryResult> new_result() const override;
    double cost_us(const PreparedStack& prepared, const Stack& stack, double angle_deg,
                   std::optional<double> wavelength_nm) const override;
    double try_share(const schemas::StackDocument& document, const Incidence& incidence,
                     double share) const override;

    std::span<const Side> sides() const { return request_.sides; }
    /// The requested illumination, followed by those to compare with it.
    std::span<const std::unique_ptr<Illumination>> illuminations() const { return illuminations_; }
    /// Throws InputError, or ToleranceError if a colour misses the tolerance.
    StackColors colors(const PreparedStack& prepared, const Stack& stack,
                       std::span<const double> angles_deg) const;
    tables::Records records(const std::vector<StackColors>& stacks) const;

private:
    void prepare_columns(const ColorQueryOptions& typed);
    void check_columns(const schemas::StackDocument& document, const StackColors& colors) const;
    void check_errors(const schemas::StackDocument& document, const StackColors& colors,
                      bool approximate) const;

    std::vector<double> angles_deg_;
    Table illuminant_;  ///< the requested one
    std::vector<std::unique_ptr<Illumination>> illuminations_;
    ColorMethod method_;
    ColorRequest request_;
    ConeSize cone_;
    bool held_to_tolerance_;  ///< a tolerance was given
    double tolerance_;        ///< for X, Y, Z; that of request_ may be smaller to suit the columns
    const RgbSpace* space_;
    std::vector<ColorColumn> columns_;
    std::vector<ColorView> views_;  ///< one per illumination
    bool stats_, strict_;
    QueryRun run_;
};

}  // namespace irido::cli
