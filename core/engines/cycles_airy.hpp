#pragma once

#include <array>

#include "core/complex.hpp"
#include "core/engines/engine_film.hpp"

namespace irido {

/// The lower interface of a film, for one polarization and one channel.
struct CyclesFace {
    double R23;
    Complex phasor23;  ///< unit modulus
};

/// The film in Cycles' terms, and its upper interface.
struct CyclesFilm {
    explicit CyclesFilm(const EngineFilm& film);

    double film_n;    ///< blended to 1 below 1 nm
    double cos_film;  ///< 0 under total reflection
    double opd_nm;
    std::array<double, 2> R12{1, 1}, sign12{1, 1};  ///< p, s
    /// Whether no light enters: the result is 1.
    bool is_mirror() const { return R12[0] == 1 && R12[1] == 1; }
};

/// Thickness (nm) up to which the film is ignored.
inline constexpr double kCyclesThinnest_nm = 0.1;

/// Phasors and reflectances of the interface between the film and n + ik; p, s.
std::array<CyclesFace, 2> cycles_conductor(const CyclesFilm& film, double n, double k);

/// Airy series to order 3, clipped to [0, 1]; `faces` are [channel][p, s].
Triple cycles_airy(const CyclesFilm& film, const std::array<std::array<CyclesFace, 2>, 3>& faces);

}  // namespace irido
