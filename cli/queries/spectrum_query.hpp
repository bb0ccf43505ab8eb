#pragma once

#include <string>
#include <vector>

#include "cli/options/cone_options.hpp"
#include "cli/options/wavelength_unit.hpp"
#include "cli/queries/query.hpp"
#include "cli/queries/spectrum_average.hpp"
#include "cli/queries/spectrum_columns.hpp"

namespace irido::cli {

/// Options of irido spectrum, as given on the command line.
struct SpectrumOptions : QueryOptions {
    std::string wavelengths;  ///< "" for kUsualWavelengths_nm
    std::string angles = "0";
    std::string polarization = "u";
    std::string columns;
    std::string unit = "nm";
    std::string average;  ///< "" if not given
    ConeOptions cone;

    static std::unique_ptr<QueryOptions> add(CLI::App& command);
    std::unique_ptr<const Query> parse(const QueryRun& run) const override;
    nlohmann::json typed() const override;
};

/// R, T, A and optional columns over wavelengths and angles, or averages over wavelength.
class SpectrumQuery : public Query {
public:
    SpectrumQuery(const SpectrumOptions& typed, const QueryRun& run);

    std::span<const double> angles_deg() const override { return angles_deg_; }
    bool takes_wavelength() const override { return !average_; }
    std::size_t rows_per_angle() const override {
        const bool is_one = varies_wavelength_ || average_;
        return polarizations_.size() * (is_one ? 1 : wavelengths_nm_.size());
    }
    tables::RecordLayout layout(const schemas::StackDocument& document) const override;
    tables::RowPlot plot(const tables::Records& rows, tables::GamutMapping gamut) const override;
    std::unique_ptr<const PreparedStack> prepare(schemas::StackDocument document) const override;
    nlohmann::json data() const override;
    std::unique_ptr<QueryResult> new_result() const override;
    double cost_us(const PreparedStack& prepared, const Stack& stack, double angle_deg,
                   std::optional<double> wavelength_nm) const override;
    double try_share(const schemas::StackDocument& document, const Incidence& incidence,
                     double share) const override;

    /// Number of rows over all wavelengths, angles and polarizations.
    std::uint64_t rows() const;
    /// Passes all rows of a stack to `take`, in order, in blocks and in constant memory; the values
    /// equal those of new_result(). Throws InputError or UsageError.
    void each_block(const schemas::StackDocument& document,
                    const std::function<void(const tables::Records&)>& take) const;

    /// Lines about how a stack was computed and what work its physics saved.
    std::vector<std::string> stats(const PreparedStack& prepared) const;

private:
    friend class SpectrumResult;
    friend class AverageResult;

    /// Reports the notes of a stack that is about to be evaluated.
    void note_stack(const schemas::StackDocument& document, const IndexTable& table) const;

    void each_part_of_angle(const schemas::StackDocument& document, std::size_t most,
                            const std::function<void(const tables::Records&)>& take) const;

    bool varies_wavelength_;
    TypedWavelengths typed_;
    std::vector<double> wavelengths_nm_;  ///< empty if they vary; both ends for an average
    std::vector<double> angles_deg_;
    std::string polarizations_;  ///< letters of "spu"
    std::vector<SpectrumColumn> columns_;
    std::optional<AverageWeight> average_;
    ConeSize cone_;
    Execution execution_;
    std::function<void(const std::string&)> note_;
};

}  // namespace irido::cli
