#pragma once

#include <string>
#include <vector>

#include "cli/queries/query.hpp"

namespace irido::cli {

/// Options of irido cm, as given on the command line.
struct CmOptions : QueryOptions {
    std::string angles = "0";
    std::string polarization = "s,p";
    std::string orders = "0:5:1";
    std::string sides = "R";
    std::string at = "550";

    static std::unique_ptr<QueryOptions> add(CLI::App& command);
    std::unique_ptr<const Query> parse(const QueryRun& run) const override;
    nlohmann::json typed() const override;
};

/// The Fourier series of one film's fringes.
class CmQuery : public Query {
public:
    explicit CmQuery(const CmOptions& typed);

    std::span<const double> angles_deg() const override { return angles_deg_; }
    std::size_t rows_per_angle() const override {
        return polarizations_.size() * sides_.size() * orders_.size();
    }
    tables::RecordLayout layout(const schemas::StackDocument& document) const override;
    tables::RowPlot plot(const tables::Records& rows, tables::GamutMapping gamut) const override;
    std::unique_ptr<const PreparedStack> prepare(schemas::StackDocument document) const override;
    std::unique_ptr<QueryResult> new_result() const override;
    double cost_us(const PreparedStack& prepared, const Stack& stack, double angle_deg,
                   std::optional<double> wavelength_nm) const override;

private:
    friend class CmResult;

    std::vector<double> angles_deg_;
    std::vector<char> polarizations_;  ///< s or p
    std::vector<char> sides_;          ///< R or T
    std::vector<double> orders_;
    double at_nm_ = 0;
};

}  // namespace irido::cli
