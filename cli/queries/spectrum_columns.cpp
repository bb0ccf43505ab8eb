#include "cli/queries/spectrum_columns.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "cli/options/list.hpp"
#include "core/error.hpp"

namespace irido::cli {

namespace {

/// Names on the command line, in the order of SpectrumColumn.
constexpr std::array<std::string_view, 20> kNames{
    "r_re",        "r_im",        "t_re",      "t_im",
    "psi_deg",     "delta_deg",   "A_layers",  "delta_nebraska_deg",
    "N",           "C",           "S",         "depolarization",
    "phase_r_deg", "phase_t_deg", "gd_r_fs",   "gd_t_fs",
    "gdd_r_fs2",   "gdd_t_fs2",   "tod_r_fs3", "tod_t_fs3"};

/// The quantity from which a column is computed.
enum class Source { amplitude, ellipsometric_angle, layers, ellipsometry, delay };

Source source_of(SpectrumColumn column) {
    using enum SpectrumColumn;
    if (column <= t_im) return Source::amplitude;
    if (column == delta_deg) return Source::ellipsometric_angle;
    if (column == A_layers) return Source::layers;
    return column == psi_deg || column <= depolarization ? Source::ellipsometry : Source::delay;
}

std::string name_of(SpectrumColumn column) {
    return std::string(kNames[static_cast<std::size_t>(column)]);
}

SpectrumColumn column_of(std::string_view name) {
    const auto found = std::ranges::find(kNames, name);
    if (found != kNames.end()) return static_cast<SpectrumColumn>(found - kNames.begin());
    throw UsageError("--columns: " + not_one_of(kNames, name));
}

/// Appends the values of rows to a column, in order.
class RowValues {
public:
    RowValues(const SpectrumShape& shape, const SpectrumAnswers& answers,
              tables::Column::Numbers& to)
        : shape_(shape), answers_(answers), spectra_(answers.spectra), to_(to) {}

    /// value(polarization, point), with points ordered [angle][wavelength].
    template <class Value>
    void append(const Value& value) const {
        to_.reserve(to_.size() + shape_.rows());
        for (std::size_t a = 0; a < shape_.angles; ++a)
            for (const char polarization : shape_.polarizations)
                for (std::size_t w = 0; w < shape_.wavelengths; ++w)
                    to_.push_back(value(polarization, a * shape_.wavelengths + w));
    }

    /// Appends a power; `offset` is the index of its first point.
    void power(std::vector<double> Spectrum::*quantity, std::size_t offset = 0) const {
        const double* s = (spectra_.s.*quantity).data();
        const double* p = (spectra_.p.*quantity).data();
        append([&](char polarization, std::size_t point) {
            const std::size_t i = offset + point;
            if (polarization == 's') return s[i];
            if (polarization == 'p') return p[i];
            return (s[i] + p[i]) / 2;
        });
    }

    void amplitude(std::vector<Complex> Spectrum::*quantity, double (*part)(const Complex&)) const {
        append([&](char polarization, std::size_t point) {
            const Spectrum& spectrum = polarization == 's' ? spectra_.s : spectra_.p;
            return part((spectrum.*quantity)[point]);
        });
    }

    /// Values shared by s and p, in the rows of the first polarization only.
    template <class Value>
    void append_once(const Value& value) const {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        const char first = shape_.polarizations.front();
        append([&](char polarization, std::size_t point) {
            return shape_.has_ellipsometry && polarization == first ? value(point) : none;
        });
    }

    void delta() const {
        append_once([&](std::size_t point) {
            return ellipsometric_angles(spectra_.s.r[point], spectra_.p.r[point]).delta_deg;
        });
    }

    void ellipsometric(double Ellipsometry::*quantity) const {
        append_once([&](std::size_t point) { return answers_.ellipsometry[point].*quantity; });
    }

