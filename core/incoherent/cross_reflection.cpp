#include "core/incoherent/cross_reflection.hpp"

namespace irido {

Complex cross_reflection(const ChainLight& s, const ChainLight& p) {
    const auto crossed = [](Complex of_p, Complex of_s) { return of_p * std::conj(of_s); };
    const std::size_t last = s.last_block();
    Complex below = crossed(p.down(last).r, s.down(last).r);
    for (std::size_t i = last; i-- > 0;) {
        const Response s_down = s.down(i), s_up = s.up(i), p_down = p.down(i), p_up = p.up(i);
        const Complex arriving = s.gap(i).kept * p.gap(i).kept * below;
        below = crossed(p_down.r, s_down.r) + crossed(p_down.t * p_up.t, s_down.t * s_up.t) *
                                                  arriving /
                                                  (1.0 - crossed(p_up.r, s_up.r) * arriving);
    }
    return below;
}

}  // namespace irido
