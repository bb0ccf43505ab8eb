#pragma once

#include <string>
#include <vector>

#include "cli/queries/query.hpp"
#include "core/periodic/bragg_mirror.hpp"

namespace irido::cli {

/// Options of irido bands, as given on the command line.
struct BandsOptions : QueryOptions {
    std::string angles = "0";
    std::string polarization = "s,p";
    std::string range = "360:830";
    bool gaps = false;

    static std::unique_ptr<QueryOptions> add(CLI::App& command);
    std::unique_ptr<const Query> parse(const QueryRun& run) const override;
    nlohmann::json typed() const override;
};

/// Landmarks or gaps of a Bragg mirror.
class BandsQuery : public Query {
public:
    BandsQuery(const BandsOptions& typed, const QueryRun& run);

    std::span<const double> angles_deg() const override { return angles_deg_; }
    bool splits_angles() const override {
        return !gaps_;
    }  // omnidirectional gaps depend on all angles
    std::size_t rows_per_angle() const override { return 0; }
    tables::RecordLayout layout(const schemas::StackDocument& document) const override;
    tables::RowPlot plot(const tables::Records& rows, tables::GamutMapping gamut) const override;
    std::unique_ptr<const PreparedStack> prepare(schemas::StackDocument document) const override;
    std::unique_ptr<QueryResult> new_result() const override;
    double cost_us(const PreparedStack& prepared, const Stack& stack, double angle_deg,
                   std::optional<double> wavelength_nm) const override;

    double first_nm() const { return first_nm_; }
    double last_nm() const { return last_nm_; }
    /// The range, slightly widened to allow for rounding errors of 2 pi / wavelength.
    OmegaRange omega() const;
    /// The stack as a Bragg mirror. Throws InputError.
    BraggMirror mirror(const schemas::StackDocument& document, const Stack& stack) const;

private:
    friend class LandmarkResult;
    friend class GapResult;

    std::vector<double> angles_deg_;
    std::vector<Polarization> polarizations_;
    double first_nm_ = 0, last_nm_ = 0;
    bool gaps_ = false;
    QueryRun run_;
};

}  // namespace irido::cli