    void delay(Delay Delays::*amplitude, double Delay::*quantity) const {
        append([&](char polarization, std::size_t point) {
            const auto& all = polarization == 's' ? answers_.delays_s : answers_.delays_p;
            return (all[point].*amplitude).*quantity;
        });
    }

private:
    const SpectrumShape& shape_;
    const SpectrumAnswers& answers_;
    const Spectra& spectra_;
    tables::Column::Numbers& to_;
};

double real_part(const Complex& z) {
    return z.real() + 0.0;  // turns -0 into 0
}
double imaginary_part(const Complex& z) {
    return z.imag() + 0.0;
}

void append_values(SpectrumColumn column, const RowValues& values) {
    switch (column) {
        case SpectrumColumn::r_re:
            return values.amplitude(&Spectrum::r, real_part);
        case SpectrumColumn::r_im:
            return values.amplitude(&Spectrum::r, imaginary_part);
        case SpectrumColumn::t_re:
            return values.amplitude(&Spectrum::t, real_part);
        case SpectrumColumn::t_im:
            return values.amplitude(&Spectrum::t, imaginary_part);
        case SpectrumColumn::delta_deg:
            return values.delta();
        case SpectrumColumn::psi_deg:
            return values.ellipsometric(&Ellipsometry::psi_deg);
        case SpectrumColumn::delta_nebraska_deg:
            return values.ellipsometric(&Ellipsometry::delta_nebraska_deg);
        case SpectrumColumn::N:
            return values.ellipsometric(&Ellipsometry::N);
        case SpectrumColumn::C:
            return values.ellipsometric(&Ellipsometry::C);
        case SpectrumColumn::S:
            return values.ellipsometric(&Ellipsometry::S);
        case SpectrumColumn::depolarization:
            return values.ellipsometric(&Ellipsometry::depolarization);
        case SpectrumColumn::phase_r_deg:
            return values.delay(&Delays::r, &Delay::phase_deg);
        case SpectrumColumn::phase_t_deg:
            return values.delay(&Delays::t, &Delay::phase_deg);
        case SpectrumColumn::gd_r_fs:
            return values.delay(&Delays::r, &Delay::gd_fs);
        case SpectrumColumn::gd_t_fs:
            return values.delay(&Delays::t, &Delay::gd_fs);
        case SpectrumColumn::gdd_r_fs2:
            return values.delay(&Delays::r, &Delay::gdd_fs2);
        case SpectrumColumn::gdd_t_fs2:
            return values.delay(&Delays::t, &Delay::gdd_fs2);
        case SpectrumColumn::tod_r_fs3:
            return values.delay(&Delays::r, &Delay::tod_fs3);
        case SpectrumColumn::tod_t_fs3:
            return values.delay(&Delays::t, &Delay::tod_fs3);
        case SpectrumColumn::A_layers:
            return;
    }
}

}  // namespace

std::span<const std::string_view> spectrum_column_names() {
    return kNames;
}

std::vector<SpectrumColumn> parse_spectrum_columns(std::string_view text) {
    std::vector<SpectrumColumn> columns;
    if (text.empty()) return columns;
    for (const std::string_view name : comma_separated(text)) {
        const SpectrumColumn column = column_of(name);
        if (std::ranges::find(columns, column) != columns.end())
            throw UsageError("--columns: each column must be named once (got " + std::string(name) +
                             " twice)");
        columns.push_back(column);
    }
    return columns;
}

SpectrumNeeds spectrum_needs(const std::string& polarizations,
                             const std::vector<SpectrumColumn>& columns, const StackPower& stack) {
    const auto asked_for = [&](char letter) {
        return polarizations.find(letter) != std::string::npos;
    };
    SpectrumNeeds all{{asked_for('s') || asked_for('u'), asked_for('p') || asked_for('u')}};
    Needs& needs = all.power;
    for (const SpectrumColumn column : columns) {
        const Source source = source_of(column);
        if (source == Source::layers) {
            if (stack.layer_count() > StackPower::kLargestLayerList)
                throw UsageError("--columns: A_layers requires a stack of at most " +
                                 std::to_string(StackPower::kLargestLayerList) + " layers (got " +
                                 std::to_string(stack.layer_count()) + ", repetitions included)");
            needs.layers = stack.layer_count() > 0;
            continue;
        }
        if (source == Source::ellipsometry) {
            if (!stack.chain())
                throw UsageError("--columns: " + name_of(column) +
                                 " requires layers without thickness_sigma_nm");
            all.ellipsometry = true;
            needs.s = needs.p = true;
            needs.amplitudes = needs.amplitudes || stack.has_amplitudes();
            continue;
        }
        if (asked_for('u'))
            throw UsageError("--columns: " + name_of(column) +
                             " is undefined for unpolarized light; use -p s,p");
        if (!stack.has_amplitudes())
            throw UsageError("--columns: " + name_of(column) +
                             " requires coherent layers without thickness_sigma_nm: incoherent "
                             "or averaged stacks have no amplitudes");
        if (source == Source::delay) {
            all.delays = true;
            if (column > SpectrumColumn::phase_t_deg) all.derivatives = true;
            continue;
        }
        needs.amplitudes = true;
        if (source == Source::ellipsometric_angle) needs.s = needs.p = true;
    }
    return all;
}

std::vector<std::string> spectrum_number_names(const std::vector<SpectrumColumn>& columns,
                                               std::size_t layers) {
    std::vector<std::string> names{"R", "T", "A"};
    for (const SpectrumColumn column : columns) {
        if (column != SpectrumColumn::A_layers) {
            names.push_back(name_of(column));
            continue;
        }
        for (std::size_t layer = 1; layer <= layers; ++layer)
            names.push_back("A_" + std::to_string(layer));
    }
    return names;
}

void append_spectrum_numbers(const SpectrumShape& shape, const std::vector<SpectrumColumn>& columns,
                             std::size_t layers, const SpectrumAnswers& answers,
                             std::vector<tables::Column::Numbers>& to) {
    auto next = to.begin();
    const auto values = [&] { return RowValues(shape, answers, *next++); };
    for (const auto quantity : {&Spectrum::R, &Spectrum::T, &Spectrum::A}) values().power(quantity);
    for (const SpectrumColumn column : columns) {
        if (column != SpectrumColumn::A_layers) {
            append_values(column, values());
            continue;
        }
        for (std::size_t layer = 0; layer < layers; ++layer)
            values().power(&Spectrum::A_layers, layer * shape.angles * shape.wavelengths);
    }
}

}  // namespace irido::cli
