#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/options/comparison_options.hpp"
#include "cli/queries/query.hpp"
#include "core/comparison/stack_comparison.hpp"

namespace irido::cli {

/// Options of irido compare for a stack, as given on the command line.
struct ComparisonQueryOptions : QueryOptions {
    std::string angles;  ///< "" for the default
    ComparisonOptions comparison;

    std::unique_ptr<const Query> parse(const QueryRun& run) const override;
    nlohmann::json typed() const override;
};

/// Rows of engines' colours next to exact ones: linear sRGB, hex, CIEDE2000.
class EngineRows {
public:
    /// `white` of the illuminant of the exact colours.
    explicit EngineRows(const Triple& white);

    void add(const std::string& engine, double angle_deg, const EngineColor& color);
    std::size_t size() const { return engine_.size(); }
    /// Returns the columns and starts again with empty ones.
    std::vector<tables::Column> take();
    /// `longest` is the length of the longest name of an engine.
    static tables::RecordLayout layout(std::size_t longest);

private:
    RgbTransform exact_rgb_;
    tables::Column::Texts engine_, hex_, exact_hex_;
    tables::Column::Numbers angle_, delta_e_;
    std::array<tables::Column::Numbers, 3> rgb_, exact_;
};

/// Throws ToleranceError unless an exact colour of `name` is accurate enough for comparison.
void require_exact(const std::string& name, double error);

/// Compares engines with the exact colours of a stack.
class ComparisonQuery : public Query {
public:
    ComparisonQuery(const ComparisonQueryOptions& typed, const QueryRun& run);

    std::span<const double> angles_deg() const override { return angles_deg_; }
    bool splits_angles() const override { return false; }  // rows are ordered by engine first
    std::size_t rows_per_angle() const override { return engines_.size(); }
    tables::RecordLayout layout(const schemas::StackDocument& document) const override;
    tables::RowPlot plot(const tables::Records& rows, tables::GamutMapping gamut) const override;
    std::unique_ptr<const PreparedStack> prepare(schemas::StackDocument document) const override;
    std::unique_ptr<QueryResult> new_result() const override;
    double cost_us(const PreparedStack& prepared, const Stack& stack, double angle_deg,
                   std::optional<double> wavelength_nm) const override;

    std::span<const ComparedEngine> engines() const { return engines_; }
    const ColorTables& tables() const { return tables_; }
    const EngineDifference& difference() const { return difference_; }

    /// The comparison of a prepared document.
    static const StackComparison& comparison_of(const PreparedStack& prepared);

private:
    friend class ComparisonResult;

    std::vector<double> angles_deg_;
    std::vector<ComparedEngine> engines_;
    ColorTables tables_;
    EngineDifference difference_;
    ColorRequest request_;
    bool strict_;
    std::function<void(const std::string&)> note_;
};

}  // namespace irido::cli
