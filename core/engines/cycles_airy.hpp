#pragma once

#include <array>

#include "core/complex.hpp"
#include "core/engines/engine_film.hpp"

namespace irido {

/// The lower face of a film for one polarization and one channel.
struct CyclesFace {
    double R23;
    Complex phasor23;  ///< of modulus 1
};

/// The film as Cycles takes it, and its upper face.
struct CyclesFilm {
    explicit CyclesFilm(const EngineFilm& film);

    double film_n;    ///< brought to 1 below 1 nm
    double cos_film;  ///< 0 under total reflection
    double opd_nm;
    std::array<double, 2> R12{1, 1}, sign12{1, 1};  ///< p, s
    /// Whether nothing enters: the result is 1.
    bool is_mirror() const { return R12[0] == 1 && R12[1] == 1; }
};

/// Thickness, nm, up to which there is no film.
inline constexpr double kCyclesThinnest_nm = 0.1;

/// Phasors of the face between the film and n + ik, and its reflectances; p, s.
std::array<CyclesFace, 2> cycles_conductor(const CyclesFilm& film, double n, double k);

/// The series to order 3, clipped to [0, 1]; `faces` [channel][p, s].
Triple cycles_airy(const CyclesFilm& film, const std::array<std::array<CyclesFace, 2>, 3>& faces);

}  // namespace irido
