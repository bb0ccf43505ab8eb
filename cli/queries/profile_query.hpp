#pragma once

#include <string>
#include <vector>

#include "cli/options/wavelength_unit.hpp"
#include "cli/queries/query.hpp"

namespace irido::cli {

/// Options of irido profile, as given on the command line.
struct ProfileOptions : QueryOptions {
    std::string wavelengths;  ///< "" for 550 nm
    std::string angles = "0";
    std::string polarization = "u";
    std::string unit = "nm";
    std::string points;  ///< "" if not given
    std::string z;       ///< "" if not given
    bool summary = false;
    bool faces = false;  ///< of pictures: depths on both sides of every face as well

    static std::unique_ptr<QueryOptions> add(CLI::App& command);
    std::unique_ptr<const Query> parse(const QueryRun& run) const override;
    nlohmann::json typed() const override;
};

/// The fields in a stack as functions of depth, or a summary of each layer.
class ProfileQuery : public Query {
public:
    ProfileQuery(const ProfileOptions& typed, const QueryRun& run);

    std::span<const double> angles_deg() const override { return angles_deg_; }
    std::size_t rows_per_angle() const override;
    tables::RecordLayout layout(const schemas::StackDocument& document) const override;
    tables::RowPlot plot(const tables::Records& rows, tables::GamutMapping gamut) const override;
    std::unique_ptr<const PreparedStack> prepare(schemas::StackDocument document) const override;
    std::unique_ptr<QueryResult> new_result() const override;
    double cost_us(const PreparedStack& prepared, const Stack& stack, double angle_deg,
                   std::optional<double> wavelength_nm) const override;

    bool is_summary() const { return summary_; }
    /// The depths of the rows, nm, for a stack with these faces, the first at 0.
    std::vector<double> depths_nm(const std::vector<double>& faces_nm) const;

private:
    friend class ProfileResult;

    std::vector<double> angles_deg_;
    std::string polarizations_;  ///< letters of "spu"
    TypedWavelengths wavelengths_;
    std::vector<double> z_nm_;  ///< if empty, `points_` depths are chosen
    std::size_t points_ = 0;
    bool summary_, faces_;
    std::function<void(const std::string&)> note_;
};

}  // namespace irido::cli
