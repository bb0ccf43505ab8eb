#include "cli/spectrum_columns.hpp"

#include <algorithm>
#include <array>

#include "cli/list.hpp"
#include "core/error.hpp"
#include "core/interference/ellipsometry.hpp"
#include "schemas/nearest.hpp"

namespace irido {

namespace {

/// As typed, in the order of SpectrumColumn.
constexpr std::array<std::string_view, 7> kNames{"r_re",    "r_im",      "t_re",    "t_im",
                                                 "psi_deg", "delta_deg", "A_layers"};

std::string name_of(SpectrumColumn column) {
    return std::string(kNames[static_cast<std::size_t>(column)]);
}

SpectrumColumn column_of(std::string_view name) {
    const auto found = std::ranges::find(kNames, name);
    if (found != kNames.end()) return static_cast<SpectrumColumn>(found - kNames.begin());
    throw UsageError("--columns: " + not_one_of(kNames, name) +
                     did_you_mean(name, {kNames.begin(), kNames.end()}));
}

bool is_ellipsometric(SpectrumColumn column) {
    return column == SpectrumColumn::psi_deg || column == SpectrumColumn::delta_deg;
}

/// Values of the rows of a table, filled in their order.
class Rows {
public:
    Rows(std::size_t angles, const std::string& polarizations, std::size_t wavelengths)
        : angles_(angles), polarizations_(polarizations), wavelengths_(wavelengths) {}

    std::size_t size() const { return angles_ * polarizations_.size() * wavelengths_; }

    /// value(polarization, point), points being [angle][wavelength].
    template <class Value>
    Column::Numbers numbers(const Value& value) const {
        Column::Numbers result(size());
        std::size_t row = 0;
        for (std::size_t a = 0; a < angles_; ++a)
            for (const char polarization : polarizations_)
                for (std::size_t w = 0; w < wavelengths_; ++w)
                    result[row++] = value(polarization, a * wavelengths_ + w);
        return result;
    }

    /// code(angle, polarization's number, wavelength)
    template <class Code>
    std::vector<std::uint32_t> codes(const Code& code) const {
        std::vector<std::uint32_t> result(size());
        std::size_t row = 0;
        for (std::size_t a = 0; a < angles_; ++a)
            for (std::size_t p = 0; p < polarizations_.size(); ++p)
                for (std::size_t w = 0; w < wavelengths_; ++w)
                    result[row++] = static_cast<std::uint32_t>(code(a, p, w));
        return result;
    }

    /// A quantity of both polarizations, `offset` values further than the first point.
    Column::Numbers power(const Spectra& spectra, std::vector<double> Spectrum::*quantity,
                          std::size_t offset = 0) const {
        const double* s = (spectra.s.*quantity).data() + offset;
        const double* p = (spectra.p.*quantity).data() + offset;
        return numbers([&](char polarization, std::size_t point) {
            if (polarization == 's') return s[point];
            if (polarization == 'p') return p[point];
            return (s[point] + p[point]) / 2;
        });
    }

    Column::Numbers amplitude(const Spectra& spectra, std::vector<Complex> Spectrum::*quantity,
                              double (*part)(const Complex&)) const {
        return numbers([&](char polarization, std::size_t point) {
            const Spectrum& spectrum = polarization == 's' ? spectra.s : spectra.p;
            return part((spectrum.*quantity)[point]);
        });
    }

