#include "cli/queries/spectrum_answers.hpp"

#include "core/coherent/media.hpp"
#include "core/material/index_series.hpp"
#include "core/math/parallel.hpp"

namespace irido::cli {

namespace {

/// Wavelengths that one thread processes at a time.
constexpr std::size_t kDelaysTogether = 16;

void find_ellipsometry(const StackPower& power, const IndexTable& table,
                       std::span<const IncidentAngle> angles, SpectrumAnswers& out) {
    const std::size_t wavelengths = table.wavelength_nm().size();
    out.ellipsometry.resize(angles.size() * wavelengths);
    std::vector<Medium> media_s, media_p;
    for (std::size_t i = 0; i < out.ellipsometry.size(); ++i) {
        if (power.has_amplitudes()) {
            out.ellipsometry[i] = ellipsometry(out.spectra.s.r[i], out.spectra.p.r[i]);
            continue;
        }
        const std::size_t w = i % wavelengths;
        set_media(table, w, angles[i / wavelengths], Polarization::s, media_s);
        set_media(table, w, angles[i / wavelengths], Polarization::p, media_p);
        out.ellipsometry[i] = ellipsometry(power, media_s, media_p, table.k0()[w]);
    }
}

void find_delays(const Stack& stack, const IndexTable& table, std::span<const IncidentAngle> angles,
                 const Needs& needs, unsigned threads, SpectrumAnswers& out) {
    const std::vector<double>& nm = table.wavelength_nm();
    out.delays_s.resize(needs.s ? angles.size() * nm.size() : 0);
    out.delays_p.resize(needs.p ? angles.size() * nm.size() : 0);
    const std::size_t blocks = (nm.size() + kDelaysTogether - 1) / kDelaysTogether;
    parallel_for(blocks, threads, [&](std::size_t block) {
        const std::size_t begin = block * kDelaysTogether;
        for (std::size_t w = begin; w < std::min(begin + kDelaysTogether, nm.size()); ++w) {
            std::vector<Series<Complex>> index, extraordinary;
            for (const Material& material : stack.materials) {
                index.push_back(index_series(material, nm[w]));
                if (table.is_uniaxial())
                    extraordinary.push_back(extraordinary_series(material, nm[w]));
            }
            for (std::size_t a = 0; a < angles.size(); ++a) {
                const std::size_t point = a * nm.size() + w;
                if (needs.s)
                    out.delays_s[point] = delays(stack, index, nm[w], angles[a], Polarization::s);
                if (needs.p)
                    out.delays_p[point] =
                        delays(stack, index, nm[w], angles[a], Polarization::p, extraordinary);
            }
        }
    });
}

}  // namespace

std::vector<IncidentAngle> incident_angles_of(std::span<const double> angles_deg) {
    std::vector<IncidentAngle> incident_angles;
    for (const double angle_deg : angles_deg) incident_angles.push_back(incident_angle(angle_deg));
    return incident_angles;
}

void answer(const Stack& stack, const StackPower& power, const IndexTable& table,
            std::span<const double> angles_deg, const ConeSize& cone, const SpectrumNeeds& needs,
            const Execution& execution, SpectrumAnswers& out) {
    if (!cone.is_none())
        return cone_spectra(stack, power, table, angles_deg, cone, needs.power, execution,
                            out.spectra);
    const std::vector<IncidentAngle> angles = incident_angles_of(angles_deg);
    spectra(power, table, angles, needs.power, execution, out.spectra);
    if (needs.ellipsometry) find_ellipsometry(power, table, angles, out);
    if (needs.delays) find_delays(stack, table, angles, needs.power, execution.threads, out);
}

}  // namespace irido::cli