    Column::Numbers ellipsometric(const Spectra& spectra,
                                  double EllipsometricAngles::*angle) const {
        return numbers([&](char, std::size_t point) {
            return ellipsometric_angles(spectra.s.r[point], spectra.p.r[point]).*angle;
        });
    }

private:
    std::size_t angles_;
    const std::string& polarizations_;
    std::size_t wavelengths_;
};

double real_part(const Complex& z) {
    return z.real() + 0.0;  // -0 is 0
}
double imaginary_part(const Complex& z) {
    return z.imag() + 0.0;
}

Column::Numbers values_of(SpectrumColumn column, const Rows& rows, const Spectra& spectra) {
    switch (column) {
        case SpectrumColumn::r_re:
            return rows.amplitude(spectra, &Spectrum::r, real_part);
        case SpectrumColumn::r_im:
            return rows.amplitude(spectra, &Spectrum::r, imaginary_part);
        case SpectrumColumn::t_re:
            return rows.amplitude(spectra, &Spectrum::t, real_part);
        case SpectrumColumn::t_im:
            return rows.amplitude(spectra, &Spectrum::t, imaginary_part);
        case SpectrumColumn::psi_deg:
            return rows.ellipsometric(spectra, &EllipsometricAngles::psi_deg);
        case SpectrumColumn::delta_deg:
            return rows.ellipsometric(spectra, &EllipsometricAngles::delta_deg);
        case SpectrumColumn::A_layers:
            break;
    }
    return {};
}

void add_layers(std::vector<Column>& to, const Rows& rows, const Spectra& spectra,
                std::size_t points) {
    const std::size_t values = std::max(spectra.s.A_layers.size(), spectra.p.A_layers.size());
    for (std::size_t layer = 0; layer * points < values; ++layer)
        to.push_back({"A_" + std::to_string(layer + 1),
                      rows.power(spectra, &Spectrum::A_layers, layer * points)});
}

std::vector<std::string> letters(const std::string& polarizations) {
    std::vector<std::string> result;
    for (const char letter : polarizations) result.emplace_back(1, letter);
    return result;
}

}  // namespace

std::vector<SpectrumColumn> parse_spectrum_columns(std::string_view text) {
    std::vector<SpectrumColumn> columns;
    if (text.empty()) return columns;
    for (const std::string_view name : comma_separated(text)) {
        const SpectrumColumn column = column_of(name);
        if (std::ranges::find(columns, column) != columns.end())
            throw UsageError("--columns: each must be named once (got " + std::string(name) +
                             " twice)");
        columns.push_back(column);
    }
    return columns;
}

Needs spectrum_needs(const std::string& polarizations, const std::vector<SpectrumColumn>& columns,
                     const StackPower& stack) {
    const auto asked_for = [&](char letter) {
        return polarizations.find(letter) != std::string::npos;
    };
    Needs needs{asked_for('s') || asked_for('u'), asked_for('p') || asked_for('u')};
    for (const SpectrumColumn column : columns) {
        if (column == SpectrumColumn::A_layers) {
            if (stack.layer_count() > StackPower::kLargestLayerList)
                throw UsageError("--columns: A_layers needs a stack of at most " +
                                 std::to_string(StackPower::kLargestLayerList) + " layers (got " +
                                 std::to_string(stack.layer_count()) + ", repetitions included)");
            needs.layers = stack.layer_count() > 0;
            continue;
        }
        if (asked_for('u'))
            throw UsageError("--columns: " + name_of(column) +
                             " belongs to s or p, not to their mean: use -p s,p");
        if (!stack.has_amplitudes())
            throw UsageError("--columns: " + name_of(column) +
                             " needs a stack of coherent layers without thickness_sigma_nm: what "
                             "is added or averaged as power has no amplitude");
        needs.amplitudes = true;
        if (is_ellipsometric(column)) needs.s = needs.p = true;
    }
    return needs;
}

Records spectrum_records(const std::vector<double>& wavelengths_nm,
                         const std::vector<double>& angles_deg, const std::string& polarizations,
                         const std::vector<SpectrumColumn>& columns, const Spectra& spectra) {
    using std::size_t;
    const Rows rows(angles_deg.size(), polarizations, wavelengths_nm.size());
    Records records;
    std::vector<Column>& to = records.columns;
    to.push_back({"wavelength_nm",
                  Column::CodedNumbers{wavelengths_nm,
                                       rows.codes([](size_t, size_t, size_t w) { return w; })}});
    to.push_back(
        {"angle_deg",
         Column::CodedNumbers{angles_deg, rows.codes([](size_t a, size_t, size_t) { return a; })}});
    to.push_back({"polarization",
                  Column::CodedTexts{letters(polarizations),
                                     rows.codes([](size_t, size_t p, size_t) { return p; })}});
    to.push_back({"R", rows.power(spectra, &Spectrum::R)});
    to.push_back({"T", rows.power(spectra, &Spectrum::T)});
    to.push_back({"A", rows.power(spectra, &Spectrum::A)});
    for (const SpectrumColumn column : columns) {
        if (column == SpectrumColumn::A_layers) {
            add_layers(to, rows, spectra, angles_deg.size() * wavelengths_nm.size());
        } else {
            to.push_back({name_of(column), values_of(column, rows, spectra)});
        }
    }
    return records;
}

}  // namespace irido
